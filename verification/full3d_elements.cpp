// SPDX-License-Identifier: GPL-3.0-or-later
// tunica_full3d_elements PROGRAM SCENES FOLDER PAGE PICTURE CSV: the errors that elements in space make on
// the paper's cylinder, by unknowns and processor time, the paper's own among them, against a fine run of the
// 2D tier. Every run is one of PROGRAM (tunica) on one core, kept in FOLDER: what is whole there is not run
// again. Writes the tables of docs/verification/elements-in-space.md, its picture and the numbers as CSV.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "verification/line_chart.hpp"
#include "verification/measured_run.hpp"
#include "verification/page.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace fs = std::filesystem;

namespace {

struct Case {
  std::string series, name, scene, tier;
  std::vector<std::string> overrides;
};

const std::vector<std::string> columns{"pressure",       "transmural_pressure", "radial_displacement.P1",
                                       "fiber_angle.P1", "von_mises.P1",        "von_mises.P2"};
constexpr std::size_t displacement_column = 2, stress_column = 5;

/// As many cells as the paper's mesh has along each direction, divided.
Case bubble(int divisor, const std::string& symmetry) {
  const int cells[] = {4 / divisor, divisor == 1 ? 3 : 2 / (divisor / 2), 2 * ((170 / divisor + 1) / 2),
                       32 / divisor};
  return {"bubble, the paper's",
          divisor == 1 ? "paper" : fmt::format("paper_{}_{}", divisor, symmetry),
          "cylinder_paper_mesh",
          "full3d",
          {"mesh.symmetry=" + symmetry, fmt::format("mesh.wall_cells={}", cells[0]),
           fmt::format("mesh.blood_cells={}", cells[1]), fmt::format("mesh.axial_cells={}", cells[2]),
           fmt::format("mesh.around_cells={}", cells[3])}};
}

Case by_tolerance(const std::string& series, const std::string& name, const std::string& tolerance,
                  std::vector<std::string> choice, const std::string& tier = "full3d") {
  choice.insert(choice.end(), {"accuracy.tolerance=" + tolerance, "time.beats=1", "output.field_interval=0"});
  return {series, name + "_" + tolerance, "cylinder_zs", tier, std::move(choice)};
}

Case with_recruitment(Case of) {
  of.name = "recruitment_" + of.name;
  of.overrides.insert(of.overrides.begin(), "wall.law=EXP1+EXP2-FS");
  return of;
}

std::vector<Case> space_cases() {
  std::vector<Case> cases;
  for (const int divisor : {4, 2, 1}) cases.push_back(bubble(divisor, "quarter"));
  for (const char* tolerance : {"0.05", "0.02"})
    cases.push_back(by_tolerance("linear tetrahedra", "linear_tetrahedra", tolerance,
                                 {"mesh.element=linear", "mesh.cell=triangle"}));
  for (const char* tolerance : {"0.05", "0.02"})
    cases.push_back(by_tolerance("linear hexahedra", "linear", tolerance, {"mesh.element=linear"}));
  for (const char* tolerance : {"0.05", "0.01", "0.003"})
    cases.push_back(by_tolerance("quadratic tetrahedra", "tetrahedra", tolerance, {"mesh.cell=triangle"}));
  for (const char* tolerance : {"0.05", "0.01", "0.001"})
    cases.push_back(by_tolerance("quadratic hexahedra", "hexahedra", tolerance, {}));
  return cases;
}

/// With the law whose fibres are recruited on the way.
std::vector<Case> recruitment_cases() {
  std::vector<Case> cases;
  for (const int divisor : {4, 2}) cases.push_back(bubble(divisor, "quarter"));
  for (const char* tolerance : {"0.05", "0.01"})
    cases.push_back(by_tolerance("quadratic hexahedra", "hexahedra", tolerance, {}));
  for (Case& of : cases) of = with_recruitment(std::move(of));
  return cases;
}

/// Runs that are kept, with what they took when they ran.
class Study {
 public:
  Study(fs::path program, fs::path scenes, fs::path folder)
      : program_(std::move(program)), scenes_(std::move(scenes)), folder_(std::move(folder)) {
    fs::create_directories(folder_);
  }

