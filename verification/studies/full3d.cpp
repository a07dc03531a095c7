// SPDX-License-Identifier: GPL-3.0-or-later
// What the 3D tier's errors and times are: the cylinder against the 2D tier, the torus under a static
// pressure and over a beat on finer and finer meshes, and what it costs to solve for the mesh: the tables
// of docs/verification/full3d.md and the numbers as CSV.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "verification/page.hpp"
#include "verification/studies/study.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

constexpr int angles[] = {0, 90, 180, 270};

/// The numbers behind the tables.
class Numbers {
 public:
  Numbers() {
    for (const char* text : {"study", "case", "quantity", "unit"}) table_.add(text, "");
    table_.add("value", "1");
  }
  void keep(const std::string& study, const std::string& of, const std::string& quantity,
            const std::string& unit, double value) {
    std::size_t k = 0;
    for (const std::string& text : {study, of, quantity, unit}) table_[k++].labels.push_back(text);
    table_[k].values.push_back(value);
  }
  std::string csv() const { return observables::to_csv(table_); }

 private:
  observables::Table table_;
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

std::string cylinder(const Study& study, Numbers& numbers) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < study.cases("cylinder").size(); ++k) {
    const std::string& law = study.cases("cylinder")[k].value("law");
    const MeasuredRun solid = study.measured(study.cases("cylinder")[k]);
    StudyCase same = study.cases("plane")[k];
    for (const char* cells : {"wall_cells", "blood_cells", "axial_cells"})
      same.overrides.push_back(fmt::format("mesh.{}={}", cells, solid.count(cells)));
    const MeasuredRun plane = study.measured(same), fine = study.measured(study.cases("fine_plane")[k]);
    const double pressure = error_of("pressure", solid, plane),
                 displacement = error_of("radial_displacement.P1", solid, plane),
                 angle = difference("fiber_angle.P1", solid, plane), events = event_difference(solid, plane);
    const double pressure_fine = error_of("pressure", solid, fine),
                 displacement_fine = error_of("radial_displacement.P1", solid, fine);
    rows.push_back(
        {law, fmt::format("{}", solid.count("unknowns")), fmt::format("{}", solid.count("steps")),
         fmt::format("{}", solid.count("newton_iterations")), fmt::format("{:.0f}", solid.cost.wall_seconds),
         fmt::format("{:.0f}", solid.cost.mebibytes), shown(100 * pressure, "{:.3f}"),
         shown(100 * displacement, "{:.3f}"), shown(angle, "{:.4f}"), shown(1000 * events, "{:.3f}"),
         shown(100 * pressure_fine, "{:.3f}"), shown(100 * displacement_fine, "{:.3f}")});
    for (const auto& [quantity, unit, value] :
         {std::tuple{"pressure", "1", pressure},
          {"radial_displacement.P1", "1", displacement},
          {"fiber_angle.P1", "deg", angle},
          {"events", "s", events},
          {"pressure against 0.1 %", "1", pressure_fine},
          {"radial_displacement.P1 against 0.1 %", "1", displacement_fine},
          {"wall clock", "s", solid.cost.wall_seconds}})
      numbers.keep("cylinder", law, quantity, unit, value);
  }
  return markdown_table(
      {"law", "unknowns", "steps", "Newton iterations", "wall clock [s]", "MiB", "pressure [%]",
       "inner displacement [%]", "fibre angle [deg]", "recruitment times [ms]", "pressure, finer 2D [%]",
       "inner displacement, finer 2D [%]"},
      rows);
}

std::string displacement_name(int point, int angle) {
  const std::string name = fmt::format("radial_displacement.P{}", point);
  return angle == 0 ? name : fmt::format("{}.{}deg", name, angle);
}

