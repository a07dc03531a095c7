// SPDX-License-Identifier: GPL-3.0-or-later
// tunica_elastic_tube SCENE PUBLISHED PAGE PICTURE CSV: the elastic-tube benchmark on meshes and with steps
// of several sizes, schemes and laws. Writes the tables of docs/verification/elastic-tube.md between its
// marks, the traces as an SVG and as CSV. PUBLISHED is notebooks_data/elastic_tube_published.csv.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "axisym/axisym_tier.hpp"
#include "core/observables/result.hpp"
#include "verification/elastic_tube_runs.hpp"
#include "verification/line_chart.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

constexpr std::string_view first_mark = "<!-- tables: written by tunica_elastic_tube, do not edit -->\n";
constexpr std::string_view last_mark = "<!-- end of tables -->\n";

constexpr std::array<double, 7> steps{8e-4, 4e-4, 2e-4, 1e-4, 5e-5, 2.5e-5, 1.25e-5};
constexpr std::array<const char*, 3> schemes{"bdf2", "backward-euler", "generalized-alpha"};
constexpr double usual_step = 5e-5;

struct Cells {
  int wall, blood, axial;
  std::string name() const { return fmt::format("{} x {}, {}", wall, blood, axial); }
};
constexpr Cells usual{2, 4, 80};
constexpr Cells meshes[] = {{1, 2, 20}, {2, 4, 40}, {4, 8, 80}, {8, 16, 160}};

using Study = std::map<std::pair<std::string, double>, TubeRun>;

class Tube {
 public:
  explicit Tube(std::filesystem::path scene) : scene_(std::move(scene)) {}

  TubeRun run(const Cells& cells, double step, std::vector<std::string> more) const {
    more.insert(
        more.end(),
        {fmt::format("mesh.wall_cells={}", cells.wall), fmt::format("mesh.blood_cells={}", cells.blood),
         fmt::format("mesh.axial_cells={}", cells.axial), fmt::format("time.step={}", step)});
    const TubeRun run = run_tube(tier_, scene_, more);
    fmt::print(stderr, "{}: {:.6f} mm at {:.4f} ms, {} unknowns, {} steps, {:.1f} s\n", fmt::join(more, " "),
               run.peak.displacement, 1e3 * run.peak.time, run.unknowns, run.steps, run.seconds);
    return run;
  }

 private:
  axisym::AxisymTier tier_;
  std::filesystem::path scene_;
};

std::string percent(double ours, double reference) {
  return fmt::format("{:+.2f} %", 100 * (ours / reference - 1));
}

std::string table(const std::string& head, const std::vector<std::string>& rows) {
  std::string rule = "|";
  for (std::size_t k = 1; k < head.size(); ++k) rule += head[k] == '|' ? "---|" : "";
  return fmt::format("{}\n{}\n{}\n\n", head, rule, fmt::join(rows, "\n"));
}

struct Limits {
  TubePeak tube;            ///< no step, no mesh
  double in_time, in_mesh;  ///< what the extrapolations added, mm
};

std::string step_table(const Study& study) {
  const auto peak = [&](const char* scheme, double step) { return study.at({scheme, step}).peak; };
  std::vector<std::string> rows;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    std::string row = fmt::format("| {:g} | ", steps[k]);
    row += k < published_tube.size() ? fmt::format("{:.4f} | {:.1f} ", published_tube[k].peak.displacement,
                                                   1e3 * published_tube[k].peak.time)
                                     : "| ";
    for (const char* scheme : schemes)
      row += fmt::format("| {:.4f} | {:.2f} ", peak(scheme, steps[k]).displacement,
                         1e3 * peak(scheme, steps[k]).time);
    rows.push_back(row + "|");
  }
  return table(
      "| step [s] | published, BDF2 [mm] | at [ms] | BDF2 [mm] | at [ms] | backward Euler [mm] | at [ms] | "
      "generalised-α [mm] | at [ms] |",
      rows);
}

