// SPDX-License-Identifier: GPL-3.0-or-later
// tunica_full3d_study PROGRAM SCENES PAGE CSV: what the 3D tier's errors and times are: the cylinder against
// the 2D tier, the torus under a static pressure and over a beat on finer and finer meshes. Every run is one
// of PROGRAM (tunica), timed from outside. Writes the tables of docs/verification/full3d.md and the numbers
// as CSV. Without CSV: only what it costs to solve for the mesh.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "verification/measured_run.hpp"
#include "verification/page.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

using Overrides = std::vector<std::string>;

const std::vector<std::string> laws{"EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS"};
constexpr int angles[] = {0, 90, 180, 270};

class Study {
 public:
  Study(std::filesystem::path program, std::filesystem::path scenes)
      : program_(std::move(program)),
        scenes_(std::move(scenes)),
        folder_(std::filesystem::temp_directory_path() / fmt::format("tunica-full3d-{}", ::getpid())) {
    numbers_.add("study", "");
    numbers_.add("case", "");
    numbers_.add("quantity", "");
    numbers_.add("unit", "");
    numbers_.add("value", "1");
  }
  ~Study() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  MeasuredRun run(const std::string& scene, const std::string& tier, Overrides overrides) const {
    overrides.emplace_back("output.field_interval=0");
    MeasuredRun run = measured_run(program_, scenes_ / (scene + ".toml"), tier, overrides, folder_);
    fmt::print(stderr, "{} {} {}: {} unknowns, {} steps, {:.1f} s\n", scene, tier, fmt::join(overrides, " "),
               run.count("unknowns"), run.count("steps"), run.wall_seconds);
    return run;
  }

  void keep(const std::string& study, const std::string& of, const std::string& quantity,
            const std::string& unit, double value) {
    std::size_t k = 0;
    for (const std::string& text : {study, of, quantity, unit}) numbers_[k++].labels.push_back(text);
    numbers_[k].values.push_back(value);
  }
  std::string csv() const { return observables::to_csv(numbers_); }

 private:
  std::filesystem::path program_, scenes_, folder_;
  observables::Table numbers_;
};

const std::vector<double>& column(const MeasuredRun& run, const std::string& name) {
  const observables::Column* found = run.stored.result.observables.find(name);
  if (!found) throw std::runtime_error("observables without " + name);
  return found->values;
}

/// Greatest difference of a column over all rows, in its own unit; `none` where there is nothing.
double difference(const std::string& name, const MeasuredRun& a, const MeasuredRun& b) {
  const auto &ours = column(a, name), &theirs = column(b, name);
  double greatest = observables::none;
  for (std::size_t k = 0; k < ours.size(); ++k)
    if (!observables::is_none(theirs[k])) greatest = std::fmax(greatest, std::abs(ours[k] - theirs[k]));
  return greatest;
}

std::string shown(double value, const char* format) {
  return observables::is_none(value) ? "" : fmt::format(fmt::runtime(format), value);
}

