// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/observables/result.hpp"

namespace tunica::observables {

/// Fibre family (1, 2, ...) of a wall point (1 to wall_points) that can be recruited.
struct EventPlace {
  int point = 1;
  int family = 1;
};

/// Collects when fibres are recruited and released, and for how long they are recruited in the last beat:
/// the tables events, event_sensitivities and recruited_time of a result.
class EventLog {
 public:
  /// With the derivatives of all times by keys of the scene, if any.
  explicit EventLog(std::vector<EventPlace> places, std::vector<std::string> keys = {});

  /// `moved`: derivatives of the time by the keys.
  void record(double time, std::size_t place, bool recruited, const std::vector<double>& moved = {});
  /// The last beat begins, with these places recruited.
  void begin_last_beat(double time, const std::vector<bool>& recruited);
  /// Puts the tables into a result; recruited_time only when the last beat has begun and is over at `end`.
  void store(Result& result, double end, bool whole) const;

  nlohmann::json save() const;
  /// `so_far` has the tables of the run so far.
  void restore(const nlohmann::json& saved, const Result& so_far);

 private:
  struct Tally {
    double since, total;
    bool recruited;
    std::vector<double> derivatives;  ///< of total, by key
  };
  std::vector<EventPlace> places_;
  std::vector<std::string> keys_;
  Table events_, event_sensitivities_;
  std::vector<Tally> tallies_;  ///< one per place, in the last beat only
};

}  // namespace tunica::observables
