// SPDX-License-Identifier: GPL-3.0-or-later
// The elastic-tube benchmark on meshes and with steps of several sizes, schemes and laws: the tables of
// docs/verification/elastic-tube.md, the traces as an SVG and as CSV, beside the published ones.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/observables/result.hpp"
#include "verification/line_chart.hpp"
#include "verification/page.hpp"
#include "verification/studies/elastic_tube_runs.hpp"
#include "verification/studies/study.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

constexpr std::array<double, 7> steps{8e-4, 4e-4, 2e-4, 1e-4, 5e-5, 2.5e-5, 1.25e-5};
struct Method {
  const char *scheme, *name;
};
constexpr std::array<Method, 3> methods{
    {{"bdf2", "BDF2"}, {"backward-euler", "backward Euler"}, {"generalized-alpha", "generalised-α"}}};
constexpr double usual_step = 5e-5;

using MeshStudy = std::vector<std::pair<StudyCase, TubeRun>>;  ///< a direction after the other
constexpr std::size_t meshes_a_direction = 4;

using StepStudy = std::map<std::pair<std::string, double>, TubeRun>;

TubeRun run_of(const Study& study, const StudyCase& of) {
  TubeRun run = tube_run(study.computed(of));
  fmt::print(stderr, "{}: {:.6f} mm at {:.4f} ms, {} unknowns, {} steps, {:.1f} s\n",
             fmt::join(of.overrides, " "), run.peak.displacement, 1e3 * run.peak.time, run.unknowns,
             run.steps, run.seconds);
  return run;
}

std::string cells_of(const StudyCase& of) {
  return fmt::format("{} x {}, {}", of.value("wall"), of.value("lumen"), of.value("axial"));
}
const std::string usual_cells = "2 x 4, 160";

std::string percent(double ours, double reference) {
  return fmt::format("{:+.2f} %", 100 * (ours / reference - 1));
}

struct Limits {
  TubePeak tube;                  ///< no step, no mesh
  double in_time;                 ///< what smaller steps add, mm
  std::array<double, 3> in_mesh;  ///< what smaller cells add, mm
};

std::string step_table(const StepStudy& study) {
  std::vector<std::string> header{"step [s]", "published, BDF2 [mm]", "at [ms]"};
  for (const Method& method : methods)
    header.insert(header.end(), {fmt::format("{} [mm]", method.name), "at [ms]"});
  std::vector<std::vector<std::string>> rows;
  const auto add = [](std::vector<std::string>& row, const TubePeak& peak, int digits) {
    row.insert(row.end(),
               {fmt::format("{:.4f}", peak.displacement), fmt::format("{:.{}f}", 1e3 * peak.time, digits)});
  };
  for (std::size_t k = 0; k < steps.size(); ++k) {
    std::vector<std::string> row{fmt::format("{:g}", steps[k])};
    if (k < published_tube.size())
      add(row, published_tube[k].peak, 1);
    else
      row.insert(row.end(), {"", ""});
    for (const Method& method : methods) add(row, study.at({method.scheme, steps[k]}).peak, 2);
    rows.push_back(row);
  }
  return markdown_table(header, rows);
}

/// The order that the peak shows with a step and the two before it.
std::string order_table(const StepStudy& study) {
  std::vector<std::string> header{"steps [s]", "published, BDF2"};
  for (const Method& method : methods) header.emplace_back(method.name);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 2; k < steps.size(); ++k) {
    std::vector<std::string> row{fmt::format("{:g}, {:g}, {:g}", steps[k - 2], steps[k - 1], steps[k])};
    const auto theirs = [](std::size_t at) { return published_tube[at].peak.displacement; };
    row.push_back(k < published_tube.size() ? order_text(theirs(k - 2), theirs(k - 1), theirs(k)) : "");
    for (const Method& method : methods) {
      const auto ours = [&](std::size_t at) {
        return study.at({method.scheme, steps[at]}).peak.displacement;
      };
      row.push_back(order_text(ours(k - 2), ours(k - 1), ours(k)));
    }
    rows.push_back(row);
  }
  return markdown_table(header, rows);
}

