// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace tunica {

ProgressDisplay::ProgressDisplay(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressDisplay::~ProgressDisplay() {
  if (shown_ && terminal_) fmt::print(stderr, "\n");
}

void ProgressDisplay::show(const Progress& progress) {
  if (quiet_) return;
  using std::chrono::duration;
  const auto now = Clock::now();
  const double elapsed = duration<double>(now - start_).count();
  constexpr double silence = 0.5, between_updates = 0.2;
  if (elapsed < silence) return;
  const double left = progress.time > 0 ? elapsed * (progress.end_time - progress.time) / progress.time : 0;
  const std::string line = fmt::format(
      "beat {}, t = {:.4f} of {:.4f} s, step {}, {} Newton iterations, {:.0f} s left", progress.beat,
      progress.time, progress.end_time, progress.step, progress.newton_iterations, left);
  if (terminal_) {
    if (duration<double>(now - last_).count() < between_updates) return;
    fmt::print(stderr, "\r\x1b[K{}", line);
    last_ = now;
    shown_ = true;
  } else if (progress.beat != last_beat_) {
    spdlog::info(line);
    last_beat_ = progress.beat;
  }
}

}  // namespace tunica
