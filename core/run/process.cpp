// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "core/error.hpp"

namespace tunica::run {

namespace {

using Clock = std::chrono::steady_clock;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// A file in memory that a process writes its errors to.
class Words {
 public:
  Words() : descriptor_(::memfd_create("errors", MFD_CLOEXEC)) {}
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;
  ~Words() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  int descriptor() const { return descriptor_; }

  std::string last_line() const {
    constexpr off_t enough = 1 << 16;
    const off_t size = ::lseek(descriptor_, 0, SEEK_END);
    if (size <= 0) return {};
    std::string text(static_cast<std::size_t>(std::min(size, enough)), '\0');
    const ssize_t got =
        ::pread(descriptor_, text.data(), text.size(), size - static_cast<off_t>(text.size()));
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    // mpirun draws a rule below what it has to say.
    text.resize(text.find_last_not_of("\n-= ") + 1);
    text.erase(0, text.rfind('\n') + 1);
    return text;
  }

 private:
  int descriptor_;
};

/// What stands between fork and exec must not allocate: other threads may have held the locks.
[[noreturn]] void become(char* const* arguments, const Words& words, pid_t parent, int failure) {
  // A group of its own: the terminal's Ctrl-C reaches it through the parent, once.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int nothing = ::open("/dev/null", O_RDWR);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(words.descriptor() >= 0 ? words.descriptor() : nothing, STDERR_FILENO);
  if (::getppid() == parent) ::execvp(arguments[0], arguments);
  const int error = errno;
  const ssize_t told = ::write(failure, &error, sizeof error);
  ::_exit(told == sizeof error ? 127 : 126);
}

}  // namespace

EndedProcess run_process(const std::vector<std::string>& arguments,
                         const std::function<bool()>& interrupted) {
  std::vector<std::string> texts = arguments;
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  const Words words;
  const auto refuse = [&](int error) {
    return InvalidInput(fmt::format("{} cannot be started: {}", arguments[0], std::strerror(error)));
  };
  int failure[2];
  if (::pipe2(failure, O_CLOEXEC) != 0) throw refuse(errno);
  const pid_t parent = ::getpid();
  const auto began = Clock::now();
  const pid_t child = ::fork();
  if (child == 0) become(pointers.data(), words, parent, failure[1]);
  const int fork_error = errno;
  ::close(failure[1]);
  int start_error = 0;
  const bool failed_to_start =
      child > 0 && ::read(failure[0], &start_error, sizeof start_error) == sizeof start_error;
  ::close(failure[0]);
  if (child < 0) throw refuse(fork_error);

  int status = 0;
  rusage usage{};
  bool asked = false;
  for (auto pause = std::chrono::microseconds(200);;) {
    const pid_t ended = ::wait4(child, &status, WNOHANG, &usage);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) throw refuse(errno);
    if (!asked && interrupted()) asked = ::kill(-child, SIGINT) == 0 || ::kill(child, SIGINT) == 0;
    std::this_thread::sleep_for(pause);
    // Short processes are waited for closely, long ones without taking part in their work.
    if (pause < std::chrono::milliseconds(20)) pause *= 2;
  }
  if (failed_to_start) throw refuse(start_error);
  EndedProcess result;
  result.wall_seconds = std::chrono::duration<double>(Clock::now() - began).count();
  result.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  // Linux counts the resident set in KiB.
  result.mebibytes = static_cast<double>(usage.ru_maxrss) / 1024;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.complaint = words.last_line();
  return result;
}

}  // namespace tunica::run
