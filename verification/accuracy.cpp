// SPDX-License-Identifier: GPL-3.0-or-later
// tunica_accuracy PROGRAM SCENE PAGE PICTURE CSV: what the 2D tier's error and time are for the paper's
// cylinder, by law, tolerance, element and scheme. Every run is one of PROGRAM (tunica), timed from outside.
// Writes the tables of docs/verification/axisym.md, a chart of error over time, and the numbers as CSV.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cmath>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "verification/line_chart.hpp"
#include "verification/measured_run.hpp"
#include "verification/page.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

const std::vector<std::string> laws{"EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS"};
const std::vector<std::string> columns{"pressure",       "radial_displacement.P1", "outflow",
                                       "fiber_angle.P1", "fiber_stretch.P4",       "transmural_pressure",
                                       "von_mises.P1",   "von_mises.P2",           "von_mises.P4"};
/// What accuracy.tolerance promises, and the times that are asked of it on two cores, s.
struct Bar {
  double tolerance, seconds;
};
constexpr Bar bars[] = {{1e-2, 2}, {1e-3, 10}};

struct Case {
  std::string series;  ///< of the chart
  std::string law;
  std::vector<std::string> overrides;
};

/// Tolerances as they are, all else as the program chooses it.
std::vector<Case> tolerance_cases() {
  std::vector<Case> cases;
  for (const std::string& law : laws)
    for (const char* tolerance : {"0.01", "0.003", "0.001"})
      cases.push_back({law, law, {std::string("accuracy.tolerance=") + tolerance}});
  return cases;
}

/// Elements and schemes, with the law whose fibres are recruited on the way.
std::vector<Case> choice_cases() {
  const std::string law = "EXP1+EXP2-FS";
  std::vector<Case> cases;
  for (const char* tolerance : {"0.03", "0.01", "0.003", "0.001"})
    cases.push_back({"quadratic", law, {std::string("accuracy.tolerance=") + tolerance}});
  for (const char* element : {"linear", "bubble"})
    for (const char* tolerance : {"0.03", "0.01", "0.003"})
      cases.push_back(
          {element,
           law,
           {std::string("mesh.element=") + element, std::string("accuracy.tolerance=") + tolerance}});
  for (const char* scheme : {"bdf2", "backward-euler", "generalized-alpha"})
    for (const char* step : {"0.016", "0.008", "0.004", "0.002", "0.001"})
      cases.push_back({std::string("fixed ") + scheme,
                       law,
                       {std::string("time.scheme=") + scheme, std::string("time.step=") + step,
                        "accuracy.tolerance=0.001"}});
  return cases;
}

class Study {
 public:
  Study(std::filesystem::path program, std::filesystem::path scene)
      : program_(std::move(program)),
        scene_(std::move(scene)),
        folder_(std::filesystem::temp_directory_path() / fmt::format("tunica-accuracy-{}", ::getpid())) {}
  ~Study() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  MeasuredRun run(const std::string& law, std::vector<std::string> overrides) const {
    overrides.push_back("wall.law=" + law);
    const MeasuredRun run = measured_run(program_, scene_, "axisym", overrides, folder_);
    fmt::print(stderr, "{}: {} unknowns, {} steps, {:.2f} s\n", fmt::join(overrides, " "),
               run.count("unknowns"), run.count("steps"), run.wall_seconds);
    return run;
  }

  /// Twice the cells of a tolerance of 0.1 % in each direction, and a quarter of its steps or less: errors of
  /// steps fall with their cube, and a third is left for steps that are bounded otherwise.
  MeasuredRun reference(const std::string& law) const {
    const MeasuredRun at_bar = run(law, {"accuracy.tolerance=0.001", "output.field_interval=0"});
    std::vector<std::string> overrides{fmt::format("accuracy.tolerance={:g}", 1e-3 / 85),
                                       "output.field_interval=0"};
    for (const char* cells : {"wall_cells", "blood_cells", "axial_cells"})
      overrides.push_back(fmt::format("mesh.{}={}", cells, 2 * at_bar.count(cells)));
    return run(law, overrides);
  }

 private:
  std::filesystem::path program_, scene_, folder_;
};

struct Outcome {
  Case of;
  MeasuredRun run;
  std::vector<double> errors;  ///< of the columns
};

std::string percent(double error) {
  return observables::is_none(error) ? "" : fmt::format("{:.3f}", 100 * error);
}

std::string setting(const Case& of, const std::string& key) {
  for (const std::string& text : of.overrides)
    if (text.starts_with(key + "=")) return text.substr(key.size() + 1);
  return "";
}

