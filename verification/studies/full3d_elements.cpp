// SPDX-License-Identifier: GPL-3.0-or-later
// The errors that elements in space make on the paper's cylinder, by unknowns and processor time, the
// paper's own among them, against a fine run of the 2D tier: the tables of docs/verification/elements-in-
// space.md, its picture and the numbers as CSV.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>
#include <vector>

#include "verification/line_chart.hpp"
#include "verification/page.hpp"
#include "verification/studies/study.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

const std::vector<std::string> columns{"pressure",       "transmural_pressure", "radial_displacement.P1",
                                       "fiber_angle.P1", "von_mises.P1",        "von_mises.P2"};
constexpr std::size_t displacement_column = 2, stress_column = 5;

struct Outcome {
  StudyCase of;
  MeasuredRun run;
  std::vector<double> errors;  ///< of the columns, of their range
  double events;               ///< greatest difference of a time of recruitment or release, s
};

Outcome outcome(const Study& study, const StudyCase& of, const MeasuredRun& reference) {
  Outcome found{of, study.measured(of), {}, observables::none};
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
                               fmt::format("{:.0f}", o.run.cost.cpu_seconds),
                               fmt::format("{:.0f}", o.run.cost.mebibytes)};
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
    series.x.push_back(by_time ? o.run.cost.cpu_seconds : static_cast<double>(o.run.count("unknowns")));
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
    table[k++].values.push_back(o.run.cost.cpu_seconds);
    table[k++].values.push_back(o.run.cost.mebibytes);
    for (const double error : o.errors) table[k++].values.push_back(error);
    table[k].values.push_back(o.events);
  }
  return observables::to_csv(table);
}

std::vector<Outcome> outcomes_of(const Study& study, std::string_view group, const MeasuredRun& reference) {
  std::vector<Outcome> outcomes;
  for (const StudyCase& of : study.cases(group)) outcomes.push_back(outcome(study, of, reference));
  return outcomes;
}

}  // namespace

void tunica::verification::full3d_elements(const Study& study) {
  const Page page(study.out("docs/verification/elements-in-space.md"), "tables",
                  "tools/study full3d-elements");
  const MeasuredRun reference = study.measured(study.cases("reference").at(0));
  std::vector<Outcome> outcomes = outcomes_of(study, "space", reference);
  const std::vector<Outcome> others = outcomes_of(study, "plane", reference);
  const MeasuredRun recruiting = study.measured(study.cases("reference").at(1));
  const std::vector<Outcome> recruited = outcomes_of(study, "recruitment", recruiting);
  const MeasuredRun whole = study.measured(study.cases("whole").front()),
                    quarter = study.measured(study.cases("quarter").front());
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
  write_whole(study.out("docs/images/elements-in-space.svg"),
              svg({chart(outcomes, displacement_column, "Inner displacement", true),
                   chart(outcomes, displacement_column, "Inner displacement", false),
                   chart(outcomes, stress_column, "Von Mises stress at a third of the wall", true),
                   chart(outcomes, stress_column, "Von Mises stress at a third of the wall", false)}));
  outcomes.insert(outcomes.end(), others.begin(), others.end());
  outcomes.insert(outcomes.end(), recruited.begin(), recruited.end());
  write_whole(study.out("notebooks_data/full3d_elements.csv"), csv(outcomes));
}