std::string cylinder(Study& study) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& law : laws) {
    const MeasuredRun solid = study.run("cylinder", "full3d", {"wall.law=" + law});
    Overrides same{"wall.law=" + law};
    for (const char* cells : {"wall_cells", "blood_cells", "axial_cells"})
      same.push_back(fmt::format("mesh.{}={}", cells, solid.count(cells)));
    const MeasuredRun plane = study.run("cylinder", "axisym", same);
    const MeasuredRun fine = study.run("cylinder", "axisym", {"wall.law=" + law, "accuracy.tolerance=0.001"});
    const double pressure = error_of("pressure", solid, plane),
                 displacement = error_of("radial_displacement.P1", solid, plane),
                 angle = difference("fiber_angle.P1", solid, plane), events = event_difference(solid, plane);
    const double pressure_fine = error_of("pressure", solid, fine),
                 displacement_fine = error_of("radial_displacement.P1", solid, fine);
    rows.push_back({law, fmt::format("{}", solid.count("unknowns")), fmt::format("{}", solid.count("steps")),
                    fmt::format("{}", solid.count("newton_iterations")),
                    fmt::format("{:.0f}", solid.wall_seconds), fmt::format("{:.0f}", solid.mebibytes),
                    shown(100 * pressure, "{:.3f}"), shown(100 * displacement, "{:.3f}"),
                    shown(angle, "{:.4f}"), shown(1000 * events, "{:.3f}"),
                    shown(100 * pressure_fine, "{:.3f}"), shown(100 * displacement_fine, "{:.3f}")});
    for (const auto& [quantity, unit, value] :
         {std::tuple{"pressure", "1", pressure},
          {"radial_displacement.P1", "1", displacement},
          {"fiber_angle.P1", "deg", angle},
          {"events", "s", events},
          {"pressure against 0.1 %", "1", pressure_fine},
          {"radial_displacement.P1 against 0.1 %", "1", displacement_fine},
          {"wall clock", "s", solid.wall_seconds}})
      study.keep("cylinder", law, quantity, unit, value);
  }
  return markdown_table(
      {"law", "unknowns", "steps", "Newton iterations", "wall clock [s]", "MiB", "pressure [%]",
       "inner displacement [%]", "fibre angle [deg]", "recruitment times [ms]", "pressure, finer 2D [%]",
       "inner displacement, finer 2D [%]"},
      rows);
}

struct MeshCells {
  int wall, blood, axial, around;
  Overrides overrides() const {
    return {fmt::format("mesh.wall_cells={}", wall), fmt::format("mesh.blood_cells={}", blood),
            fmt::format("mesh.axial_cells={}", axial), fmt::format("mesh.around_cells={}", around)};
  }
  std::string text() const { return fmt::format("{} x {} x {}", wall, axial, around); }
};

std::string displacement_name(int point, int angle) {
  const std::string name = fmt::format("radial_displacement.P{}", point);
  return angle == 0 ? name : fmt::format("{}.{}deg", name, angle);
}

/// Inner and outer displacement at the four angles of mid-bend under 100 mmHg.
std::string static_torus(Study& study) {
  const std::vector<MeshCells> meshes{{2, 1, 14, 8}, {4, 1, 20, 8}, {4, 1, 20, 16}, {6, 1, 28, 16}};
  std::vector<std::vector<std::string>> rows;
  for (const std::string law : {"EXP1+EXP2-ZS", "EXP1+EXP2-FS"}) {
    std::vector<double> before;
    for (const MeshCells& mesh : meshes) {
      Overrides overrides = mesh.overrides();
      overrides.insert(overrides.end(), {"wall.law=" + law, "time.mode=static", "inlet.waveform=pressure",
                                         "inlet.pressure=100 mmHg"});
      const MeasuredRun run = study.run("torus", "full3d", overrides);
      std::vector<double> found;
      for (const int point : {1, 4})
        for (const int angle : angles) {
          if (angle == 270) continue;  // the mirror image of 90
          found.push_back(column(run, displacement_name(point, angle)).front());
        }
      rows.push_back({law, mesh.text(), fmt::format("{}", run.count("unknowns")),
                      fmt::format("{:.1f}", run.wall_seconds)});
      double change = observables::none;
      for (std::size_t k = 0; k < found.size(); ++k) {
        rows.back().push_back(fmt::format("{:.6f}", found[k]));
        if (!before.empty()) change = std::fmax(change, std::abs(found[k] / before[k] - 1));
        study.keep("static torus", law + " " + mesh.text(), displacement_name(k < 3 ? 1 : 4, angles[k % 3]),
                   "cm", found[k]);
      }
      rows.back().push_back(shown(100 * change, "{:.3f}"));
      before = found;
    }
  }
  return markdown_table({"law", "cells through the wall x along x around", "unknowns", "wall clock [s]",
                         "inner, outside of the bend [cm]", "inner, side", "inner, inside of the bend",
                         "outer, outside", "outer, side", "outer, inside", "greatest change [%]"},
                        rows);
}

