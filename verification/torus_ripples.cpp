// SPDX-License-Identifier: GPL-3.0-or-later
// tunica_torus_ripples PAGE SCENE PICTURE CSV: the first beat of the torus with the printed tether in space,
// on meshes of the paper's elements and others. Writes the table of docs/verification/tether-stability.md
// between its marks, ripples along the outside of the bend over time and at the end as an SVG and as CSV.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "core/observables/build_info.hpp"
#include "core/observables/result.hpp"
#include "core/units.hpp"
#include "full3d/full3d_tier.hpp"
#include "full3d/petsc.hpp"
#include "verification/line_chart.hpp"
#include "verification/page.hpp"
#include "verification/ripple_lines.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

constexpr double thickness = 0.01;  // cm

struct Case {
  std::string name;
  double bend;  ///< degrees, of the torus of 0.66 cm for 180
  double end;   ///< s
  std::vector<std::string> overrides;

  double length() const { return 0.66 * bend / 180; }
};

std::vector<std::string> cells(int wall, int blood, int axial, int around) {
  return {fmt::format("mesh.wall_cells={}", wall), fmt::format("mesh.blood_cells={}", blood),
          fmt::format("mesh.axial_cells={}", axial), fmt::format("mesh.around_cells={}", around),
          "time.step=1e-3"};
}

std::vector<Case> cases() {
  const auto bubble = [](std::vector<std::string> overrides) {
    overrides.emplace_back("mesh.element=bubble");
    return overrides;
  };
  return {{"quadratic", 60, 0.12, cells(3, 2, 14, 8)},
          {"quadratic", 60, 0.12, cells(3, 2, 28, 8)},
          {"bubble, the paper's density", 60, 0.12, bubble(cells(4, 3, 56, 32))}};
}

struct Outcome {
  Case of;
  Result result;
  std::vector<LumenLine> lines;
  std::string ended;
};

Outcome outcome_of(const std::filesystem::path& file, const Case& of) {
  std::vector<double> times;
  for (double t = 0.02; t < of.end - 1e-9; t += 0.002) times.push_back(t);
  std::vector<std::string> overrides = of.overrides;
  overrides.insert(overrides.end(),
                   {"tether.traction=reference", fmt::format("geometry.bend_angle={}", of.bend),
                    fmt::format("geometry.length={}", of.length()), "time.beats=1", "output.field_interval=0",
                    fmt::format("output.profile_times=[{:.3f}]", fmt::join(times, ","))});
  const Scene scene = read_scene(file, overrides);
  // A run that has lost its smooth solution crawls: it is ended where it has shown that.
  constexpr long most_iterations = 450;
  Progress now;
  RunControl control;
  control.report = [&](const Progress& progress) { now = progress; };
  control.interrupted = [&] { return now.time >= of.end || now.newton_iterations > most_iterations; };
  const full3d::Ranks ranks;
  full3d::Team team(ranks);
  Outcome outcome{of, full3d::Full3dTier(team).prepare(scene)->execute(control), {}, {}};
  outcome.ended = fmt::format("at {:g} s", of.end);
  outcome.lines = lumen_lines(outcome.result.along);
  if (!outcome.result.record.failure.empty())
    outcome.ended = fmt::format("gave up at {:.3f} s", now.time);
  else if (now.time < of.end)
    outcome.ended =
        fmt::format("stopped after {} Newton iterations at {:.3f} s", now.newton_iterations, now.time);
  fmt::print(stderr, "{}: {} steps, {} {}\n", of.name, outcome.result.record.steps, outcome.ended,
             outcome.result.record.failure);
  return outcome;
}

/// Length of the unloaded cells at mid-bend, in thicknesses: the lines of along.csv are their ends and, of
/// quadratic ones, their middles.
double middle_cell(const Outcome& o) {
  const auto& z = o.lines.front().z;
  const std::size_t middle = z.size() / 2;
  const double places =
      static_cast<double>(z.size() - 1) / o.result.record.resolution.at("axial_cells").get<double>();
  return places * (z[middle + 1] - z[middle]) / thickness;
}

double pressure_at(const Outcome& o, double time) {
  const auto& times = o.result.observables.find("time")->values;
  const auto& pressure = o.result.observables.find("pressure")->values;
  const auto row = std::lower_bound(times.begin(), times.end(), time - 1e-9) - times.begin();
  return pressure[std::min(static_cast<std::size_t>(row), pressure.size() - 1)] / mmhg;
}

/// Of the thickness: from there on a ripple is one. Less is left of the bending of the ends in a short piece.
constexpr double visible = 0.05;

