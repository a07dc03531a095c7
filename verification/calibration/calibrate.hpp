// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/run/door.hpp"
#include "verification/calibration/target.hpp"

namespace tunica::verification::calibration {

struct Task {
  std::string tier;  ///< its name, not "auto": the same one computes everything
  std::vector<FreeKey> free;
  std::vector<Target> targets;
  int starts = 5;
  std::uint64_t seed = 0;
  int jobs = 1;
};

/// How a search from one start went.
struct Start {
  std::vector<double> from, to;       ///< values of the free keys
  double misfit = observables::none;  ///< sum of ((reached - target) / standard deviation)^2
  bool converged = false;
  std::string reason;   ///< why not
  bool agrees = false;  ///< ends where the best one does
};

struct FreeResult {
  double value = observables::none;
  double standard_deviation = observables::none;  ///< none where targets do not determine it
  bool has_influence = true;                      ///< false: no target moves with it
  bool is_determined = true;                      ///< false: targets see it together with others only
  bool at_bound = false;
};

/// What a calibration found. Values are those of the best start; none of them when nothing could be computed.
struct Calibration {
  std::vector<FreeResult> free;
  std::vector<double> reached;                   ///< by target
  std::vector<std::vector<double>> correlation;  ///< of the free keys; none where undetermined
  double misfit = observables::none;
  double degrees = 0;  ///< of freedom: targets less keys that are determined, at least 1
  /// That targets which agree are missed so far by their standard deviations alone (chi-square's tail).
  double chance = observables::none;
  bool converged = false;
  bool interrupted = false;
  std::string reason;                       ///< why it has not converged
  std::vector<std::string> by_differences;  ///< keys that the tier has no derivatives by
  std::vector<Start> starts;
  long runs = 0;

  bool has_answer() const { return !reached.empty(); }
  /// The targets cannot be met together: the chance is below 1 %.
  bool conflicts() const { return chance < 0.01; }
  int agreeing() const;
};

struct Watch {
  /// After each run: how many there have been, and the least misfit so far. By one thread at a time.
  std::function<void(long runs, double misfit)> report = [](long, double) {};
  std::function<bool()> interrupted = [] { return false; };
};

/// Throws InvalidInput where there are fewer targets than free keys, or one of either twice.
void check(const Task& task);

/// Least squares on the misfit over the free keys within their bounds (least_squares), from the scene's own
/// values and from a Latin hypercube of further starts. Derivatives are the tier's where it has them, else
/// central differences. Standard deviations are those of targets carried to the keys to first order,
/// (J^T J)^-1 with J of residuals over standard deviations. Throws InvalidInput as check does.
Calibration calibrate(const run::Door& door, const Task& task, const Watch& watch = {});

}  // namespace tunica::verification::calibration
