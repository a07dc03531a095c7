// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace tunica {

ProgressDisplay::ProgressDisplay(bool quiet, std::chrono::duration<double> between_lines)
    : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1), between_lines_(between_lines) {}

ProgressDisplay::~ProgressDisplay() {
  if (shown_ && terminal_) fmt::print(stderr, "\n");
}

void ProgressDisplay::show(const Progress& progress) {
  if (quiet_) return;
  using std::chrono::duration;
  const auto now = Clock::now();
  const double elapsed = duration<double>(now - start_).count();
  // A run may have begun with a search for its first state, or go on from a checkpoint.
  if (progress.beat > 0 && beats_from_ < 0) {
    beats_start_ = now;
    beats_from_ = progress.time;
  }
  constexpr double silence = 0.5, between_updates = 0.2;
  if (elapsed < silence) return;
  std::string line;
  if (progress.beat == 0) {
    line = fmt::format("towards the first state, step {}, {} Newton iterations", progress.step,
                       progress.newton_iterations);
  } else {
    const double left = duration<double>(now - beats_start_).count() * (progress.end_time - progress.time) /
                        (progress.time - beats_from_);
    line = fmt::format("beat {}, t = {:.4f} of {:.4f} s, step {}, {} Newton iterations, {:.0f} s left",
                       progress.beat, progress.time, progress.end_time, progress.step,
                       progress.newton_iterations, progress.time > beats_from_ ? left : 0.0);
  }
  if (terminal_) {
    if (duration<double>(now - last_).count() < between_updates) return;
    fmt::print(stderr, "\r\x1b[K{}", line);
    last_ = now;
    shown_ = true;
  } else if (progress.beat != last_beat_ || now - last_ >= between_lines_) {
    spdlog::info(line);
    last_beat_ = progress.beat;
    last_ = now;
  }
}

}  // namespace tunica
