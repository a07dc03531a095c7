// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "app/tell.hpp"

namespace tunica {

ProgressLine::ProgressLine(bool quiet, std::chrono::duration<double> between_lines)
    : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1), between_lines_(between_lines) {}

ProgressLine::~ProgressLine() {
  if (shown_ && terminal_) tell("\n");
}

double ProgressLine::elapsed() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

bool ProgressLine::is_due(bool in_log) const {
  constexpr double silence = 0.5;
  constexpr std::chrono::duration<double> between_updates(0.2);
  if (quiet_ || elapsed() < silence) return false;
  const auto since = Clock::now() - last_;
  return terminal_ ? since >= between_updates : in_log || since >= between_lines_;
}

void ProgressLine::show(const std::string& line) {
  if (terminal_)
    tell("\r\x1b[K" + line);
  else
    spdlog::info(line);
  shown_ = true;
  last_ = Clock::now();
}

void ProgressDisplay::show(const Progress& progress) {
  // The search for a first state says nothing about the beats.
  if (progress.beat > 0) left_.note(line_.elapsed(), progress.time);
  if (!line_.is_due(progress.beat != last_beat_)) return;
  last_beat_ = progress.beat;
  if (progress.beat == 0) {
    line_.show(fmt::format("towards the first state, step {}, {} Newton iterations", progress.step,
                           progress.newton_iterations));
    return;
  }
  const auto left = left_.until(progress.end_time);
  line_.show(fmt::format("beat {}, t = {:.4f} of {:.4f} s, step {}, {} Newton iterations{}", progress.beat,
                         progress.time, progress.end_time, progress.step, progress.newton_iterations,
                         left ? fmt::format(", {:.0f} s left", *left) : ""));
}

void SweepDisplay::show(const sweep::SweepProgress& progress) {
  if (!first_) first_ = progress.ended;
  if (!line_.is_due()) return;
  // Points come in no order of their cost, so that their mean so far is as good as any guess, once there are
  // some.
  constexpr std::uint64_t some = 8;
  const std::uint64_t here = progress.ended - *first_;
  const double left = here == 0 ? 0
                                : line_.elapsed() / static_cast<double>(here) *
                                      static_cast<double>(progress.count - progress.ended);
  line_.show(fmt::format("point {} of {}{}{}", progress.ended, progress.count,
                         progress.failed > 0 ? fmt::format(", {} without a result", progress.failed) : "",
                         here >= some ? fmt::format(", {:.0f} s left", left) : ""));
}

}  // namespace tunica