std::string table(const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> rows;
  for (const Outcome& o : outcomes) {
    std::vector<std::string> row{
        o.of.name, fmt::format("{:g}", o.of.bend),
        fmt::format("{} x {} x {}", o.result.record.resolution.at("wall_cells").get<int>(),
                    o.result.record.resolution.at("axial_cells").get<int>(),
                    o.result.record.resolution.at("around_cells").get<int>()),
        fmt::format("{:.1f}", middle_cell(o)), fmt::format("{}", o.result.record.unknowns)};
    const auto ripples_at = [&](const LumenLine& line) {
      return ripples(line, o.of.length()).amplitude > visible * thickness;
    };
    const auto first = std::find_if(o.lines.begin(), o.lines.end(), ripples_at);
    row.push_back(first == o.lines.end()
                      ? "–"
                      : fmt::format("{:.3f} s, {:.0f} mmHg", first->time, pressure_at(o, first->time)));
    const Ripples last = ripples(o.lines.back(), o.of.length());
    row.push_back(fmt::format("{:.2g} h", last.amplitude / thickness));
    row.push_back(last.amplitude > visible * thickness && last.wave_length > 0
                      ? fmt::format("{:.1f} h", last.wave_length / thickness)
                      : "–");
    row.push_back(fmt::format("{}, {:.0f} mmHg", o.ended, pressure_at(o, INFINITY)));
    rows.push_back(row);
  }
  return markdown_table(
      {"Elements", "Bend, °", "Cells through the wall x along x around", "Cell at mid-bend, h", "Unknowns",
       "Ripples > 0.05 h from", "Amplitude at the end", "Wave length", "Ended"},
      rows);
}

std::string label(const Outcome& o) {
  return fmt::format("{}, {} cells along {:g}°", o.of.name,
                     o.result.record.resolution.at("axial_cells").get<int>(), o.of.bend);
}

/// How ripples grow, and the lumen at the end.
std::string picture(const std::vector<Outcome>& outcomes) {
  LineChart growth{
      "Ripples along the outside of the bend", "time [s]", "amplitude [thicknesses]", {}, false, true};
  std::vector<LineChart> charts;
  for (const Outcome& o : outcomes) {
    growth.series.push_back({label(o), {}, {}});
    for (const LumenLine& line : o.lines) {
      growth.series.back().x.push_back(line.time);
      growth.series.back().y.push_back(std::max(1e-6, ripples(line, o.of.length()).amplitude / thickness));
    }
    const LumenLine& last = o.lines.back();
    LineChart lumen{fmt::format("{}, {:.3f} s", label(o), last.time),
                    "along the outside of the bend [cm]",
                    "lumen radius [cm]",
                    {{"", last.z, last.radius}}};
    lumen.y_range = {0.03, 0.06};
    charts.push_back(lumen);
  }
  charts.insert(charts.begin(), growth);
  return svg(charts, 2);
}

std::string csv(const std::vector<Outcome>& outcomes) {
  observables::Table all;
  for (const char* text : {"elements", "commit"}) all.add(text, "");
  all.add("bend", "deg");
  all.add("axial_cells", "1");
  all.add("time", "s");
  all.add("pressure", "mmHg");
  for (const char* size : {"amplitude", "wave_length"}) all.add(size, "cm");
  for (const Outcome& o : outcomes)
    for (const LumenLine& line : o.lines) {
      const Ripples found = ripples(line, o.of.length());
      all[0].labels.push_back(o.of.name);
      all[1].labels.emplace_back(program_commit());
      const double axial_cells = o.result.record.resolution.at("axial_cells");
      std::size_t column = 2;
      for (const double value :
           {o.of.bend, axial_cells, line.time, pressure_at(o, line.time), found.amplitude, found.wave_length})
        all[column++].values.push_back(value);
    }
  return observables::to_csv(all);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 5) {
    fmt::print(stderr, "usage: tunica_torus_ripples PAGE SCENE PICTURE CSV\n");
    return 2;
  }
  try {
    const Page page(arguments[1], "torus", "tunica_torus_ripples");
    const full3d::PetscSession petsc;
    std::vector<Outcome> outcomes;
    // After every run, as they take long.
    for (const Case& of : cases()) {
      outcomes.push_back(outcome_of(arguments[2], of));
      page.write(table(outcomes));
      write_whole(arguments[3], picture(outcomes));
      write_whole(arguments[4], csv(outcomes));
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "tunica_torus_ripples: {}\n", error.what());
    return 2;
  }
  return 0;
}