std::string mesh_table(const std::vector<TubeRun>& runs) {
  std::vector<std::string> rows;
  for (std::size_t k = 0; k < runs.size(); ++k)
    rows.push_back(fmt::format("| {} | {} | {:.5f} | {:.2f} | {} |", meshes[k].name(), runs[k].unknowns,
                               runs[k].peak.displacement, 1e3 * runs[k].peak.time,
                               k < 2 ? ""
                                     : fmt::format("{:.1f}", observed_order(runs[k - 2].peak.displacement,
                                                                            runs[k - 1].peak.displacement,
                                                                            runs[k].peak.displacement))));
  return table("| cells through wall x lumen, along | unknowns | peak [mm] | at [ms] | order from three |",
               rows);
}

Limits limits_of(const Study& study, const std::vector<TubeRun>& on_meshes) {
  const auto in_time = [&](auto value) {
    return extrapolated(value(study.at({"bdf2", 2.5e-5})), value(study.at({"bdf2", 1.25e-5})), 2) -
           value(study.at({"bdf2", usual_step}));
  };
  const auto on_mesh = [&](auto value) {
    return extrapolated(value(on_meshes[on_meshes.size() - 2]), value(on_meshes.back()), 3);
  };
  const auto displacement = [](const TubeRun& run) { return run.peak.displacement; };
  const auto time = [](const TubeRun& run) { return run.peak.time; };
  Limits limits{};
  limits.in_time = in_time(displacement);
  limits.in_mesh = on_mesh(displacement) - on_meshes.back().peak.displacement;
  limits.tube = {on_mesh(time) + in_time(time), on_mesh(displacement) + limits.in_time};
  return limits;
}

std::string limit_table(const Limits& limits) {
  std::vector<std::string> rows{
      fmt::format("| peak of the displacement [mm] | {:.4f} | {:.3f} | {} | 1.5 % |",
                  limits.tube.displacement, published_limit.displacement,
                  percent(limits.tube.displacement, published_limit.displacement)),
      fmt::format("| its time [ms] | {:.2f} | {:.1f} | {} | 2 % |", 1e3 * limits.tube.time,
                  1e3 * published_limit.time, percent(limits.tube.time, published_limit.time))};
  return table("| limit for small steps and cells | ours | published | difference | bar |", rows) +
         fmt::format(
             "Ours: the finest mesh at {:g} s, plus {:+.5f} mm for what smaller cells would add (order 3) "
             "and "
             "{:+.5f} mm for smaller steps (BDF2, order 2).\n\n",
             usual_step, limits.in_mesh, limits.in_time);
}

struct Variant {
  std::string name;
  std::vector<std::string> overrides;
  double step = usual_step;
  double factor = 1;  ///< on the displacement
};

std::vector<Variant> variants() {
  return {{"linear elastic wall", {}},
          {"St. Venant-Kirchhoff wall", {"wall.law=St-Venant-Kirchhoff"}},
          {"a hundredth of the pressure, displacement times 100", {"inlet.pressure=133.32"}, usual_step, 100},
          {"pulse of 3.05 ms", {"inlet.duration=3.05e-3"}},
          {"automatic steps, accuracy.tolerance = 1 %", {"accuracy.tolerance=0.01"}, 0},
          {"automatic steps, accuracy.tolerance = 0.1 %", {"accuracy.tolerance=1e-3"}, 0}};
}

std::string variant_table(const std::vector<TubeRun>& runs, const TubeTrace& published) {
  std::vector<std::string> rows;
  const auto all = variants();
  for (std::size_t k = 0; k < all.size(); ++k)
    rows.push_back(fmt::format("| {} | {} | {:.4f} | {:.2f} | {:.3f} | {:.3f} |", all[k].name, runs[k].steps,
                               runs[k].peak.displacement, 1e3 * runs[k].peak.time,
                               greatest_difference(runs[k].trace, published, 0.012),
                               greatest_difference(runs[k].trace, published, 0.02)));
  return table(
      "| variant | steps | peak [mm] | at [ms] | from the published trace at most, to 12 ms [mm] | to 20 ms "
      "[mm] |",
      rows);
}

