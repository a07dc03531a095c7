// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/observables/table.hpp"

namespace tunica::run {

/// A process that has ended.
struct EndedProcess {
  int exit_code = -1;  ///< -1 when a signal ended it
  int signal = 0;
  std::string complaint;  ///< the last line with words that it wrote to standard error
  double wall_seconds = 0;
  double cpu_seconds = 0;  ///< its own and its children's
  double mebibytes = 0;    ///< largest resident set
};

/// Runs a program to its end; what it prints is not shown. It ends with the thread that asked for it, however
/// that ends. Once `interrupted` says so it is asked to stop (SIGINT) and waited for.
/// Throws InvalidInput naming the program when it cannot be started.
EndedProcess run_process(const std::vector<std::string>& arguments, const std::function<bool()>& interrupted);

}  // namespace tunica::run