/// One beat with recruitment, from rest: the inner displacement at mid-bend on finer and finer meshes.
std::string beating_torus(Study& study) {
  const std::vector<MeshCells> meshes{{2, 1, 14, 8}, {3, 2, 14, 8}, {4, 2, 20, 16}};
  std::vector<MeasuredRun> runs;
  for (const MeshCells& mesh : meshes) {
    Overrides overrides = mesh.overrides();
    overrides.emplace_back("time.beats=1");
    runs.push_back(study.run("torus", "full3d", overrides));
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    rows.push_back({meshes[k].text(), fmt::format("{}", runs[k].count("unknowns")),
                    fmt::format("{}", runs[k].count("steps")), fmt::format("{:.0f}", runs[k].wall_seconds),
                    fmt::format("{:.0f}", runs[k].mebibytes)});
    for (const int angle : angles) {
      if (angle == 270) continue;
      const std::string name = displacement_name(1, angle);
      const auto& values = column(runs[k], name);
      const double greatest = *std::max_element(values.begin(), values.end());
      const double error = k + 1 < runs.size() ? error_of(name, runs[k], runs.back()) : observables::none;
      rows.back().push_back(fmt::format("{:.6f}", greatest));
      rows.back().push_back(shown(100 * error, "{:.3f}"));
      study.keep("torus", meshes[k].text(), "greatest " + name, "cm", greatest);
    }
    rows.back().push_back(
        k + 1 < runs.size() ? shown(100 * error_of("pressure", runs[k], runs.back()), "{:.3f}") : "");
  }
  return markdown_table(
      {"cells through the wall x along x around", "unknowns", "steps", "wall clock [s]", "MiB",
       "greatest inner displacement, outside of the bend [cm]", "difference [%]", "side [cm]",
       "difference [%]", "inside [cm]", "difference [%]", "pressure, difference [%]"},
      rows);
}

/// The mesh that is solved for with all else, and the one that lags: what both cost over a beat from rest,
/// and how far they are apart.
std::string geometry(Study& study) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string scene : {"cylinder", "torus"}) {
    std::vector<MeasuredRun> runs;
    for (const std::string choice : {"implicit", "lagged"}) {
      const MeasuredRun& run =
          runs.emplace_back(study.run(scene, "full3d", {"time.beats=1", "solver.geometry=" + choice}));
      rows.push_back({scene, choice, fmt::format("{}", run.count("unknowns")),
                      fmt::format("{}", run.count("factor_entries")), fmt::format("{}", run.count("steps")),
                      fmt::format("{}", run.count("newton_iterations")),
                      fmt::format("{}", run.count("factorisations")),
                      fmt::format("{:.1f}", run.cpu_seconds)});
      for (const char* name : {"pressure", "radial_displacement.P1"})
        rows.back().push_back(runs.size() > 1 ? shown(100 * error_of(name, run, runs.front()), "{:.4f}")
                                              : "");
    }
  }
  return markdown_table(
      {"vessel", "solver.geometry", "unknowns", "entries of factors", "steps", "Newton iterations",
       "factorisations", "CPU [s]", "pressure, difference [%]", "inner displacement, difference [%]"},
      rows);
}

void write_geometry(char** arguments) {
  const Page page(arguments[3], "geometry tables", "tunica_full3d_study");
  Study study(arguments[1], arguments[2]);
  page.write(geometry(study));
}

void write_all(char** arguments) {
  const Page page(arguments[3], "tables", "tunica_full3d_study");
  Study study(arguments[1], arguments[2]);
  std::string text = "### The cylinder, against the 2D tier\n\n";
  text += cylinder(study);
  text += "### The torus under 100 mmHg\n\n";
  text += static_torus(study);
  text += "### The torus over a beat, EXP1+EXP2-FS\n\n";
  text += beating_torus(study);
  page.write(text);
  write_whole(arguments[4], study.csv());
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4 && count != 5) {
    fmt::print(stderr, "usage: tunica_full3d_study PROGRAM SCENES PAGE [CSV]\n");
    return 2;
  }
  try {
    write_geometry(arguments);
    if (count == 5) write_all(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "tunica_full3d_study: {}\n", error.what());
    return 2;
  }
  return 0;
}