std::string picture(const Study& study, const TubeTrace& published) {
  const auto milliseconds = [](std::vector<double> times) {
    for (double& t : times) t *= 1e3;
    return times;
  };
  LineChart traces{
      "Elastic tube: inner wall at mid-length, BDF2", "time [ms]", "radial displacement [mm]", {}, false};
  for (const double step : {8e-4, 2e-4, 5e-5, 1.25e-5}) {
    const TubeTrace& trace = study.at({"bdf2", step}).trace;
    traces.series.push_back(
        {fmt::format("{:g} s", step), milliseconds(trace.time), trace.displacement, true, false});
  }
  traces.series.push_back(
      {"published, 5e-05 s", milliseconds(published.time), published.displacement, false, true});
  LineChart peaks{"Its peak by the step", "step [s]", "greatest radial displacement [mm]", {}, true};
  for (const char* scheme : schemes) {
    Series series{scheme, {}, {}, true, true};
    for (const double step : steps) {
      series.x.push_back(step);
      series.y.push_back(study.at({scheme, step}).peak.displacement);
    }
    peaks.series.push_back(series);
  }
  Series theirs{"published, BDF2", {}, {}, true, true};
  for (const auto& [step, peak] : published_tube) {
    theirs.x.push_back(step);
    theirs.y.push_back(peak.displacement);
  }
  peaks.series.push_back(theirs);
  return svg({traces, peaks});
}

/// Every 0.1 ms of the runs with a name.
std::string csv(const std::vector<std::pair<std::string, TubeTrace>>& traces) {
  observables::Table all;
  all.add("time", "s");
  for (const auto& named : traces) all.add(named.first, "mm");
  constexpr int rows = 200;
  for (int k = 0; k <= rows; ++k) {
    const double time = 1e-4 * k;
    all[0].values.push_back(time);
    for (std::size_t c = 0; c < traces.size(); ++c)
      // Digits beyond these are of no use, and change with the compiler.
      all[c + 1].values.push_back(std::round(1e6 * traces[c].second.at(time)) / 1e6);
  }
  return observables::to_csv(all);
}

std::string with_tables(const std::string& page, const std::string& tables) {
  const std::size_t begin = page.find(first_mark), end = page.find(last_mark);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw std::runtime_error(fmt::format("the page lacks the marks {} and {}", first_mark, last_mark));
  return page.substr(0, begin + first_mark.size()) + "\n" + tables + page.substr(end);
}

void write_all(char** arguments) {
  std::ifstream file(arguments[3]);
  if (!file) throw std::runtime_error(fmt::format("{} cannot be read", arguments[3]));
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const auto columns = observables::read_csv(arguments[2]);
  const TubeTrace published{columns[0].values, columns[1].values};

  const Tube tube(arguments[1]);
  Study study;
  for (const char* scheme : schemes)
    for (const double step : steps)
      study[{scheme, step}] = tube.run(usual, step, {std::string("time.scheme=") + scheme});
  std::vector<TubeRun> on_meshes, of_variants;
  for (const Cells& mesh : meshes) on_meshes.push_back(tube.run(mesh, usual_step, {}));
  for (const Variant& variant : variants()) {
    TubeRun run = tube.run(usual, variant.step, variant.overrides);
    for (double& u : run.trace.displacement) u *= variant.factor;
    run.peak.displacement *= variant.factor;
    of_variants.push_back(run);
  }

  std::vector<std::pair<std::string, TubeTrace>> named;
  for (const char* scheme : schemes)
    for (const double step : steps)
      named.emplace_back(fmt::format("{}.{:g}s", scheme, step), study.at({scheme, step}).trace);
  named.emplace_back("finest_mesh", on_meshes.back().trace);
  named.emplace_back("st_venant_kirchhoff", of_variants[1].trace);
  named.emplace_back("small_amplitude", of_variants[2].trace);

  const std::string tables =
      "### Limits\n\n" + limit_table(limits_of(study, on_meshes)) +
      fmt::format("### Steps\n\nCells {}.\n\n", usual.name()) + step_table(study) +
      fmt::format("### Cells\n\nBDF2 with steps of {:g} s.\n\n", usual_step) + mesh_table(on_meshes) +
      fmt::format("### Variants\n\nCells {}; BDF2, steps of {:g} s unless said otherwise.\n\n", usual.name(),
                  usual_step) +
      variant_table(of_variants, published);
  write_whole(arguments[4], picture(study, published));
  write_whole(arguments[5], csv(named));
  write_whole(arguments[3], with_tables(page, tables));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 6) {
    fmt::print(stderr, "usage: tunica_elastic_tube SCENE PUBLISHED PAGE PICTURE CSV\n");
    return 2;
  }
  try {
    write_all(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "tunica_elastic_tube: {}\n", error.what());
    return 2;
  }
  return 0;
}
