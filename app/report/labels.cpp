// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/labels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>

#include "app/report/summary.hpp"
#include "core/observables/record.hpp"
#include "core/scene/parameter.hpp"
#include "core/units.hpp"
#include "core/wall/catalog.hpp"

namespace tunica::report {

namespace {

using Json = nlohmann::ordered_json;
using namespace observables;

constexpr const char* no_value = "–";
constexpr std::string_view no_break = "\u00a0";

/// Whether a key holds a word rather than a number.
bool is_choice(std::string_view key) {
  const auto* parameter = scene::find_parameter(key);
  return parameter && (parameter->kind == scene::Kind::choice || parameter->kind == scene::Kind::text);
}

bool is_of_output(std::string_view key) {
  return key.starts_with("output.") || key.starts_with("sensitivity.");
}

/// The larger, the later in a name: the law, the tier, choices and numbers of the physics, and numerical
/// ones.
int rank(std::string_view key) {
  constexpr std::string_view numerical[] = {"accuracy.",   "mesh.",      "solver.",   "time.step",
                                            "time.scheme", "time.start", "time.beats"};
  if (key == "wall.law") return 0;
  if (key == "tier") return 1;
  const bool is_numerical = std::any_of(std::begin(numerical), std::end(numerical),
                                        [&](std::string_view prefix) { return key.starts_with(prefix); });
  return is_numerical ? 4 : is_choice(key) ? 2 : 3;
}

/// "1.2e6" rather than "1.2e+06".
std::string short_number(double value) {
  std::string text = fmt::format("{:.5g}", value);
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  const bool is_negative = text[exponent + 1] == '-';
  const std::size_t first = std::min(text.find_first_not_of("+-0", exponent + 1), text.size() - 1);
  return fmt::format("{}e{}{}", text.substr(0, exponent), is_negative ? "-" : "", text.substr(first));
}

std::string number_text(std::string_view key, double value) {
  const auto* parameter = scene::find_parameter(key);
  const std::string unit = parameter ? parameter->unit : "1";
  if (is_read_in_mmhg(key, unit)) return fmt::format("{}{}mmHg", short_number(value / mmhg), no_break);
  if (unit == "deg") return short_number(value) + "°";
  if (unit == "1") return short_number(value);
  std::string kept;
  for (const char character : unit)
    if (character == ' ')
      kept += no_break;
    else
      kept += character;
  return fmt::format("{}{}{}", short_number(value), no_break, kept);
}

std::string value_text(std::string_view key, const Json& value) {
  // Integers of a key that holds numbers are numbers: 5e5 and 500000 are the same.
  if (value.is_number()) return number_text(key, value.get<double>());
  if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
  if (value.is_array()) {
    std::vector<std::string> parts;
    for (const Json& entry : value) parts.push_back(value_text(key, entry));
    return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, " "));
  }
  if (!value.is_string()) return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  // Files are told by their names.
  const auto text = value.get<std::string>();
  return text.find('/') == std::string::npos ? text : std::filesystem::path(text).filename().string();
}

std::set<std::string> keys_set(const StoredResult& run) {
  std::set<std::string> keys;
  const auto given = run.record.find("scene_set");
  if (given == run.record.end() || !given->is_array()) return keys;
  for (const Json& key : *given)
    if (key.is_string()) keys.insert(key.get<std::string>());
  return keys;
}

std::string value_of(const StoredResult& run, const std::string& key) {
  if (key == "tier") return record_text(run.record, "tier");
  const Json& scene = recorded_scene(run.record);
  const auto value = scene.find(key);
  return value == scene.end() ? no_value : value_text(key, *value);
}

bool differ(const std::vector<std::string>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) != values.end();
}

bool all_different(std::vector<std::string> labels) {
  std::sort(labels.begin(), labels.end());
  return std::adjacent_find(labels.begin(), labels.end()) == labels.end();
}

/// Whether two runs of the same scene's name have other values.
bool differ_within_names(const std::vector<std::string>& names, const std::vector<std::string>& values) {
  for (std::size_t a = 0; a < names.size(); ++a)
    for (std::size_t b = a + 1; b < names.size(); ++b)
      if (names[a] == names[b] && values[a] != values[b]) return true;
  return false;
}

