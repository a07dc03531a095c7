// SPDX-License-Identifier: GPL-3.0-or-later
// tunica_ripple_runs PAGE SCENE PICTURE [CSV]: what runs in time of the printed tether do on meshes and steps
// of several sizes. Writes the table of docs/verification/tether-stability.md between its marks, the lumen's
// shape as an SVG, and with CSV the numbers behind it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "axisym/axisym_tier.hpp"
#include "core/observables/result.hpp"
#include "core/units.hpp"
#include "verification/line_chart.hpp"
#include "verification/page.hpp"
#include "verification/ripple_lines.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

constexpr double thickness = 0.01;  // cm
constexpr double length = 0.66;     // cm
/// Flow that grows within 0.05 s and is then held, so that the pressure stays where the wall ripples most.
constexpr double end = 0.15;  // s

struct Case {
  const char* law;
  const char* element;
  int axial_cells, wall_cells;
  double step;      // s
  double pressure;  // mmHg, that the flow makes at the outlet
};
constexpr Case cases[] = {
    {"EXP1+EXP2-FS", "quadratic", 16, 3, 1e-3, 100}, {"EXP1+EXP2-FS", "quadratic", 32, 3, 1e-3, 100},
    {"EXP1+EXP2-FS", "quadratic", 64, 3, 1e-3, 100}, {"EXP1+EXP2-FS", "quadratic", 128, 3, 1e-3, 100},
    {"EXP1+EXP2-FS", "quadratic", 64, 3, 1e-4, 100}, {"EXP1+EXP2-FS", "bubble", 64, 3, 1e-3, 100},
    {"EXP1+EXP2-FS", "bubble", 128, 3, 1e-3, 100},   {"EXP1+EXP2-FS", "bubble", 128, 3, 1e-4, 100},
    {"EXP2", "quadratic", 64, 3, 1e-3, 45},          {"EXP2", "quadratic", 128, 8, 1e-3, 45},
    {"EXP2", "quadratic", 128, 8, 1e-4, 45},         {"EXP2", "bubble", 128, 3, 1e-3, 45}};

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

Outcome outcome_of(const std::filesystem::path& file, const Case& c) {
  std::vector<double> times;
  for (double t = 0.01; t < end - 1e-9; t += 0.005) times.push_back(t);
  times.push_back(end - 1e-6);
  // R Q = p: the flow that makes the pressure at the printed resistance.
  const double flow = c.pressure * mmhg / 1.032e6;
  const Scene scene = read_scene(
      file,
      {fmt::format("wall.law={}", c.law), fmt::format("mesh.element={}", c.element),
       fmt::format("mesh.axial_cells={}", c.axial_cells), fmt::format("mesh.wall_cells={}", c.wall_cells),
       "mesh.blood_cells=2", fmt::format("time.step={}", c.step), "time.beats=1", "time.ramp=0.05",
       fmt::format("inlet.period={}", end), "inlet.waveform=constant", fmt::format("inlet.flow={}", flow),
       "output.field_interval=0", fmt::format("output.profile_times=[{}]", fmt::join(times, ","))});
  // A run that has lost its smooth solution crawls: it is ended where it has shown that.
  constexpr long most_iterations = 6000;
  long iterations = 0;
  RunControl control;
  control.report = [&](const Progress& progress) { iterations = progress.newton_iterations; };
  control.interrupted = [&] { return iterations > most_iterations; };
  const Result result = axisym::AxisymTier().prepare(scene)->execute(control);
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
  const double places = static_cast<double>(line.size() - 1) / c.axial_cells;  // in a cell
  outcome.middle_cell = places * (line[middle + 1] - line[middle]) / thickness;
  return outcome;
}

std::string name(const Case& c) {
  return fmt::format("{}, {}, {} cells, {:g} s", c.law, c.element, c.axial_cells, c.step);
}

std::string table(const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const Case& c = cases[k];
    const Outcome& o = outcomes[k];
    rows.push_back({c.law, fmt::format("{:g}", c.pressure), c.element, std::to_string(c.wall_cells),
                    std::to_string(c.axial_cells), fmt::format("{:.1f}", o.middle_cell),
                    fmt::format("{:g}", c.step), o.onset > 0 ? fmt::format("{:.3f} s", o.onset) : "–",
                    fmt::format("{:.2g} h", o.amplitude),
                    o.wave_length > 0 ? fmt::format("{:.1f} h", o.wave_length) : "–", o.ended});
  }
  return markdown_table({"Law", "mmHg", "Element", "Wall cells", "Axial cells", "Cell at mid-length, h",
                         "Step, s", "Ripples > 0.01 h from", "Amplitude at the end", "Wave length", "Ended"},
                        rows);
}

/// The lumen's radius along the artery.
std::string picture(const std::vector<std::size_t>& shown, const std::vector<Outcome>& outcomes) {
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

int main(int count, char** arguments) {
  if (count < 4 || count > 5) {
    fmt::print(stderr, "usage: tunica_ripple_runs PAGE SCENE PICTURE [CSV]\n");
    return 2;
  }
  try {
    const Page page(arguments[1], "runs", "tunica_ripple_runs");
    std::vector<Outcome> outcomes;
    std::string csv = "case,z[cm],lumen_radius[cm]\n";
    for (const Case& c : cases) {
      fmt::print("{}\n", name(c));
      std::fflush(stdout);
      outcomes.push_back(outcome_of(arguments[2], c));
      const LumenLine& line = outcomes.back().lumen;
      for (std::size_t k = 0; k < line.z.size(); ++k)
        csv += fmt::format("\"{}\",{:.6g},{:.6g}\n", name(c), line.z[k], line.radius[k]);
      fmt::print("  {} steps, amplitude {:.3g} h, wave length {:.3g} h {}\n", outcomes.back().steps,
                 outcomes.back().amplitude, outcomes.back().wave_length, outcomes.back().ended);
      std::fflush(stdout);
    }
    page.write(table(outcomes));
    write_whole(arguments[3], picture({0, 2, 3, 6, 9, 11}, outcomes));
    if (count == 5) write_whole(arguments[4], csv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "tunica_ripple_runs: {}\n", error.what());
    return 2;
  }
  return 0;
}
