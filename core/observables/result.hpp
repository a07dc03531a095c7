// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/observables/table.hpp"
#include "core/scene/scene.hpp"

namespace tunica {

/// What a run did, apart from the numbers it found: written to record.json.
struct RunRecord {
  std::string tier;
  nlohmann::ordered_json resolution;  ///< tier's own: {"compartments": 1, ...}
  long unknowns = 0;
  long steps = 0;
  long newton_iterations = 0;
  long linear_iterations = 0;
  long rejected_steps = 0;
  double setup_seconds = 0;
  double solve_seconds = 0;
  bool converged = false;
  bool interrupted = false;
  std::string failure;               ///< where and why the solver gave up; empty when it did not
  std::vector<std::string> remarks;  ///< model differences and warnings, one line each
};

/// What a tier returns. A solver that gives up returns what it has with record.failure set.
struct Result {
  observables::Table observables;          ///< observables.csv: the columns of observables::standard_table
  observables::Table profiles;             ///< profiles.csv: through-wall profiles at chosen times
  observables::Table events;               ///< events.csv: recruitment and release, found as roots
  observables::Table sensitivities;        ///< sensitivities.csv; no columns when none was asked for
  observables::Table event_sensitivities;  ///< event_sensitivities.csv; likewise
  RunRecord record;
};

/// A result read back from, or about to be written to, a folder.
struct StoredResult {
  std::filesystem::path folder;
  nlohmann::ordered_json record;  ///< record.json
  Result result;                  ///< tables only; result.record is not filled
};

namespace observables {

/// Number of points through the wall at mid-length: P1 on the inner, P4 on the outer surface.
inline constexpr int wall_points = 4;

/// Values of one output time, the same for every tier. `none` where a law or tier has no such thing.
struct WallPoint {
  double radial_displacement = none;  ///< cm
  double fiber_angle = none;          ///< deg, deformed family 1 against the deformed circumference
  double fiber_stretch = none;        ///< sqrt(I4bar) of family 1
  double recruitment = none;          ///< H of family 1
  double von_mises = none;            ///< dyn/cm2, of the Cauchy stress
};
struct Sample {
  double time = none;                 ///< s
  double inflow = none;               ///< cm3/s
  double outflow = none;              ///< cm3/s
  double pressure = none;             ///< dyn/cm2, mean over the lumen section at mid-length
  double outlet_pressure = none;      ///< dyn/cm2
  double transmural_pressure = none;  ///< dyn/cm2
  WallPoint wall[wall_points];
};

/// An empty table with the columns of observables.csv.
Table standard_table();
/// Appends one row to a table made by standard_table.
void append(Table& table, const Sample& sample);

}  // namespace observables

/// Writes the result into a folder (made when missing): each file is written aside and renamed, so a
/// reader never sees half a file. Throws OutputFailure naming the path and the system's reason.
void write_result(const std::filesystem::path& folder, const Scene& scene, const Result& result);

/// Reads a folder written by write_result. Throws InvalidInput when something is missing or broken.
StoredResult read_result(const std::filesystem::path& folder);

/// Writes text to a file by way of a temporary file beside it and a rename. Throws OutputFailure.
void write_whole(const std::filesystem::path& file, std::string_view text);

}  // namespace tunica
