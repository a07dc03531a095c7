// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

#include "app/time_left.hpp"
#include "core/tier.hpp"

namespace tunica {

/// Shows how a long run goes on: one line that is written over on a terminal, in a log a plain
/// line a beat and, within long ones, as often as `between_lines`. A run that is over within half a second
/// shows nothing. How long it will take is told once that is known.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool quiet,
                           std::chrono::duration<double> between_lines = std::chrono::seconds(15));
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void show(const Progress& progress);

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_;
  std::chrono::duration<double> between_lines_;
  bool shown_ = false;
  int last_beat_ = -1;
  Clock::time_point start_ = Clock::now(), last_ = start_;
  TimeLeft left_;
};

}  // namespace tunica
