// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "app/report/html.hpp"
#include "app/report/json_object.hpp"
#include "app/report/labels.hpp"
#include "app/report/sections.hpp"
#include "core/observables/record.hpp"
#include "core/scene/parameter.hpp"
#include "core/units.hpp"

namespace tunica::report {

namespace {

using namespace observables;

constexpr double stress_unit = 1e5;  // dyn/cm2
constexpr int digits = 7;

bool has_values(const std::vector<double>& values) {
  for (const double value : values)
    if (std::isfinite(value)) return true;
  return false;
}

void append_columns(Object& run, const Table& table) {
  Object columns(run.key("columns"));
  for (const Column& column : table.columns()) {
    if (column.is_text() || column.name == "time" || !has_values(column.values)) continue;
    append_array(columns.key(column.name), column.values, 1 / display_unit(column), digits);
  }
}

void append_intervals(Object& run, const RunSummary& summary) {
  if (is_none(summary.recruited_share[0]) || summary.is_state) return;
  Object points(run.key("recruited"));
  for (int point = 1; point <= wall_points; ++point) {
    std::string& json = points.key(fmt::format("P{}", point));
    json += '[';
    bool first = true;
    for (const auto& [from, to] : recruited_intervals(summary.stored->result, point, 0, summary.period_end)) {
      if (!first) json += ',';
      first = false;
      append_array(json, {from, to}, 1, time_digits);
    }
    json += ']';
  }
}

/// Curves at a few times, through the wall or along the artery: the rows of a table that belong to one time
/// each.
void append_profiles(Object& run, const char* name, const Table& table, const RunSummary& summary) {
  const Column* time = table.find("time");
  if (!time || time->values.empty()) return;
  std::string& json = run.key(name);
  json += '[';
  for (std::size_t first = 0; first < table.rows();) {
    std::size_t end = first;
    while (end < table.rows() && time->values[end] == time->values[first]) ++end;
    if (first > 0) json += ',';
    Object profile(json);
    profile.value("time", time->values[first] - summary.beat.start);
    Object columns(profile.key("columns"));
    for (const Column& column : table.columns()) {
      if (column.is_text() || &column == time) continue;
      const std::vector<double> values(column.values.begin() + static_cast<long>(first),
                                       column.values.begin() + static_cast<long>(end));
      if (has_values(values))
        append_array(columns.key(column.name), values, 1 / display_unit(column), digits);
    }
    first = end;
  }
  json += ']';
}

/// "d(pressure)/d(outlet.resistance)" taken apart.
std::optional<std::pair<std::string, std::string>> parts_of(const std::string& name) {
  const std::size_t middle = name.find(")/d(");
  if (!name.starts_with("d(") || middle == std::string::npos || name.back() != ')') return std::nullopt;
  return std::pair{name.substr(2, middle - 2), name.substr(middle + 4, name.size() - middle - 5)};
}

/// Derivatives are shown as the change of a quantity when a parameter grows by 1 %, which compares
/// parameters of different units. A parameter that is 0 has no per cent.
void append_sensitivities(Object& run, const RunSummary& summary) {
  const Table& table = summary.stored->result.sensitivities;
  const Column* time = table.find("time");
  if (!time) return;
  const auto& scene = recorded_scene(summary.stored->record);
  std::map<std::string, std::map<std::string, const Column*>> by_quantity;
  std::map<std::string, double> values;
  std::map<std::string, bool> without_percent;
  for (const Column& column : table.columns()) {
    const auto parts = parts_of(column.name);
    if (!parts || column.is_text() || !has_values(column.values)) continue;
    const auto& [quantity, key] = *parts;
    const auto value = scene.find(key);
    if (value == scene.end() || !value->is_number() || value->get<double>() == 0) {
      without_percent[key] = true;
      continue;
    }
    values[key] = value->get<double>();
    by_quantity[quantity][key] = &column;
  }
  Object sensitivities(run.key("sensitivities"));
  append_array(sensitivities.key("time"), time->values, 1, time_digits);
  std::string& skipped = sensitivities.key("without_percent");
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  for (const auto& [key, yes] : without_percent) names.push_back(key);
  skipped += script_json(names);
  Object quantities(sensitivities.key("quantities"));
  for (const auto& [quantity, columns] : by_quantity) {
    const Column* own = summary.stored->result.observables.find(quantity);
    const double unit = own ? display_unit(*own) : 1.0;
    Object parameters(quantities.key(quantity));
    for (const auto& [key, column] : columns)
      append_array(parameters.key(key), column->values, 0.01 * values[key] / unit, digits);
  }
}

/// The key of numbers that alone tells the static states apart; empty where there is none.
std::string key_of_states(const std::vector<RunSummary>& runs) {
  std::vector<StoredResult> states;
  for (const RunSummary& run : runs)
    if (run.is_state) states.push_back(*run.stored);
  if (states.size() < 2) return {};
  const auto differences = differences_of(states);
  if (differences.size() != 1) return {};
  const std::string& key = differences.front().key;
  for (const StoredResult& state : states) {
    const auto& scene = recorded_scene(state.record);
    const auto value = scene.find(key);
    if (value == scene.end() || !value->is_number()) return {};
  }
  return key;
}

void append_setting(Object& run, const RunSummary& summary, const std::string& key) {
  const auto* parameter = scene::find_parameter(key);
  const std::string unit = parameter ? parameter->unit : "1";
  const bool is_pressure = is_read_in_mmhg(key, unit);
  Object setting(run.key("setting"));
  setting.text("name", key);
  setting.text("unit", is_pressure ? "mmHg" : unit == "1" ? "" : unit);
  setting.value("value", scene_number(summary.stored->record, key) / (is_pressure ? mmhg : 1.0));
}

}  // namespace

double display_unit(const Column& column) {
  if (column.name == "wall_shear_stress") return 1.0;
  if (column.name.starts_with("von_mises")) return stress_unit;
  return column.unit == "dyn/cm2" ? mmhg : 1.0;
}

std::string chart_data(const std::vector<RunSummary>& runs) {
  const std::string key = key_of_states(runs);
  std::string json;
  {
    Object all(json);
    all.key("runs") += '[';
    bool first = true;
    for (const RunSummary& summary : runs) {
      if (!first) json += ',';
      first = false;
      Object run(json);
      run.text("label", summary.label);
      {
        Object beat(run.key("beat"));
        beat.value("start", summary.beat.start);
        beat.value("period", summary.beat.period);
      }
      append_array(run.key("time"), summary.stored->result.observables.find("time")->values, 1, time_digits);
      append_columns(run, summary.stored->result.observables);
      append_intervals(run, summary);
      append_profiles(run, "profiles", summary.stored->result.profiles, summary);
      append_profiles(run, "along", summary.stored->result.along, summary);
      append_sensitivities(run, summary);
      if (summary.is_state && !key.empty()) append_setting(run, summary, key);
    }
    json += ']';
  }
  return json;
}

}  // namespace tunica::report
