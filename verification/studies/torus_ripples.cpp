// SPDX-License-Identifier: GPL-3.0-or-later
// The first beat of the torus with the printed tether in space, on meshes of the paper's elements and
// others: a table of docs/verification/tether-stability.md, ripples along the outside of the bend over
// time and at the end as an SVG and as CSV.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/observables/build_info.hpp"
#include "core/observables/result.hpp"
#include "core/units.hpp"
#include "verification/line_chart.hpp"
#include "verification/page.hpp"
#include "verification/studies/ripple_lines.hpp"
#include "verification/studies/study.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

constexpr double thickness = 0.01;  // cm

struct Outcome {
  StudyCase of;
  double bend, end, length;  ///< degrees, s, cm
  Result result;
  std::vector<LumenLine> lines;
  std::string ended;
};

Outcome outcome_of(const Study& study, const StudyCase& of) {
  const double bend = of.number("bend"), end = of.number("end");
  std::vector<double> times;
  for (double t = 0.02; t < end - 1e-9; t += 0.002) times.push_back(t);
  StudyCase pictured = of;
  pictured.overrides.push_back(fmt::format("output.profile_times=[{:.3f}]", fmt::join(times, ",")));
  // A run that has lost its smooth solution crawls: it is ended where it has shown that.
  constexpr long most_iterations = 450;
  Progress now;
  RunControl control;
  control.report = [&](const Progress& progress) { now = progress; };
  control.interrupted = [&] { return now.time >= end || now.newton_iterations > most_iterations; };
  // Of the torus of 0.66 cm for 180 degrees.
  Outcome outcome{
      of, bend, end, 0.66 * bend / 180, std::move(study.computed(pictured, control).stored.value().result),
      {}, {}};
  outcome.ended = fmt::format("at {:g} s", end);
  outcome.lines = lumen_lines(outcome.result.along);
  if (!outcome.result.record.failure.empty())
    outcome.ended = fmt::format("gave up at {:.3f} s", now.time);
  else if (now.time < end)
    outcome.ended =
        fmt::format("stopped after {} Newton iterations at {:.3f} s", now.newton_iterations, now.time);
  fmt::print(stderr, "{}: {} steps, {} {}\n", of.series, outcome.result.record.steps, outcome.ended,
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
        o.of.series, fmt::format("{:g}", o.bend),
        fmt::format("{} x {} x {}", o.result.record.resolution.at("wall_cells").get<int>(),
                    o.result.record.resolution.at("axial_cells").get<int>(),
                    o.result.record.resolution.at("around_cells").get<int>()),
        fmt::format("{:.1f}", middle_cell(o)), fmt::format("{}", o.result.record.unknowns)};
    const auto ripples_at = [&](const LumenLine& line) {
      return ripples(line, o.length).amplitude > visible * thickness;
    };
    const auto first = std::find_if(o.lines.begin(), o.lines.end(), ripples_at);
    row.push_back(first == o.lines.end()
                      ? "–"
                      : fmt::format("{:.3f} s, {:.0f} mmHg", first->time, pressure_at(o, first->time)));
    const Ripples last = ripples(o.lines.back(), o.length);
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
  return fmt::format("{}, {} cells along {:g}°", o.of.series,
                     o.result.record.resolution.at("axial_cells").get<int>(), o.bend);
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
      growth.series.back().y.push_back(std::max(1e-6, ripples(line, o.length).amplitude / thickness));
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
      const Ripples found = ripples(line, o.length);
      all[0].labels.push_back(o.of.series);
      all[1].labels.emplace_back(program_commit());
      const double axial_cells = o.result.record.resolution.at("axial_cells");
      std::size_t column = 2;
      for (const double value :
           {o.bend, axial_cells, line.time, pressure_at(o, line.time), found.amplitude, found.wave_length})
        all[column++].values.push_back(value);
    }
  return observables::to_csv(all);
}

}  // namespace

void tunica::verification::torus_ripples(const Study& study) {
  const Page page(study.out("docs/verification/tether-stability.md"), "torus", "tools/study torus-ripples");
  std::vector<Outcome> outcomes;
  // After every run, as they take long.
  for (const StudyCase& of : study.cases("runs")) {
    outcomes.push_back(outcome_of(study, of));
    page.write(table(outcomes));
    write_whole(study.out("docs/images/torus-ripples.svg"), picture(outcomes));
    write_whole(study.out("notebooks_data/torus_ripples.csv"), csv(outcomes));
  }
}
