// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/beat_remarks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/observables/beat.hpp"
#include "core/scene/living.hpp"
#include "core/units.hpp"

namespace tunica::observables {

namespace {

/// Flow that counts for none, cm3/s.
constexpr double still_flow = 1e-6;

/// The last beat, or the only row of a static state. `last` is before `first` where there are no rows in it.
Beat last_of(const Scene& scene, const Table& table) {
  Beat beat;
  const std::vector<double>& time = table.find("time")->values;
  beat.last = time.size() - 1;
  if (scene.text("time.mode") == "static") return beat;
  beat.period = scene.number("inlet.period");
  beat.start = static_cast<double>(scene.integer("time.beats") - 1) * beat.period;
  const double slack = 1e-9 * beat.period;
  beat.first =
      static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), beat.start - slack) - time.begin());
  return beat;
}

/// Mean over the rows of a beat by the trapezoidal rule; `none` without values.
double mean(const Table& table, std::string_view name, const Beat& beat) {
  const std::vector<double>& time = table.find("time")->values;
  const std::vector<double>& values = table.find(name)->values;
  if (beat.first == beat.last) return values[beat.last];
  double sum = 0;
  for (std::size_t row = beat.first; row < beat.last; ++row)
    sum += 0.5 * (values[row] + values[row + 1]) * (time[row + 1] - time[row]);
  return sum / (time[beat.last] - time[beat.first]);
}

void remark_on_pressure(const Table& table, const Beat& beat, std::vector<std::string>& lines) {
  const Range found = range(table, "pressure", beat);
  const double average = mean(table, "pressure", beat) / mmhg;
  if (is_none(found.lowest) || is_none(average)) return;
  const double lowest = found.lowest / mmhg, highest = found.highest / mmhg;
  if (living::mean_pressure.contains(average) && living::pressure.contains(lowest) &&
      living::pressure.contains(highest))
    return;
  lines.push_back(
      fmt::format("the lumen's pressure is {:.4g} to {:.4g} mmHg in the last beat, {:.4g} in the mean: "
                  "living arteries have {:g} to {:g} in the mean, and at most {:g}",
                  lowest, highest, average, living::mean_pressure.lowest, living::mean_pressure.highest,
                  living::pressure.highest));
}

void remark_on_repetition(const Scene& scene, const Table& table, const Beat& beat,
                          std::vector<std::string>& lines) {
  struct Watched {
    const char* column;
    const char* text;
    double unit;
    const char* unit_text;
    double still;  ///< what is smaller is rounding
  };
  constexpr Watched all[] = {{"pressure", "the pressure", mmhg, "mmHg", 1e-2 * mmhg},
                             {"outflow", "the outflow", 1, "cm3/s", still_flow},
                             {"radial_displacement.P1", "the inner radius", 1e-4, "um", 1e-6}};
  const double noticed = std::max(0.01, scene.number("accuracy.tolerance"));
  std::vector<std::string> changes;
  for (const Watched& watched : all) {
    const Range over = range(table, watched.column, beat);
    const double change = value_at(table, watched.column, table.find("time")->values.back()) -
                          value_at(table, watched.column, beat.start);
    const double size = std::max(std::abs(over.lowest), std::abs(over.highest));
    if (is_none(change) || !(std::abs(change) > std::max(noticed * size, watched.still))) continue;
    changes.push_back(fmt::format("{} {} by {:.3g} {} ({:.2g} % of its largest)", watched.text,
                                  change > 0 ? "rises" : "falls", std::abs(change) / watched.unit,
                                  watched.unit_text, 100 * std::abs(change) / size));
  }
  if (!changes.empty())
    lines.push_back(
        fmt::format("the last beat does not repeat itself: from its start to its end {}; compute more beats "
                    "(time.beats = {}), or write time.start = \"periodic\"",
                    fmt::join(changes, ", "), scene.integer("time.beats")));
}

void remark_on_inflow(const Table& table, const Beat& beat, std::vector<std::string>& lines) {
  const double average = mean(table, "inflow", beat);
  const Range found = range(table, "inflow", beat);
  const double noticed =
      std::max(still_flow, 0.01 * std::max(std::abs(found.lowest), std::abs(found.highest)));
  if (is_none(average) || average >= -noticed) return;
  lines.push_back(
      fmt::format("blood leaves through the inlet: the mean inflow of the last beat is {:.3g} cm3/s; is the "
                  "inlet's pressure meant to be below outlet.pressure?",
                  average));
}

}  // namespace

std::vector<std::string> beat_remarks(const Scene& scene, bool pressure_is_given, const Result& result) {
  std::vector<std::string> lines;
  const Table& table = result.observables;
  if (!result.record.converged || table.rows() == 0) return lines;
  const bool is_static = scene.text("time.mode") == "static";
  const Beat beat = last_of(scene, table);
  if (beat.first > beat.last) return lines;
  const bool has_resistance = scene.number("outlet.resistance") > 0 || scene.text("outlet.kind") == "rcr";
  if (!pressure_is_given && has_resistance) remark_on_pressure(table, beat, lines);
  // A first beat from rest is no other's.
  const bool may_repeat = scene.integer("time.beats") > 1 || scene.text("time.start") != "rest";
  if (!is_static && may_repeat) remark_on_repetition(scene, table, beat, lines);
  if (pressure_is_given && (is_static || may_repeat)) remark_on_inflow(table, beat, lines);
  return lines;
}

}  // namespace tunica::observables
