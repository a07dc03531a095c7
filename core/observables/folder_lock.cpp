// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <thread>

#include "core/error.hpp"

namespace tunica {

namespace fs = std::filesystem;

namespace {

/// "process 4711 on node7": who holds the lock, as it has written itself.
std::string holder(int descriptor) {
  std::array<char, 200> text{};
  const ssize_t length = ::pread(descriptor, text.data(), text.size(), 0);
  std::string line(text.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
  line = line.substr(0, line.find('\n'));
  return line.empty() ? "another process" : line;
}

void sign(int descriptor) {
  std::array<char, 100> host{};
  ::gethostname(host.data(), host.size() - 1);
  const std::string line = fmt::format("process {} on {}\n", ::getpid(), host.data());
  if (::ftruncate(descriptor, 0) != 0) return;
  [[maybe_unused]] const auto written = ::pwrite(descriptor, line.data(), line.size(), 0);
}

/// False when the file has been removed, and perhaps made anew, since it was opened.
bool is_still(const fs::path& file, int descriptor) {
  struct stat opened {
  }, there{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &there) == 0 &&
         opened.st_ino == there.st_ino && opened.st_dev == there.st_dev;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, std::chrono::milliseconds patience) : file_(folder / ".lock") {
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + patience;
  for (;;) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
      throw OutputFailure(
          fmt::format("{}: files cannot be made in this folder: {}", folder.string(), std::strerror(errno)));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EINTR) {
        ::close(descriptor_);
        continue;
      }
      if (errno != EWOULDBLOCK) return;
      if (Clock::now() < until) {
        ::close(descriptor_);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        continue;
      }
      const std::string who = holder(descriptor_);
      ::close(descriptor_);
      throw InvalidInput(
          fmt::format("{}: another run is at work in this folder ({}); wait for its end, or name another "
                      "folder with --out",
                      folder.string(), who));
    }
    // Whoever held the lock before may have removed the file with it.
    if (is_still(file_, descriptor_)) break;
    ::close(descriptor_);
  }
  sign(descriptor_);
}

FolderLock::~FolderLock() {
  // While the lock is still held, so that the file of no other run is removed.
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace tunica
