// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/beat_remarks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/observables/beat.hpp"
#include "core/scene/living.hpp"
#include "core/units.hpp"

namespace tunica::observables {

namespace {

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
  struct Shown {
    std::string_view column;
    const char* text;
    double unit;
    const char* unit_text;
  };
  constexpr Shown all[] = {{"pressure", "the pressure", mmhg, "mmHg"},
                           {"outflow", "the outflow", 1, "cm3/s"},
                           {"radial_displacement.P1", "the inner radius", 1e-4, "um"}};
  std::vector<std::string> changes;
  for (const Unrepeated& found :
       unrepeated(table, beat, std::max(0.01, scene.number("accuracy.tolerance")))) {
    const Shown& shown = *std::find_if(std::begin(all), std::end(all),
                                       [&](const Shown& s) { return s.column == found.column; });
    changes.push_back(fmt::format("{} {} by {:.3g} {} ({:.2g} % of its largest)", shown.text,
                                  found.change > 0 ? "rises" : "falls", std::abs(found.change) / shown.unit,
                                  shown.unit_text, 100 * std::abs(found.change) / found.size));
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
  const Beat beat = last_beat(scene, table);
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
