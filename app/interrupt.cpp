// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <string_view>

#include "app/commands/commands.hpp"

namespace tunica {

namespace {

std::atomic<bool> setting_up = true;
std::atomic<bool> is_quiet = false;
std::atomic<long long> asked_at = 0;  ///< 0 for never
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<long long>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

/// What a signal handler may do: fmt and stdio lock and allocate.
void say(std::string_view line) {
  // A line of progress may stand on the terminal.
  const std::string_view start = ::isatty(STDERR_FILENO) == 1 ? "\n" : "";
  [[maybe_unused]] auto written = ::write(STDERR_FILENO, start.data(), start.size());
  written = ::write(STDERR_FILENO, line.data(), line.size());
}

/// Milliseconds of a clock that only goes forwards.
long long now() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return 1000LL * time.tv_sec + time.tv_nsec / 1000000;
}

/// A request may be told twice: timeout signals its child and the child's group, and of a terminal that goes
/// its shell tells as well as the system.
bool is_the_same_request(int signal, long long since_first) {
  return since_first < (signal == SIGHUP ? 1000 : 20);
}

/// A run that computes keeps what it has, after the step that it is at; before that there is nothing to keep,
/// and who asks twice does not want to wait. Files are written aside, so that none is left half-written.
void ask_to_stop(int signal) {
  const int error = errno;
  if (setting_up) {
    say("tunica: interrupted before anything was computed\n");
    ::_exit(interrupted);
  }
  long long never = 0;
  if (asked_at.compare_exchange_strong(never, now())) {
    if (!is_quiet) say("tunica: stopping after this step; again to stop now\n");
  } else if (!is_the_same_request(signal, now() - asked_at)) {
    say("tunica: interrupted at once; --resume goes on from the last checkpoint\n");
    ::_exit(interrupted);
  }
  errno = error;
}

/// As the program was started: by nohup it is to outlive its terminal. Libraries set handlers of their own.
const bool ignores_hangups = [] {
  struct sigaction now {};
  return ::sigaction(SIGHUP, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}();

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};

}  // namespace

void heed_interrupts(bool quiet) {
  is_quiet = quiet;
  for (const int signal : signals)
    std::signal(signal, signal == SIGHUP && ignores_hangups ? SIG_IGN : ask_to_stop);
}

void ignore_interrupts() {
  for (const int signal : signals) std::signal(signal, SIG_IGN);
}

void computation_begins() {
  setting_up = false;
}

bool stop_asked() {
  return asked_at != 0;
}

}  // namespace tunica
