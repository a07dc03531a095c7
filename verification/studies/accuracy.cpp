// SPDX-License-Identifier: GPL-3.0-or-later
// What the 2D tier's error and time are for the paper's cylinder, by law, tolerance, element and scheme:
// the tables of docs/verification/axisym.md, a chart of error over time, and the numbers as CSV.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "verification/line_chart.hpp"
#include "verification/page.hpp"
#include "verification/studies/study.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

const std::vector<std::string> columns{"pressure",       "radial_displacement.P1", "outflow",
                                       "fiber_angle.P1", "fiber_stretch.P4",       "transmural_pressure",
                                       "von_mises.P1",   "von_mises.P2",           "von_mises.P4"};
/// What accuracy.tolerance promises, and the times that are asked of it on two cores, s.
struct Bar {
  double tolerance, seconds;
};
constexpr Bar bars[] = {{1e-2, 2}, {1e-3, 10}};

struct Outcome {
  StudyCase of;
  MeasuredRun run;
  std::vector<double> errors;  ///< of the columns
};

std::string percent(double error) {
  return observables::is_none(error) ? "" : fmt::format("{:.3f}", 100 * error);
}

std::string tolerance_table(const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> rows;
  for (const Outcome& o : outcomes) {
    rows.push_back(
        {o.of.value("law"), o.of.value("tolerance"),
         fmt::format("{} x {}, {}", o.run.count("wall_cells"), o.run.count("blood_cells"),
                     o.run.count("axial_cells")),
         fmt::format("{}", o.run.count("unknowns")),
         fmt::format("{} ({})", o.run.count("steps"), o.run.count("rejected_steps")),
         fmt::format("{}", o.run.count("newton_iterations")),
         fmt::format("{}", o.run.count("factorisations")), fmt::format("{:.2f}", o.run.cost.wall_seconds),
         fmt::format("{:.2f}", o.run.cost.cpu_seconds), fmt::format("{:.0f}", o.run.cost.mebibytes)});
    for (const double error : o.errors) rows.back().push_back(percent(error));
  }
  std::vector<std::string> header{"law",
                                  "tolerance",
                                  "cells through wall x lumen, along",
                                  "unknowns",
                                  "steps (rejected)",
                                  "Newton iterations",
                                  "factorisations",
                                  "wall clock [s]",
                                  "CPU [s]",
                                  "MiB"};
  for (const std::string& column : columns) header.push_back("`" + column + "` [%]");
  return markdown_table(header, rows);
}

std::string bar_table(const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> rows;
  for (const Bar& bar : bars)
    for (const Outcome& o : outcomes) {
      if (o.of.number("tolerance") != bar.tolerance) continue;
      const double worst = std::max(o.errors[0], o.errors[1]);
      const bool kept =
          worst <= bar.tolerance && o.run.cost.wall_seconds <= bar.seconds && o.run.cost.mebibytes <= 1024;
      rows.push_back({fmt::format("{:g} % within {:g} s and 1024 MiB", 100 * bar.tolerance, bar.seconds),
                      o.of.value("law"), fmt::format("{} %", percent(worst)),
                      fmt::format("{:.2f} s", o.run.cost.wall_seconds),
                      fmt::format("{:.0f} MiB", o.run.cost.mebibytes), kept ? "kept" : "missed"});
    }
  return markdown_table({"bar", "law", "error of pressure and inner displacement", "time", "memory", ""},
                        rows);
}

std::string choice_table(const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> rows;
  for (const Outcome& o : outcomes) {
    rows.push_back(
        {o.of.series,
         o.of.values.contains("step") ? o.of.value("step") + " s" : "tolerance " + o.of.value("tolerance"),
         fmt::format("{}", o.run.count("unknowns")), fmt::format("{}", o.run.count("steps")),
         fmt::format("{:.2f}", o.run.cost.wall_seconds)});
    for (const double error : o.errors) rows.back().push_back(percent(error));
  }
  std::vector<std::string> header{"element, scheme", "step", "unknowns", "steps", "wall clock [s]"};
  for (const std::string& column : columns) header.push_back("`" + column + "` [%]");
  return markdown_table(header, rows);
}

