// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/observables/field_series.hpp"
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
  long linear_iterations = 0;  ///< of a direct solver: systems solved with a factorisation
  long rejected_steps = 0;
  double setup_seconds = 0;
  double solve_seconds = 0;
  /// Median over the accepted time steps, what was tried in vain before each included; `none` from tiers
  /// without meshes and where there are no steps.
  double median_step_seconds = observables::none;
  bool converged = false;
  bool interrupted = false;
  std::string failure;               ///< where and why the solver gave up; empty when it did not
  std::vector<std::string> remarks;  ///< model differences and warnings, one line each
  /// What the run found out about its result that a user should know, one line each.
  std::vector<std::string> findings;
  /// Checksums of the files that the scene names (input_files), as they were when the run began.
  nlohmann::ordered_json input_files = nlohmann::ordered_json::object();
};

/// What a tier returns. A solver that gives up returns what it has with record.failure set.
struct Result {
  observables::Table observables;          ///< observables.csv: the columns of observables::standard_table
  observables::Table profiles;             ///< profiles.csv: the columns of observables::profile_table
  observables::Table events;               ///< events.csv: the columns of observables::event_table
  observables::Table sensitivities;        ///< sensitivities.csv: time[s], then one column for every
                                           ///< observables::sensitivity_column; none when not asked for
  observables::Table event_sensitivities;  ///< event_sensitivities.csv: the columns of events, then
                                           ///< d(time)/d(key); likewise
  observables::Table recruited_time;       ///< recruited_time.csv: point, family[1], recruited_time[s] in the
                                           ///< last beat, then its sensitivities; none without fibres
  observables::Table compartments;         ///< compartments.csv: pressure, radius and flow along the artery;
                                           ///< none for a single compartment
  observables::Table along;                ///< along.csv: the inner surface of the wall from the inlet to the
                                           ///< outlet; none from tiers that do not resolve it
  std::vector<observables::FieldSeries> fields;  ///< fields/NAME.xdmf, for viewers; none when not asked for
  RunRecord record;
};

/// A result read back from, or about to be written to, a folder.
struct StoredResult {
  std::filesystem::path folder;
  nlohmann::ordered_json record;  ///< record.json
  Result result;                  ///< tables only; fields and record of it are not filled
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

/// (upper - lower) / step, value by value; the time is that of both.
Sample difference_quotient(const Sample& upper, const Sample& lower, double step);

/// An empty table with the columns of observables.csv.
Table standard_table();
/// Appends one row to a table made by standard_table; columns that were added after those are left to the
/// caller.
void append(Table& table, const Sample& sample);

/// Values at one place in the wall at mid-length and one of the scene's output.profile_times.
struct ProfilePoint {
  double time = none;                     ///< s, of the run (not of the beat)
  double reference_radius = none;         ///< cm, in the unloaded wall
  double radial_displacement = none;      ///< cm
  double radial_stretch = none;           ///< deformed over unloaded length along the radius
  double circumferential_stretch = none;  ///< deformed over unloaded circumference
  double volume_change = none;            ///< J - 1
  double fiber_stretch = none;            ///< sqrt(I4bar) of family 1
  double fiber_angle = none;              ///< deg, as in WallPoint
  double recruitment = none;              ///< H of family 1
  double radial_stress = none;            ///< dyn/cm2, Cauchy, as below
  double circumferential_stress = none;   ///< dyn/cm2
  double axial_stress = none;             ///< dyn/cm2
  double von_mises = none;                ///< dyn/cm2
};
/// An empty table with the columns of profiles.csv.
Table profile_table();
/// Appends one row to a table made by profile_table; rows of one time follow each other, inside to outside.
void append(Table& table, const ProfilePoint& point);

/// An empty table with the columns of along.csv, a row for each node along a line on the lumen's surface from
/// the inlet to the outlet: time[s], z[cm] along the artery and lumen_radius[cm] (both current),
/// pressure[dyn/cm2] at the wall, wall_shear_stress[dyn/cm2] on the wall (positive downstream),
/// radial_displacement[cm], von_mises.inner[dyn/cm2] in the wall's inner surface.
Table along_table();

/// A fibre family of a wall point being recruited or released.
struct Event {
  double time = none;  ///< s, of the run
  int point = 1;       ///< 1 to wall_points, for P1..P4
  int family = 1;
  bool recruited = true;
};
/// An empty table with the columns of events.csv: time[s], point ("P1"), family[1], change ("recruited" or
/// "released").
Table event_table();
/// Appends one row to a table made by event_table; columns that were added after those are left to the
/// caller.
void append(Table& table, const Event& event);

/// Name and unit of the column that holds the derivative of a quantity by a scene parameter:
/// "d(pressure)/d(outlet.resistance)" and "(dyn/cm2)/(dyn s/cm5)"; the quantity's own unit when the
/// parameter has none.
struct ColumnHead {
  std::string name;
  std::string unit;
};
ColumnHead sensitivity_column(std::string_view quantity, std::string_view quantity_unit, std::string_view key,
                              std::string_view key_unit);
/// Adds such a column for each of the keys.
void add_sensitivity_columns(Table& table, std::string_view quantity, std::string_view quantity_unit,
                             const std::vector<std::string>& keys);

/// An empty table with the columns of sensitivities.csv, key by key; none without keys.
Table sensitivity_table(const std::vector<std::string>& keys);
/// Appends one row to a table made by sensitivity_table: the derivatives of a sample by each of its keys.
void append_sensitivities(Table& table, double time, const std::vector<Sample>& derivatives);

}  // namespace observables

/// Makes the folder, with its parents, and sees that files can be made in it. For use before a long
/// run. Throws OutputFailure naming the path and the system's reason.
void make_result_folder(const std::filesystem::path& folder);

/// Writes the result into a folder (made when missing): each file is written aside and renamed, so a
/// reader never sees half a file. record.json is taken away first and written last: where it is, the
/// files beside it belong to it. Tables without columns and series of fields without times have no file,
/// and files of an earlier run are removed: there all of fields/*.xdmf. Throws OutputFailure naming the path
/// and the system's reason.
void write_result(const std::filesystem::path& folder, const Scene& scene, const Result& result);

inline constexpr const char* record_file = "record.json";

/// What record.json is to say of a run, with the memory that the process has used.
nlohmann::ordered_json make_record(const Scene& scene, const RunRecord& run);

/// record.json of a folder written by write_result. Throws InvalidInput when it is missing or broken.
nlohmann::ordered_json read_record(const std::filesystem::path& folder);

/// Reads a folder written by write_result. Throws InvalidInput when something is missing or broken.
/// Profiles, events and sensitivities that were not written come back as tables without columns.
StoredResult read_result(const std::filesystem::path& folder);

/// The fields on cells in space (tetrahedra, hexahedra) that write_result put into a folder, by their files'
/// names; plane ones are passed over unread. Throws InvalidInput naming a file that is not as written.
std::vector<observables::FieldSeries> read_space_fields(const std::filesystem::path& folder);

/// Writes text to a file by way of a temporary file beside it (".NAME.PID.part", removed when writing
/// fails) and a rename, so that the file is the old or the new one, whole, at every moment, also after
/// a crash of the machine. Throws OutputFailure.
void write_whole(const std::filesystem::path& file, std::string_view text);

/// The same for text that comes in parts: `make` is called once and hands them over in order.
using Sink = std::function<void(std::string_view)>;
void write_whole(const std::filesystem::path& file, const std::function<void(const Sink&)>& make);

}  // namespace tunica