  MeasuredRun run(const Case& of) const {
    const fs::path folder = folder_ / of.name, costs = folder_ / (of.name + ".json");
    const bool is_kept = fs::exists(costs);
    MeasuredRun run = measured_run(program_, scenes_ / (of.scene + ".toml"), of.tier, of.overrides, folder,
                                   is_kept ? Folder::resumed : Folder::anew);
    if (is_kept) {
      const auto kept = nlohmann::json::parse(std::ifstream(costs));
      run.wall_seconds = kept.at("wall_seconds");
      run.cpu_seconds = kept.at("cpu_seconds");
      run.mebibytes = kept.at("mebibytes");
    } else {
      const nlohmann::json kept{
          {"wall_seconds", run.wall_seconds}, {"cpu_seconds", run.cpu_seconds}, {"mebibytes", run.mebibytes}};
      write_whole(costs, kept.dump() + "\n");
    }
    fmt::print(stderr, "{}: {} unknowns, {} steps, {:.1f} s of processor time\n", of.name,
               run.count("unknowns"), run.count("steps"), run.cpu_seconds);
    return run;
  }

 private:
  fs::path program_, scenes_, folder_;
};

struct Outcome {
  Case of;
  MeasuredRun run;
  std::vector<double> errors;  ///< of the columns, of their range
  double events;               ///< greatest difference of a time of recruitment or release, s
};

Outcome outcome(const Study& study, const Case& of, const MeasuredRun& reference) {
  Outcome found{of, study.run(of), {}, observables::none};
  for (const std::string& column : columns) found.errors.push_back(error_of(column, found.run, reference));
  found.events = event_difference(found.run, reference);
  return found;
}

std::string cells_of(const MeasuredRun& run) {
  const std::string section = fmt::format("{} + {} x {}", run.count("wall_cells"), run.count("blood_cells"),
                                          run.count("axial_cells"));
  const long around = run.count("around_cells");
  return around > 0 ? fmt::format("{} x {}", section, around) : section;
}

std::vector<std::string> row_of(const Outcome& o) {
  std::vector<std::string> row{o.of.series,
                               cells_of(o.run),
                               fmt::format("{}", o.run.count("unknowns")),
                               fmt::format("{}", o.run.count("steps")),
                               fmt::format("{:.0f}", o.run.cpu_seconds),
                               fmt::format("{:.0f}", o.run.mebibytes)};
  for (const double error : o.errors) row.push_back(fmt::format("{:.3g}", 100 * error));
  return row;
}

std::string events_of(const Outcome& o) {
  return std::isinf(o.events) ? "others" : fmt::format("{:.3g}", 1000 * o.events);
}

std::string table_of(const std::vector<Outcome>& outcomes, bool with_events = false) {
  std::vector<std::string> header{"elements",      "cells through the wall + lumen x along x around",
                                  "unknowns",      "steps",
                                  "processor [s]", "MiB"};
  for (const std::string& column : columns) header.push_back("`" + column + "` [%]");
  if (with_events) header.emplace_back("recruitment times [ms]");
  std::vector<std::vector<std::string>> rows;
  for (const Outcome& o : outcomes) {
    rows.push_back(row_of(o));
    if (with_events) rows.back().push_back(events_of(o));
  }
  return markdown_table(header, rows);
}

LineChart chart(const std::vector<Outcome>& outcomes, std::size_t column, const std::string& quantity,
                bool by_time) {
  LineChart chart{quantity,
                  by_time ? "processor time of a beat [s]" : "unknowns (a quarter of the artery)",
                  "error [% of the range]",
                  {},
                  true,
                  true};
  for (const Outcome& o : outcomes) {
    if (chart.series.empty() || chart.series.back().name != o.of.series)
      chart.series.push_back({o.of.series, {}, {}, true, true});
    Series& series = chart.series.back();
    series.x.push_back(by_time ? o.run.cpu_seconds : static_cast<double>(o.run.count("unknowns")));
    series.y.push_back(100 * o.errors[column]);
  }
  return chart;
}

std::string csv(const std::vector<Outcome>& outcomes) {
  observables::Table table;
  for (const char* text : {"series", "tier", "scene", "setting", "version", "commit"}) table.add(text, "");
  for (const char* count : {"unknowns", "wall_cells", "blood_cells", "axial_cells", "around_cells", "steps",
                            "newton_iterations", "factorisations"})
    table.add(count, "1");
  table.add("processor_time", "s");
  table.add("peak_memory", "MiB");
  for (const std::string& column : columns) table.add("error." + column, "1");
  table.add("error.events", "s");
  for (const Outcome& o : outcomes) {
    std::size_t k = 0;
    for (const std::string& text :
         {o.of.series, o.of.tier, o.of.scene, fmt::format("{}", fmt::join(o.of.overrides, " ")),
          o.run.stored.record.at("version").get<std::string>(),
          o.run.stored.record.at("commit").get<std::string>()})
      table[k++].labels.push_back(text);
    for (const char* count : {"unknowns", "wall_cells", "blood_cells", "axial_cells", "around_cells", "steps",
                              "newton_iterations", "factorisations"})
      table[k++].values.push_back(static_cast<double>(o.run.count(count)));
    table[k++].values.push_back(o.run.cpu_seconds);
    table[k++].values.push_back(o.run.mebibytes);
    for (const double error : o.errors) table[k++].values.push_back(error);
    table[k].values.push_back(o.events);
  }
  return observables::to_csv(table);
}

void write_all(char** arguments) {
  const Page page(arguments[4], "tables", "tunica_full3d_elements");
  const Study study(arguments[1], arguments[2], arguments[3]);
  const MeasuredRun reference = study.run(by_tolerance("reference", "plane", "0.0001", {}, "axisym"));
  std::vector<Outcome> outcomes, others;
  for (const Case& of : space_cases()) outcomes.push_back(outcome(study, of, reference));
  others.push_back(outcome(study, by_tolerance("2D tier", "plane", "0.001", {}, "axisym"), reference));
  others.push_back(outcome(
      study, by_tolerance("2D tier, steps of 1 ms", "plane_steps", "0.001", {"time.step=0.001"}, "axisym"),
      reference));
  const MeasuredRun recruiting =
      study.run(with_recruitment(by_tolerance("reference", "plane", "0.0001", {}, "axisym")));
  std::vector<Outcome> recruited;
  for (const Case& of : recruitment_cases()) recruited.push_back(outcome(study, of, recruiting));
  const MeasuredRun whole = study.run(bubble(4, "full")), quarter = study.run(bubble(4, "quarter"));
  std::vector<std::vector<std::string>> alike;
  for (const std::string& column : columns)
    alike.push_back({"`" + column + "`", fmt::format("{:.2g}", 100 * error_of(column, quarter, whole)),
                     fmt::format("{:.2g}", 100 * error_of(column, quarter, reference))});
  page.write(
      "### In space\n\n" + table_of(outcomes) + "### In two dimensions\n\n" + table_of(others) +
      fmt::format("The reference: the 2D tier at a tolerance of 0.01 %, cells {}, {} unknowns, {} "
                  "steps.\n\n",
                  cells_of(reference), reference.count("unknowns"), reference.count("steps")) +
      "### With recruitment at finite strain\n\nThe same with EXP1+EXP2-FS, of as fine a reference.\n\n" +
      table_of(recruited, true) + "### A quarter for the whole\n\nThe paper's elements on " +
      cells_of(whole) + " cells.\n\n" +
      markdown_table({"", "quarter against whole [%]", "quarter against the reference [%]"}, alike));
  write_whole(arguments[5],
              svg({chart(outcomes, displacement_column, "Inner displacement", true),
                   chart(outcomes, displacement_column, "Inner displacement", false),
                   chart(outcomes, stress_column, "Von Mises stress at a third of the wall", true),
                   chart(outcomes, stress_column, "Von Mises stress at a third of the wall", false)}));
  outcomes.insert(outcomes.end(), others.begin(), others.end());
  outcomes.insert(outcomes.end(), recruited.begin(), recruited.end());
  write_whole(arguments[6], csv(outcomes));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 7) {
    fmt::print(stderr, "usage: tunica_full3d_elements PROGRAM SCENES FOLDER PAGE PICTURE CSV\n");
    return 2;
  }
  try {
    write_all(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "tunica_full3d_elements: {}\n", error.what());
    return 2;
  }
  return 0;
}