LineChart chart(const std::string& title, const std::vector<Outcome>& outcomes) {
  LineChart chart{title, "wall clock [s]", "error of the inner displacement [% of its range]", {}, true,
                  true};
  std::map<std::string, std::size_t> places;
  for (const Outcome& o : outcomes) {
    const auto [place, is_new] = places.try_emplace(o.of.series, chart.series.size());
    if (is_new) chart.series.push_back({o.of.series, {}, {}, true, true});
    Series& series = chart.series[place->second];
    series.x.push_back(o.run.cost.wall_seconds);
    series.y.push_back(100 * o.errors[1]);
  }
  return chart;
}

/// The numbers behind tables and chart that do not depend on the machine, and the times of this one.
std::string csv(const std::vector<Outcome>& outcomes) {
  observables::Table table;
  table.add("series", "");
  table.add("law", "");
  table.add("setting", "");
  for (const char* count : {"unknowns", "steps", "newton_iterations", "factorisations"})
    table.add(count, "1");
  table.add("wall_clock", "s");
  for (const std::string& column : columns) table.add("error." + column, "1");
  for (const Outcome& o : outcomes) {
    std::size_t k = 0;
    for (const std::string& text :
         {o.of.series, o.of.value("law"), fmt::format("{}", fmt::join(o.of.overrides, " "))})
      table[k++].labels.push_back(text);
    for (const char* count : {"unknowns", "steps", "newton_iterations", "factorisations"})
      table[k++].values.push_back(static_cast<double>(o.run.count(count)));
    table[k++].values.push_back(o.run.cost.wall_seconds);
    for (const double error : o.errors) table[k++].values.push_back(error);
  }
  return observables::to_csv(table);
}

/// With twice the cells of a tolerance of 0.1 % in each direction.
std::map<std::string, MeasuredRun> references(const Study& study) {
  std::map<std::string, MeasuredRun> all;
  const auto& at_bar = study.cases("at_bar");
  for (std::size_t k = 0; k < at_bar.size(); ++k) {
    const MeasuredRun coarse = study.measured(at_bar[k]);
    StudyCase fine = study.cases("references")[k];
    for (const char* cells : {"wall_cells", "blood_cells", "axial_cells"})
      fine.overrides.push_back(fmt::format("mesh.{}={}", cells, 2 * coarse.count(cells)));
    all.emplace(fine.value("law"), study.measured(fine));
  }
  return all;
}

}  // namespace

void tunica::verification::accuracy(const Study& study) {
  const Page page(study.out("docs/verification/axisym.md"), "tables", "tools/study accuracy");
  const auto finest = references(study);
  const auto outcomes_of = [&](std::string_view group) {
    std::vector<Outcome> outcomes;
    for (const StudyCase& of : study.cases(group)) {
      Outcome outcome{of, study.measured(of), {}};
      for (const std::string& column : columns)
        outcome.errors.push_back(error_of(column, outcome.run, finest.at(of.value("law"))));
      outcomes.push_back(std::move(outcome));
    }
    return outcomes;
  };
  std::vector<Outcome> tolerances = outcomes_of("tolerances");
  const std::vector<Outcome> choices = outcomes_of("choices");
  std::vector<std::vector<std::string>> reference_rows;
  for (const auto& [law, run] : finest)
    reference_rows.push_back({law, fmt::format("{}", run.count("unknowns")),
                              fmt::format("{}", run.count("steps")),
                              fmt::format("{:.0f}", run.cost.wall_seconds)});
  page.write("### Bars\n\n" + bar_table(tolerances) + "### Tolerances\n\n" + tolerance_table(tolerances) +
             "### Elements and schemes\n\nLaw EXP1+EXP2-FS; BDF2 with automatic steps, or quadratic elements "
             "with fixed ones.\n\n" +
             choice_table(choices) + "### References\n\n" +
             markdown_table({"law", "unknowns", "steps", "wall clock [s]"}, reference_rows));
  write_whole(study.out("docs/images/accuracy.svg"),
              svg({chart("Tolerances, four laws", tolerances),
                   chart("Elements and schemes, EXP1+EXP2-FS", choices)}));
  tolerances.insert(tolerances.end(), choices.begin(), choices.end());
  write_whole(study.out("notebooks_data/accuracy.csv"), csv(tolerances));
}
