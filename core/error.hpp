// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <stdexcept>
#include <string>

namespace tunica {

/// Input that cannot be computed with. The message is one line that names the key or file, the
/// value, what is allowed and the remedy. The program ends with exit code 2 before any work.
class InvalidInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A solver that cannot go on. The message says where (time, place) and why. The program keeps the
/// results so far and ends with exit code 3.
class SolverFailure : public std::runtime_error {
 public:
  explicit SolverFailure(const std::string& what, double time = std::numeric_limits<double>::quiet_NaN())
      : std::runtime_error(what), time_(time) {}
  /// Of the run, s; NaN where it is none of a time or is told elsewhere.
  double time() const { return time_; }

 private:
  double time_;
};

/// Results that cannot be stored (full disk, folder without write permission). Names the path and
/// the system's reason.
class OutputFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown out of a computation that its caller has interrupted.
struct Interrupted {};

}  // namespace tunica
