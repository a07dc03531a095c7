// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "app/commands/commands.hpp"

namespace tunica {

namespace {

std::atomic<bool> is_asked = false;
std::atomic<bool> setting_up = true;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

/// A run that computes keeps what it has, after the step that it is at; before that there is nothing to keep,
/// and who asks twice does not want to wait. Files are written aside, so that none is left half-written.
void ask_to_stop(int) {
  const bool again = is_asked.exchange(true);
  if (!setting_up && !again) return;
  constexpr std::string_view before = "tunica: interrupted before anything was computed\n";
  constexpr std::string_view at_once =
      "tunica: interrupted at once; --resume goes on from the last checkpoint\n";
  const std::string_view message = setting_up ? before : at_once;
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message.data(), message.size());
  ::_exit(interrupted);
}

}  // namespace

void heed_interrupts() {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
}

void computation_begins() {
  setting_up = false;
}

bool stop_asked() {
  return is_asked;
}

}  // namespace tunica
