// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/observables/result.hpp"

namespace tunica::verification {

/// A run of the whole program as a user starts it, and what it took.
struct MeasuredRun {
  StoredResult stored;
  double wall_seconds;  ///< from the start of the process to its end, files and report included
  double cpu_seconds;
  double mebibytes;  ///< largest resident set

  /// A count of record.json, also of its "resolution"; 0 where there is none.
  long count(const char* key) const;
};

/// What becomes of an earlier result of the run in its folder.
enum class Folder { anew, resumed };

/// Runs `program run SCENE --tier TIER --out FOLDER --quiet --set ...` and reads its result,
/// with --resume one that is whole there already.
/// Throws std::runtime_error when the program cannot be started or does not exit 0.
MeasuredRun measured_run(const std::filesystem::path& program, const std::filesystem::path& scene,
                         const std::string& tier, const std::vector<std::string>& overrides,
                         const std::filesystem::path& folder, Folder earlier = Folder::anew);

/// Greatest difference of a column over all rows, relative to the reference's range in them; `none` where
/// the law has no such quantity or it does not move. The rows' times have to be the same.
double error_of(const std::string& column, const MeasuredRun& run, const MeasuredRun& reference);

/// Greatest difference of the times at which fibres are recruited or released, s; `none` where the reference
/// has no such times, infinite where the run has more or fewer.
double event_difference(const MeasuredRun& run, const MeasuredRun& reference);

}  // namespace tunica::verification
