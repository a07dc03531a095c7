// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "app/tell.hpp"

namespace tunica {

ProgressDisplay::ProgressDisplay(bool quiet, std::chrono::duration<double> between_lines)
    : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1), between_lines_(between_lines) {}

ProgressDisplay::~ProgressDisplay() {
  if (shown_ && terminal_) tell("\n");
}

void ProgressDisplay::show(const Progress& progress) {
  if (quiet_) return;
  using std::chrono::duration;
  const auto now = Clock::now();
  const double elapsed = duration<double>(now - start_).count();
  // The search for a first state says nothing about the beats.
  if (progress.beat > 0) left_.note(elapsed, progress.time);
  constexpr double silence = 0.5, between_updates = 0.2;
  if (elapsed < silence) return;
  std::string line;
  if (progress.beat == 0) {
    line = fmt::format("towards the first state, step {}, {} Newton iterations", progress.step,
                       progress.newton_iterations);
  } else {
    const auto left = left_.until(progress.end_time);
    line = fmt::format("beat {}, t = {:.4f} of {:.4f} s, step {}, {} Newton iterations{}", progress.beat,
                       progress.time, progress.end_time, progress.step, progress.newton_iterations,
                       left ? fmt::format(", {:.0f} s left", *left) : "");
  }
  if (terminal_) {
    if (duration<double>(now - last_).count() < between_updates) return;
    tell("\r\x1b[K" + line);
    last_ = now;
    shown_ = true;
  } else if (progress.beat != last_beat_ || now - last_ >= between_lines_) {
    spdlog::info(line);
    last_beat_ = progress.beat;
    last_ = now;
  }
}

}  // namespace tunica
