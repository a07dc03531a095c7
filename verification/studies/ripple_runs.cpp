// SPDX-License-Identifier: GPL-3.0-or-later
// What runs in time of the printed tether do on meshes and steps of several sizes: a table of
// docs/verification/tether-stability.md, the lumen's shape as an SVG, and the numbers behind it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "core/observables/result.hpp"
#include "verification/line_chart.hpp"
#include "verification/page.hpp"
#include "verification/studies/ripple_lines.hpp"
#include "verification/studies/study.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

constexpr double thickness = 0.01;  // cm
constexpr double length = 0.66;     // cm
constexpr double end = 0.15;        // s

struct Outcome {
  LumenLine lumen;         ///< at the last time that was reached
  double middle_cell = 0;  ///< length of the cells at mid-length, in thicknesses
  double amplitude = 0;    ///< greatest departure from a smooth shape, in thicknesses
  double wave_length = 0;  ///< in thicknesses; 0 without ripples
  double onset = 0;        ///< s; 0 without ripples
  long steps = 0;
  std::string ended = "at 0.15 s";
};

constexpr double visible = 0.01;  ///< of the thickness: from there on a ripple is one

Outcome outcome_of(const Study& study, StudyCase of) {
  std::vector<double> times;
  for (double t = 0.01; t < end - 1e-9; t += 0.005) times.push_back(t);
  times.push_back(end - 1e-6);
  of.overrides.push_back(fmt::format("output.profile_times=[{}]", fmt::join(times, ",")));
  // A run that has lost its smooth solution crawls: it is ended where it has shown that.
  constexpr long most_iterations = 6000;
  long iterations = 0;
  RunControl control;
  control.report = [&](const Progress& progress) { iterations = progress.newton_iterations; };
  control.interrupted = [&] { return iterations > most_iterations; };
  const Result result = std::move(study.computed(of, control).stored.value().result);
  Outcome outcome;
  outcome.steps = result.record.steps;
  const auto& rows = result.observables.find("time")->values;
  if (!result.record.failure.empty()) outcome.ended = fmt::format("gave up at {:.3f} s", rows.back());
  if (result.record.interrupted)
    outcome.ended = fmt::format("stopped after {} Newton iterations at {:.3f} s", iterations, rows.back());
  for (LumenLine& line : lumen_lines(result.along)) {
    const Ripples found = ripples(line, length);
    outcome.amplitude = found.amplitude / thickness;
    const bool ripples_now = outcome.amplitude > visible;
    if (ripples_now && outcome.onset == 0) outcome.onset = line.time;
    outcome.wave_length = ripples_now ? found.wave_length / thickness : 0;
    outcome.lumen = std::move(line);
  }
  const auto& line = outcome.lumen.z;
  const std::size_t middle = line.size() / 2;
  const double places = static_cast<double>(line.size() - 1) / of.number("axial");  // in a cell
  outcome.middle_cell = places * (line[middle + 1] - line[middle]) / thickness;
  return outcome;
}

std::string name(const StudyCase& of) {
  return fmt::format("{}, {}, {} cells, {:g} s", of.value("law"), of.value("element"), of.value("axial"),
                     of.number("step"));
}

std::string table(const std::vector<StudyCase>& cases, const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const StudyCase& of = cases[k];
    const Outcome& o = outcomes[k];
    rows.push_back(
        {of.value("law"), of.value("pressure"), of.value("element"), of.value("wall"), of.value("axial"),
         fmt::format("{:.1f}", o.middle_cell), fmt::format("{:g}", of.number("step")),
         o.onset > 0 ? fmt::format("{:.3f} s", o.onset) : "–", fmt::format("{:.2g} h", o.amplitude),
         o.wave_length > 0 ? fmt::format("{:.1f} h", o.wave_length) : "–", o.ended});
  }
  return markdown_table({"Law", "mmHg", "Element", "Wall cells", "Axial cells", "Cell at mid-length, h",
                         "Step, s", "Ripples > 0.01 h from", "Amplitude at the end", "Wave length", "Ended"},
                        rows);
}

/// The lumen's radius along the artery.
std::string picture(const std::vector<StudyCase>& cases, const std::vector<std::size_t>& shown,
                    const std::vector<Outcome>& outcomes) {
  std::vector<LineChart> charts;
  for (const std::size_t k : shown) {
    LineChart chart{
        name(cases[k]), "z [cm]", "lumen radius [cm]", {{"", outcomes[k].lumen.z, outcomes[k].lumen.radius}}};
    chart.y_range = {0.03, 0.06};
    charts.push_back(chart);
  }
  return svg(charts, 2);
}

}  // namespace

void tunica::verification::ripple_runs(const Study& study) {
  const Page page(study.out("docs/verification/tether-stability.md"), "runs", "tools/study ripple-runs");
  const std::vector<StudyCase>& cases = study.cases("runs");
  std::vector<Outcome> outcomes;
  std::string csv = "case,z[cm],lumen_radius[cm]\n";
  for (const StudyCase& of : cases) {
    outcomes.push_back(outcome_of(study, of));
    const LumenLine& line = outcomes.back().lumen;
    for (std::size_t k = 0; k < line.z.size(); ++k)
      csv += fmt::format("\"{}\",{:.6g},{:.6g}\n", name(of), line.z[k], line.radius[k]);
    fmt::print(stderr, "{}: {} steps, amplitude {:.3g} h, wave length {:.3g} h {}\n", name(of),
               outcomes.back().steps, outcomes.back().amplitude, outcomes.back().wave_length,
               outcomes.back().ended);
  }
  page.write(table(cases, outcomes));
  write_whole(study.out("docs/images/ripples.svg"), picture(cases, {0, 2, 3, 6, 9, 11}, outcomes));
  write_whole(study.out("notebooks_data/ripples.csv"), csv);
}