/// Inner and outer displacement at the four angles of mid-bend under 100 mmHg.
std::string static_torus(const Study& study, Numbers& numbers) {
  std::vector<std::vector<std::string>> rows;
  std::vector<double> before;
  std::string law_before;
  for (const StudyCase& of : study.cases("static_torus")) {
    const std::string &law = of.value("law"), &mesh = of.value("mesh");
    if (law != law_before) before.clear();
    law_before = law;
    const MeasuredRun run = study.measured(of);
    std::vector<double> found;
    for (const int point : {1, 4})
      for (const int angle : angles) {
        if (angle == 270) continue;  // the mirror image of 90
        found.push_back(column(run, displacement_name(point, angle)).front());
      }
    rows.push_back(
        {law, mesh, fmt::format("{}", run.count("unknowns")), fmt::format("{:.1f}", run.cost.wall_seconds)});
    double change = observables::none;
    for (std::size_t k = 0; k < found.size(); ++k) {
      rows.back().push_back(fmt::format("{:.6f}", found[k]));
      if (!before.empty()) change = std::fmax(change, std::abs(found[k] / before[k] - 1));
      numbers.keep("static torus", law + " " + mesh, displacement_name(k < 3 ? 1 : 4, angles[k % 3]), "cm",
                   found[k]);
    }
    rows.back().push_back(shown(100 * change, "{:.3f}"));
    before = found;
  }
  return markdown_table({"law", "cells through the wall x along x around", "unknowns", "wall clock [s]",
                         "inner, outside of the bend [cm]", "inner, side", "inner, inside of the bend",
                         "outer, outside", "outer, side", "outer, inside", "greatest change [%]"},
                        rows);
}

/// One beat with recruitment, from rest: the inner displacement at mid-bend on finer and finer meshes.
std::string beating_torus(const Study& study, Numbers& numbers) {
  const auto& cases = study.cases("beating_torus");
  std::vector<MeasuredRun> runs;
  for (const StudyCase& of : cases) runs.push_back(study.measured(of));
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    rows.push_back({cases[k].value("mesh"), fmt::format("{}", runs[k].count("unknowns")),
                    fmt::format("{}", runs[k].count("steps")),
                    fmt::format("{:.0f}", runs[k].cost.wall_seconds),
                    fmt::format("{:.0f}", runs[k].cost.mebibytes)});
    for (const int angle : angles) {
      if (angle == 270) continue;
      const std::string name = displacement_name(1, angle);
      const auto& values = column(runs[k], name);
      const double greatest = *std::max_element(values.begin(), values.end());
      const double error = k + 1 < runs.size() ? error_of(name, runs[k], runs.back()) : observables::none;
      rows.back().push_back(fmt::format("{:.6f}", greatest));
      rows.back().push_back(shown(100 * error, "{:.3f}"));
      numbers.keep("torus", cases[k].value("mesh"), "greatest " + name, "cm", greatest);
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
std::string geometry(const Study& study) {
  std::vector<std::vector<std::string>> rows;
  std::vector<MeasuredRun> runs;  // of one vessel, the implicit one first
  for (const StudyCase& of : study.cases("choices")) {
    if (of.value("geometry") == "implicit") runs.clear();
    const MeasuredRun& run = runs.emplace_back(study.measured(of));
    rows.push_back({of.scene, of.value("geometry"), fmt::format("{}", run.count("unknowns")),
                    fmt::format("{}", run.count("factor_entries")), fmt::format("{}", run.count("steps")),
                    fmt::format("{}", run.count("newton_iterations")),
                    fmt::format("{}", run.count("factorisations")),
                    fmt::format("{:.1f}", run.cost.cpu_seconds)});
    for (const char* name : {"pressure", "radial_displacement.P1"})
      rows.back().push_back(runs.size() > 1 ? shown(100 * error_of(name, run, runs.front()), "{:.4f}") : "");
  }
  return markdown_table(
      {"vessel", "solver.geometry", "unknowns", "entries of factors", "steps", "Newton iterations",
       "factorisations", "CPU [s]", "pressure, difference [%]", "inner displacement, difference [%]"},
      rows);
}

}  // namespace

void tunica::verification::full3d_geometry(const Study& study) {
  const Page page(study.out("docs/verification/full3d.md"), "geometry tables", "tools/study full3d-geometry");
  page.write(geometry(study));
}

void tunica::verification::full3d_vessels(const Study& study) {
  const Page page(study.out("docs/verification/full3d.md"), "tables", "tools/study full3d");
  Numbers numbers;
  std::string text = "### The cylinder, against the 2D tier\n\n";
  text += cylinder(study, numbers);
  text += "### The torus under 100 mmHg\n\n";
  text += static_torus(study, numbers);
  text += "### The torus over a beat, EXP1+EXP2-FS\n\n";
  text += beating_torus(study, numbers);
  page.write(text);
  write_whole(study.out("notebooks_data/full3d.csv"), numbers.csv());
}