std::string mesh_table(const MeshStudy& on_meshes, const TubeRun& finest, const StudyCase& finest_case) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const std::string& refined, const StudyCase& of, const TubeRun& run,
                       const std::string& order) {
    rows.push_back({refined, cells_of(of), std::to_string(run.unknowns),
                    fmt::format("{:.5f}", run.peak.displacement), fmt::format("{:.3f}", 1e3 * run.peak.time),
                    order});
  };
  for (std::size_t k = 0; k < on_meshes.size(); ++k) {
    const auto& [of, run] = on_meshes[k];
    const auto peak = [&](std::size_t at) { return on_meshes[at].second.peak.displacement; };
    add(of.value("refined"), of, run,
        k % meshes_a_direction < 2 ? "" : order_text(peak(k - 2), peak(k - 1), peak(k)));
  }
  add("all", finest_case, finest, "");
  return markdown_table({"refined", "cells through wall x lumen, along", "unknowns", "peak [mm]", "at [ms]",
                         "order from three"},
                        rows);
}

/// The usual mesh and step, and what smaller steps and cells in each direction add. Order 2 for all: the
/// least that is observed.
Limits limits_of(const StepStudy& study, const MeshStudy& on_meshes) {
  const TubeRun& base = study.at({"bdf2", usual_step});
  const auto added = [](auto value, const TubeRun& coarse, const TubeRun& fine, const TubeRun& from) {
    return extrapolated(value(coarse), value(fine), 2) - value(from);
  };
  const auto displacement = [](const TubeRun& run) { return run.peak.displacement; };
  const auto time = [](const TubeRun& run) { return run.peak.time; };
  const TubeRun &coarse = study.at({"bdf2", 2.5e-5}), &fine = study.at({"bdf2", 1.25e-5});
  Limits limits{base.peak, added(displacement, coarse, fine, base), {}};
  limits.tube.time += added(time, coarse, fine, base);
  limits.tube.displacement += limits.in_time;
  for (std::size_t d = 0; d < limits.in_mesh.size(); ++d) {
    const std::size_t last = d * meshes_a_direction + meshes_a_direction - 1;
    const TubeRun &coarser = on_meshes[last - 1].second, &finer = on_meshes[last].second;
    limits.in_mesh[d] = added(displacement, coarser, finer, base);
    limits.tube.time += added(time, coarser, finer, base);
    limits.tube.displacement += limits.in_mesh[d];
  }
  return limits;
}

std::string limit_table(const Limits& limits, const MeshStudy& on_meshes) {
  const auto refined = [&](std::size_t d) {
    return on_meshes[d * meshes_a_direction].first.value("refined");
  };
  return markdown_table(
             {"limit for small steps and cells", "ours", "published", "difference", "bar"},
             {{"peak of the displacement [mm]", fmt::format("{:.4f}", limits.tube.displacement),
               fmt::format("{:.3f}", published_limit.displacement),
               percent(limits.tube.displacement, published_limit.displacement),
               fmt::format("{:g} %", 100 * displacement_bar)},
              {"its time [ms]", fmt::format("{:.2f}", 1e3 * limits.tube.time),
               fmt::format("{:.1f}", 1e3 * published_limit.time),
               percent(limits.tube.time, published_limit.time), fmt::format("{:g} %", 100 * time_bar)}}) +
         fmt::format(
             "Ours: cells {} at {:g} s, plus {:+.5f} mm for smaller steps, and for smaller cells {:+.5f} mm "
             "{}, {:+.5f} mm {} and {:+.5f} mm {}.\n\n",
             usual_cells, usual_step, limits.in_time, limits.in_mesh[0], refined(0), limits.in_mesh[1],
             refined(1), limits.in_mesh[2], refined(2));
}

std::string variant_table(const std::vector<StudyCase>& all, const std::vector<TubeRun>& runs,
                          const TubeTrace& published) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < all.size(); ++k)
    rows.push_back({all[k].value("name"), std::to_string(runs[k].steps),
                    fmt::format("{:.4f}", runs[k].peak.displacement),
                    fmt::format("{:.2f}", 1e3 * runs[k].peak.time),
                    fmt::format("{:.4f}", greatest_difference(runs[k].trace, published, 0.012)),
                    fmt::format("{:.4f}", greatest_difference(runs[k].trace, published, 0.02))});
  return markdown_table({"variant", "steps", "peak [mm]", "at [ms]",
                         "from the published trace at most, to 12 ms [mm]", "to 20 ms [mm]"},
                        rows);
}