/// "resistance 1.2e6" or, when another key of the name has the same last word, "outlet.resistance 1.2e6". A
/// choice is told by its section: "tether current", "time static".
std::string part_of(const Difference& difference, const std::string& value,
                    const std::vector<Difference>& all) {
  const std::string& key = difference.key;
  if (key == "wall.law" || key == "tier" || key == "name") return value;
  const std::size_t dot = key.find('.');
  if (dot == std::string::npos) return fmt::format("{}{}{}", key, no_break, value);
  const auto word = [&](const std::string& of) {
    return is_choice(of) ? of.substr(0, of.find('.')) : of.substr(of.rfind('.') + 1);
  };
  const bool is_shared = std::count_if(all.begin(), all.end(), [&](const Difference& other) {
                           return other.key.find('.') != std::string::npos && word(other.key) == word(key) &&
                                  is_choice(other.key) == is_choice(key);
                         }) > 1;
  std::string name = is_shared ? key : word(key);
  std::string shown;
  for (const char character : name)
    if (character == '_')
      shown += no_break;
    else
      shown += character;
  return fmt::format("{}{}{}", shown, no_break, value);
}

/// Whether a key is one of the constants that a law brings along.
bool is_constant_of(const std::string& law, std::string_view key) {
  const auto* entry = wall::find_law(law);
  return entry && std::any_of(entry->parameters.begin(), entry->parameters.end(), [&](const auto& parameter) {
           return key.starts_with("wall.") && key.substr(5) == parameter.key;
         });
}

/// Constants of a law are told where another run of the same law has others: the law's name tells the rest.
bool differs_within_law(const std::vector<StoredResult>& runs, const std::vector<std::string>& laws,
                        std::size_t run, const std::string& key) {
  for (std::size_t other = 0; other < runs.size(); ++other)
    if (laws[other] == laws[run] && value_of(runs[other], key) != value_of(runs[run], key)) return true;
  return false;
}

}  // namespace

bool is_read_in_mmhg(std::string_view key, std::string_view unit) {
  return unit == "dyn/cm2" && key.find("pressure") != std::string_view::npos;
}

std::vector<Difference> differences_of(const std::vector<StoredResult>& runs) {
  std::set<std::string> keys{"wall.law", "tier"};
  for (const StoredResult& run : runs) keys.merge(keys_set(run));
  std::vector<std::string> laws;
  for (const StoredResult& run : runs) laws.push_back(scene_text(run.record, "wall.law"));
  std::vector<Difference> found;
  for (const std::string& key : keys) {
    if (is_of_output(key)) continue;
    Difference difference{key, {}};
    for (std::size_t run = 0; run < runs.size(); ++run) {
      const bool is_told = !is_constant_of(laws[run], key) || differs_within_law(runs, laws, run, key);
      difference.values.push_back(is_told ? value_of(runs[run], key) : no_value);
    }
    if (differ(difference.values)) found.push_back(std::move(difference));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return rank(a.key) < rank(b.key); });
  return found;
}

std::vector<std::string> labels_of(const std::vector<StoredResult>& runs) {
  constexpr std::size_t most_parts = 3;
  std::vector<std::string> names, labels(runs.size());
  for (const StoredResult& run : runs) names.push_back(record_text(run.record, "name"));
  if (runs.size() == 1) return {scene_text(runs[0].record, "wall.law")};

  std::vector<Difference> parts = differences_of(runs);
  if (parts.size() > most_parts && differ(names)) {
    std::erase_if(parts, [&](const Difference& part) { return !differ_within_names(names, part.values); });
    parts.insert(parts.begin(), {"name", names});
  } else if (differ(names)) {
    parts.push_back({"name", names});
  }
  std::size_t used = 0;
  for (const Difference& part : parts) {
    const bool is_needed = !all_different(labels);
    // The scene's name comes in where the keys do not suffice.
    if (used > 0 && !is_needed && (used >= most_parts || part.key == "name")) continue;
    ++used;
    for (std::size_t run = 0; run < runs.size(); ++run) {
      if (part.values[run] == no_value || part.values[run].empty()) continue;
      labels[run] += (labels[run].empty() ? "" : ", ") + part_of(part, part.values[run], parts);
    }
  }
  if (!all_different(labels))
    for (std::size_t run = 0; run < runs.size(); ++run) {
      const std::string folder = (runs[run].folder / "").parent_path().filename().string();
      labels[run] += (labels[run].empty() ? "" : ", ") + folder;
    }
  if (!all_different(labels))
    for (std::size_t run = 0; run < runs.size(); ++run) labels[run] += fmt::format(" ({})", run + 1);
  for (std::size_t run = 0; run < runs.size(); ++run)
    if (labels[run].empty()) labels[run] = fmt::format("({})", run + 1);
  return labels;
}

}  // namespace tunica::report
