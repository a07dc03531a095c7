// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <optional>

namespace tunica {

/// How long a run will still take, from how it has gone. Steps begin tiny and grow, so that their first pace
/// says nothing: there is a figure once the pace of the latter half of the time spent is near that of the
/// former half, and it follows the latter.
class TimeLeft {
 public:
  /// After `spent` seconds the run has come to `time` (s of simulated time); both never fall.
  void note(double spent, double time);
  /// Seconds until `end`, none as long as they would be a guess.
  std::optional<double> until(double end) const;

 private:
  struct Moment {
    double spent, time;
  };
  std::deque<Moment> moments_;
};

}  // namespace tunica