std::vector<double> times(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

std::string picture(const StepStudy& study, const TubeTrace& published) {
  LineChart traces{
      "Elastic tube: inner wall at mid-length, BDF2", "time [ms]", "radial displacement [mm]", {}, false};
  for (const double step : {8e-4, 2e-4, 5e-5, 1.25e-5}) {
    const TubeTrace& trace = study.at({"bdf2", step}).trace;
    traces.series.push_back(
        {fmt::format("{:g} µs", 1e6 * step), times(trace.time, 1e3), trace.displacement, true, false});
  }
  traces.series.push_back(
      {"published, 50 µs", times(published.time, 1e3), published.displacement, false, true});
  LineChart peaks{"Its peak by the step", "step [µs]", "greatest radial displacement [mm]", {}, true};
  for (const Method& method : methods) {
    Series series{method.name, {}, {}, true, true};
    for (const double step : steps) {
      series.x.push_back(1e6 * step);
      series.y.push_back(study.at({method.scheme, step}).peak.displacement);
    }
    peaks.series.push_back(series);
  }
  Series theirs{"published, BDF2", {}, {}, true, true};
  for (const auto& [step, peak] : published_tube) {
    theirs.x.push_back(1e6 * step);
    theirs.y.push_back(peak.displacement);
  }
  peaks.series.push_back(theirs);
  return svg({traces, peaks}, 2);
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

}  // namespace

void tunica::verification::elastic_tube(const Study& study) {
  const Page page(study.out("docs/verification/elastic-tube.md"), "tables", "tools/study elastic-tube");
  const auto columns =
      observables::read_csv(study.source("notebooks_data/elastic_tube_published.csv").string());
  const TubeTrace published{columns[0].values, columns[1].values};

  StepStudy with_steps;
  for (const StudyCase& of : study.cases("steps"))
    with_steps[{of.value("scheme"), of.number("step")}] = run_of(study, of);
  MeshStudy on_meshes;
  for (const StudyCase& of : study.cases("cells")) on_meshes.emplace_back(of, run_of(study, of));
  const StudyCase& finest_case = study.cases("finest").front();
  const TubeRun finest = run_of(study, finest_case);
  std::vector<TubeRun> of_variants;
  for (const StudyCase& of : study.cases("variants")) {
    TubeRun run = run_of(study, of);
    run.trace.displacement = times(run.trace.displacement, of.number("factor"));
    run.peak.displacement *= of.number("factor");
    of_variants.push_back(run);
  }

  std::vector<std::pair<std::string, TubeTrace>> named;
  for (const Method& method : methods)
    for (const double step : steps)
      named.emplace_back(fmt::format("{}.{:g}s", method.scheme, step),
                         with_steps.at({method.scheme, step}).trace);
  named.emplace_back("finest_mesh", finest.trace);
  named.emplace_back("st_venant_kirchhoff", of_variants[1].trace);
  named.emplace_back("small_amplitude", of_variants[2].trace);

  const std::string tables =
      "### Limits\n\n" + limit_table(limits_of(with_steps, on_meshes), on_meshes) +
      fmt::format("### Steps\n\nCells {}.\n\n", usual_cells) + step_table(with_steps) +
      "Order that the peak shows:\n\n" + order_table(with_steps) +
      fmt::format("### Cells\n\nBDF2 with steps of {:g} s.\n\n", usual_step) +
      mesh_table(on_meshes, finest, finest_case) +
      fmt::format("### Variants\n\nCells {}; BDF2, steps of {:g} s unless said otherwise.\n\n", usual_cells,
                  usual_step) +
      variant_table(study.cases("variants"), of_variants, published);
  write_whole(study.out("docs/images/elastic-tube.svg"), picture(with_steps, published));
  write_whole(study.out("notebooks_data/elastic_tube.csv"), csv(named));
  page.write(tables);
}
