// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "app/time_left.hpp"
#include "core/tier.hpp"
#include "verification/sweep/campaign.hpp"

namespace tunica {

/// One line that says how far something has come: written over on a terminal, in a log a plain line now and
/// then. What is over within half a second shows nothing.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet, std::chrono::duration<double> between_lines = std::chrono::seconds(15));
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  double elapsed() const;  ///< s since it was made
  /// True when a line would be shown now; `in_log` asks for one in a log at once.
  bool is_due(bool in_log = false) const;
  void show(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_;
  std::chrono::duration<double> between_lines_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// Shows how a long run goes on: one line that is written over on a terminal, in a log a plain
/// line a beat and, within long ones, as often as `between_lines`. A run that is over within half a second
/// shows nothing. How long it will take is told once that is known.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool quiet, std::chrono::duration<double> between_lines = std::chrono::seconds(15))
      : line_(quiet, between_lines) {}

  void show(const Progress& progress);

 private:
  ProgressLine line_;
  int last_beat_ = -1;
  TimeLeft left_;
};

/// The same for a sweep, by its points.
class SweepDisplay {
 public:
  explicit SweepDisplay(bool quiet) : line_(quiet) {}
  void show(const sweep::SweepProgress& progress);

 private:
  ProgressLine line_;
  std::optional<std::uint64_t> first_;  ///< points that had ended before
};

}  // namespace tunica