std::string tolerance_table(const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> rows;
  for (const Outcome& o : outcomes) {
    rows.push_back({o.of.law, setting(o.of, "accuracy.tolerance"),
                    fmt::format("{} x {}, {}", o.run.count("wall_cells"), o.run.count("blood_cells"),
                                o.run.count("axial_cells")),
                    fmt::format("{}", o.run.count("unknowns")),
                    fmt::format("{} ({})", o.run.count("steps"), o.run.count("rejected_steps")),
                    fmt::format("{}", o.run.count("newton_iterations")),
                    fmt::format("{}", o.run.count("factorisations")),
                    fmt::format("{:.2f}", o.run.wall_seconds), fmt::format("{:.2f}", o.run.cpu_seconds),
                    fmt::format("{:.0f}", o.run.mebibytes)});
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
      if (std::stod(setting(o.of, "accuracy.tolerance")) != bar.tolerance) continue;
      const double worst = std::max(o.errors[0], o.errors[1]);
      const bool kept =
          worst <= bar.tolerance && o.run.wall_seconds <= bar.seconds && o.run.mebibytes <= 1024;
      rows.push_back({fmt::format("{:g} % within {:g} s and 1024 MiB", 100 * bar.tolerance, bar.seconds),
                      o.of.law, fmt::format("{} %", percent(worst)),
                      fmt::format("{:.2f} s", o.run.wall_seconds), fmt::format("{:.0f} MiB", o.run.mebibytes),
                      kept ? "kept" : "missed"});
    }
  return markdown_table({"bar", "law", "error of pressure and inner displacement", "time", "memory", ""},
                        rows);
}

std::string choice_table(const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> rows;
  for (const Outcome& o : outcomes) {
    const std::string step = setting(o.of, "time.step");
    rows.push_back({o.of.series,
                    step.empty() ? "tolerance " + setting(o.of, "accuracy.tolerance") : step + " s",
                    fmt::format("{}", o.run.count("unknowns")), fmt::format("{}", o.run.count("steps")),
                    fmt::format("{:.2f}", o.run.wall_seconds)});
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
    series.x.push_back(o.run.wall_seconds);
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
    for (const std::string& text : {o.of.series, o.of.law, fmt::format("{}", fmt::join(o.of.overrides, " "))})
      table[k++].labels.push_back(text);
    for (const char* count : {"unknowns", "steps", "newton_iterations", "factorisations"})
      table[k++].values.push_back(static_cast<double>(o.run.count(count)));
    table[k++].values.push_back(o.run.wall_seconds);
    for (const double error : o.errors) table[k++].values.push_back(error);
  }
  return observables::to_csv(table);
}

void write_all(char** arguments) {
  const Page page(arguments[3], "tables", "tunica_accuracy");
  const Study study(arguments[1], arguments[2]);
  std::map<std::string, MeasuredRun> references;
  for (const std::string& law : laws) references.emplace(law, study.reference(law));
  const auto outcomes_of = [&](const std::vector<Case>& cases) {
    std::vector<Outcome> outcomes;
    for (const Case& of : cases) {
      Outcome outcome{of, study.run(of.law, of.overrides), {}};
      for (const std::string& column : columns)
        outcome.errors.push_back(error_of(column, outcome.run, references.at(of.law)));
      outcomes.push_back(std::move(outcome));
    }
    return outcomes;
  };
  std::vector<Outcome> tolerances = outcomes_of(tolerance_cases());
  const std::vector<Outcome> choices = outcomes_of(choice_cases());
  std::vector<std::vector<std::string>> reference_rows;
  for (const std::string& law : laws) {
    const MeasuredRun& r = references.at(law);
    reference_rows.push_back({law, fmt::format("{}", r.count("unknowns")),
                              fmt::format("{}", r.count("steps")), fmt::format("{:.0f}", r.wall_seconds)});
  }
  page.write("### Bars\n\n" + bar_table(tolerances) + "### Tolerances\n\n" + tolerance_table(tolerances) +
             "### Elements and schemes\n\nLaw EXP1+EXP2-FS; BDF2 with automatic steps, or quadratic elements "
             "with fixed ones.\n\n" +
             choice_table(choices) + "### References\n\n" +
             markdown_table({"law", "unknowns", "steps", "wall clock [s]"}, reference_rows));
  write_whole(arguments[4], svg({chart("Tolerances, four laws", tolerances),
                                 chart("Elements and schemes, EXP1+EXP2-FS", choices)}));
  tolerances.insert(tolerances.end(), choices.begin(), choices.end());
  write_whole(arguments[5], csv(tolerances));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 6) {
    fmt::print(stderr, "usage: tunica_accuracy PROGRAM SCENE PAGE PICTURE CSV\n");
    return 2;
  }
  try {
    write_all(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "tunica_accuracy: {}\n", error.what());
    return 2;
  }
  return 0;
}
