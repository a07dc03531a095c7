// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/calibration/result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/observables/build_info.hpp"
#include "core/observables/inputs.hpp"
#include "core/observables/table.hpp"
#include "core/scene/message.hpp"
#include "verification/sweep/axis.hpp"

namespace tunica::verification::calibration {

namespace {

using Json = nlohmann::ordered_json;
using observables::is_none;
using observables::none;

/// A table whose columns carry no unit in their names, as each row has its own.
class Rows {
 public:
  explicit Rows(const std::vector<std::string>& names) {
    for (const std::string& name : names) table_.add(name, "");
  }
  void add(const std::vector<std::string>& cells) {
    for (std::size_t column = 0; column < cells.size(); ++column)
      table_[column].labels.push_back(cells[column]);
  }
  std::string text() const { return to_csv(table_); }

 private:
  observables::Table table_;
};

std::string cell(double value) {
  return is_none(value) ? std::string{} : sweep::value_text(value);
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

double reached(const Calibration& found, std::size_t target) {
  return found.has_answer() ? found.reached[target] : none;
}

/// How far a target is missed, in its standard deviations.
double deviations(const Task& task, const Calibration& found, std::size_t i) {
  return (reached(found, i) - task.targets[i].value) / task.targets[i].standard_deviation;
}

std::string missed(const Task& task, const Calibration& found, std::size_t i) {
  const Target& target = task.targets[i];
  const double by = found.reached[i] - target.value;
  const std::string share =
      target.value != 0 ? fmt::format("{:+.3g} %, ", 100 * by / std::abs(target.value)) : "";
  return fmt::format("{} reaches {:.5g} instead of {} ({}{:+.3g} standard deviations)",
                     target.quantity.name(), found.reached[i],
                     scene::with_unit(target.value, target.quantity.unit()), share,
                     deviations(task, found, i));
}

std::vector<std::string> keys_where(const Task& task, const Calibration& found,
                                    bool (*holds)(const FreeResult&)) {
  std::vector<std::string> keys;
  for (std::size_t k = 0; k < found.free.size(); ++k)
    if (holds(found.free[k])) keys.push_back(task.free[k].key);
  return keys;
}

}  // namespace

std::string parameters_csv(const Task& task, const Calibration& found) {
  Rows rows({"parameter", "value", "low", "high", "standard_deviation", "unit"});
  for (std::size_t k = 0; k < task.free.size(); ++k) {
    const FreeKey& free = task.free[k];
    const FreeResult result = found.has_answer() ? found.free[k] : FreeResult{};
    rows.add({free.key, cell(result.value), cell(free.low), cell(free.high), cell(result.standard_deviation),
              free.unit});
  }
  return rows.text();
}

std::string targets_csv(const Task& task, const Calibration& found) {
  Rows rows({"quantity", "target", "reached", "unit"});
  for (std::size_t i = 0; i < task.targets.size(); ++i)
    rows.add({task.targets[i].quantity.name(), cell(task.targets[i].value), cell(reached(found, i)),
              task.targets[i].quantity.unit()});
  return rows.text();
}

Json to_json(const Task& task, const Calibration& found, const Scene& scene) {
  Json json = {
      {"scene", scene.name()},  {"version", program_version()},   {"commit", program_commit()},
      {"tier", task.tier},      {"converged", found.converged},   {"interrupted", found.interrupted},
      {"reason", found.reason}, {"misfit", number(found.misfit)}, {"degrees_of_freedom", found.degrees}};
  Json& conflict = json["conflict"];
  conflict = {{"conflicts", found.conflicts()}, {"chance", number(found.chance)}, {"targets", Json::array()}};
  for (std::size_t i = 0; i < task.targets.size(); ++i) {
    const Target& target = task.targets[i];
    conflict["targets"].push_back({{"quantity", target.quantity.name()},
                                   {"asked", target.asked},
                                   {"target", target.value},
                                   {"standard_deviation", target.standard_deviation},
                                   {"standard_deviation_given", target.deviation_given},
                                   {"reached", number(reached(found, i))},
                                   {"missed_by", number(reached(found, i) - target.value)},
                                   {"missed_by_deviations", number(deviations(task, found, i))},
                                   {"unit", target.quantity.unit()}});
  }
  json["parameters"] = Json::array();
  for (std::size_t k = 0; k < task.free.size(); ++k) {
    const FreeKey& free = task.free[k];
    const FreeResult result = found.has_answer() ? found.free[k] : FreeResult{};
    json["parameters"].push_back({{"parameter", free.key},
                                  {"value", number(result.value)},
                                  {"low", free.low},
                                  {"high", free.high},
                                  {"standard_deviation", number(result.standard_deviation)},
                                  {"unit", free.unit},
                                  {"has_influence", result.has_influence},
                                  {"is_determined", result.is_determined},
                                  {"at_bound", result.at_bound}});
  }
  json["correlation"] = Json::array();
  for (const auto& row : found.correlation) {
    Json numbers = Json::array();
    for (const double one : row) numbers.push_back(number(one));
    json["correlation"].push_back(numbers);
  }
  json["derivatives_by_differences"] = found.by_differences;
  json["runs"] = found.runs;
  json["seed"] = task.seed;
  json["starts"] = Json::array();
  for (const Start& start : found.starts)
    json["starts"].push_back({{"from", start.from},
                              {"to", start.to},
                              {"misfit", number(start.misfit)},
                              {"converged", start.converged},
                              {"reason", start.reason},
                              {"agrees", start.agrees}});
  json["findings"] = findings(task, found);
  return json;
}

std::string calibrated_scene(const run::SceneSource& source, const Task& task, const Calibration& found) {
  std::vector<std::string> overrides;
  for (std::size_t k = 0; k < found.free.size(); ++k)
    overrides.push_back(fmt::format("{}={}", task.free[k].key, sweep::value_text(found.free[k].value)));
  const Scene scene = source.with(overrides);
  const Json files = input_files(scene);
  for (const auto& [key, sum] : files.items())
    overrides.push_back(
        fmt::format("{}={}", key, std::filesystem::absolute(scene.folder() / scene.text(key)).string()));
  return describe(source.with(overrides));
}

std::vector<std::string> findings(const Task& task, const Calibration& found) {
  std::vector<std::string> lines;
  if (!found.has_answer()) return lines;
  if (found.conflicts()) {
    std::vector<std::string> each;
    for (std::size_t i = 0; i < task.targets.size(); ++i)
      if (std::abs(deviations(task, found, i)) > 1) each.push_back(missed(task, found, i));
    lines.push_back(fmt::format("the targets conflict; at the best compromise {}", fmt::join(each, ", ")));
  }
  for (const std::string& key :
       keys_where(task, found, [](const FreeResult& one) { return !one.has_influence; }))
    lines.push_back(fmt::format(
        "{} has no influence on the targets; its value says nothing: fix it, or add a target that "
        "moves with it",
        key));
  const auto together =
      keys_where(task, found, [](const FreeResult& one) { return one.has_influence && !one.is_determined; });
  if (!together.empty())
    lines.push_back(fmt::format("the targets do not tell {} apart: fix one of them, or add a target",
                                fmt::join(together, " and ")));
  for (const std::string& key :
       keys_where(task, found, [](const FreeResult& one) { return one.at_bound && one.has_influence; }))
    lines.push_back(fmt::format("{} ends at a bound; with wider ones it would go on", key));
  const auto ended = std::count_if(found.starts.begin(), found.starts.end(),
                                   [](const Start& one) { return !is_none(one.misfit); });
  if (!found.interrupted && ended > found.agreeing())
    lines.push_back(
        fmt::format("{} of {} starts come to this answer; calibration.json says where the others end",
                    found.agreeing(), found.starts.size()));
  return lines;
}

}  // namespace tunica::verification::calibration
