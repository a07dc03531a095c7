// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tunica::test_support {

/// A program that runs beside the test, its output in files of its own.
class Program {
 public:
  /// Starts `arguments` (the first is the program) in the folder. `before` runs in the child before
  /// the program does (limits, another user); it may only use what is safe after a fork.
  Program(
      const std::vector<std::string>& arguments, const std::filesystem::path& folder,
      const std::function<void()>& before = [] {});
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  pid_t id() const { return child_; }
  void send(int signal) const;
  bool running();
  /// Waits for its end. Exit code, or 256 + the signal that ended it.
  int wait();

  std::string output() const;  ///< stdout
  std::string errors() const;  ///< stderr

 private:
  std::filesystem::path out_, err_;
  pid_t child_ = -1;
  int status_ = -1;
};

struct Ended {
  int code;
  std::string output, errors;
};

/// Runs tunica (the path is TUNICA_PROGRAM) to its end.
Ended tunica(
    const std::vector<std::string>& arguments, const std::filesystem::path& folder = ".",
    const std::function<void()>& before = [] {});

/// One line, ending with its line end, that begins with "tunica: ".
bool is_one_line(const std::string& errors);

/// What is wrong with a folder of results at any moment at all, empty when nothing is: each file has to
/// be whole. Files that are being written (".NAME.PID.part"), and the lock of a run that was killed, do not
/// count.
std::string broken_file(const std::filesystem::path& folder);

}  // namespace tunica::test_support
