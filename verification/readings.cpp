// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/readings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/observables/record.hpp"
#include "core/scene/parameter.hpp"
#include "core/wall/catalog.hpp"
#include "verification/claims.hpp"

namespace tunica::verification {

namespace {

using Json = nlohmann::ordered_json;
using namespace observables;

/// Choices that the paper leaves open, or that do not change what is computed.
bool is_free(std::string_view key) {
  static constexpr std::string_view free_keys[] = {"wall.law",
                                                   "tether.traction",
                                                   "wall.exponent",
                                                   "wall.activation_squared",
                                                   "wall.activation_stretch",
                                                   "wall.recruitment",
                                                   "time.beats",
                                                   "time.start",
                                                   "time.scheme",
                                                   "time.step"};
  static constexpr std::string_view free_sections[] = {"accuracy.", "mesh.", "output.", "sensitivity."};
  return std::find(std::begin(free_keys), std::end(free_keys), key) != std::end(free_keys) ||
         std::any_of(std::begin(free_sections), std::end(free_sections),
                     [&](std::string_view section) { return key.starts_with(section); });
}

/// The paper has two arteries. Of the bent one its text gives neither the angle nor, for its Cases, the
/// weights of the fibre families.
bool is_torus(const StoredResult& run) {
  return scene_text(run.record, "geometry.kind") == "torus";
}
bool is_free_on_torus(std::string_view key) {
  return key == "geometry.kind" || key == "geometry.bend_angle" || key.starts_with("wall.families");
}

/// The paper's value of a key: the declared default, or the law's own.
std::optional<Json> paper_value(const std::string& key, const std::string& law) {
  if (const auto* entry = wall::find_law(law); entry && key.starts_with("wall."))
    for (const auto& parameter : entry->parameters)
      if (key.substr(5) == parameter.key) return parameter.value;
  const auto* parameter = scene::find_parameter(key);
  if (!parameter || !parameter->default_value) return std::nullopt;
  return std::visit([](const auto& value) { return Json(value); }, *parameter->default_value);
}

bool same_reading(const Reading& a, const Reading& b) {
  const bool same_activation = (std::isnan(a.activation_squared) && std::isnan(b.activation_squared)) ||
                               std::abs(a.activation_squared - b.activation_squared) < 1e-9;
  return a.tier == b.tier && a.geometry == b.geometry && a.tether == b.tether && a.exponent == b.exponent &&
         same_activation;
}

/// Whether a run belongs to a group: isotropic laws know no fibre reading, ZS no activation.
bool fits(const Reading& run, const Reading& group) {
  Reading relevant = group;
  if (std::isnan(run.activation_squared)) relevant.activation_squared = none;
  if (run.exponent == 0) relevant.exponent = 0;
  return same_reading(run, relevant);
}

}  // namespace

std::string_view short_name(std::string_view law) {
  for (const PaperLaw& entry : paper_laws)
    if (entry.name == law) return entry.label;
  return law;
}

const ComparedRun* ReadingGroup::find(std::string_view law) const {
  for (const ComparedRun& run : runs)
    if (run.law == law) return &run;
  return nullptr;
}

Reading read_reading(const StoredResult& run) {
  Reading reading;
  reading.tier = record_text(run.record, "tier");
  reading.geometry = is_torus(run) ? "torus" : "cylinder";
  reading.tether = scene_text(run.record, "tether.traction");
  const auto* law = wall::find_law(scene_text(run.record, "wall.law"));
  if (!law || !law->has_fibers) return reading;
  const double exponent = scene_number(run.record, "wall.exponent");
  reading.exponent = std::isnan(exponent) ? 2 : std::lround(exponent);
  if (!law->has_activation) return reading;
  reading.activation_squared = scene_number(run.record, "wall.activation_squared");
  if (std::isnan(reading.activation_squared)) {
    const double stretch = scene_number(run.record, "wall.activation_stretch");
    const double angle = scene_number(run.record, "wall.fiber_angle") * std::numbers::pi / 180;
    reading.activation_squared = std::pow(stretch * std::cos(angle), 2) + std::pow(std::sin(angle), 2);
  }
  return reading;
}

std::string to_text(const Reading& reading, bool with_activation, bool with_exponent) {
  std::string text = fmt::format("{}, {}tether\u00a0{}", reading.tier,
                                 reading.geometry == "torus" ? "torus, " : "", reading.tether);
  if (with_activation && !std::isnan(reading.activation_squared))
    text += fmt::format(", a²\u00a0=\u00a0{:.4f}", reading.activation_squared);
  if (with_exponent && reading.exponent > 0) text += fmt::format(", exponent\u00a0{}", reading.exponent);
  return text;
}

std::string reading_of(const StoredResult& run) {
  return to_text(read_reading(run), true, true);
}

std::vector<std::string> differences_from_paper(const StoredResult& run) {
  std::vector<std::string> differences;
  const auto set_keys = run.record.find("scene_set");
  if (set_keys == run.record.end() || !set_keys->is_array()) return differences;
  const Json& scene = recorded_scene(run.record);
  for (const Json& entry : *set_keys) {
    if (!entry.is_string()) continue;
    const auto key = entry.get<std::string>();
    if (is_free(key) || !scene.contains(key) || (is_torus(run) && is_free_on_torus(key))) continue;
    const std::optional<Json> paper = paper_value(key, scene_text(run.record, "wall.law"));
    if (paper && *paper == scene[key]) continue;
    differences.push_back(paper ? fmt::format("{} = {} (paper: {})", key, scene[key].dump(), paper->dump())
                                : fmt::format("{} = {}", key, scene[key].dump()));
  }
  return differences;
}

std::vector<ReadingGroup> group_by_reading(const std::vector<StoredResult>& runs,
                                           const std::vector<std::string>& names,
                                           std::vector<std::string>& left_out) {
  std::vector<ComparedRun> usable;
  std::vector<Reading> readings;
  for (std::size_t index = 0; index < runs.size(); ++index) {
    const StoredResult& run = runs[index];
    const auto leave_out = [&](const std::string& why) {
      left_out.push_back(fmt::format("{}: {}", names[index], why));
    };
    ComparedRun compared{&run, scene_text(run.record, "wall.law"), {}};
    const auto is_paper_law = [&](const PaperLaw& law) { return law.name == compared.law; };
    if (std::none_of(std::begin(paper_laws), std::end(paper_laws), is_paper_law)) {
      leave_out("not one of the paper's laws");
      continue;
    }
    if (const auto differences = differences_from_paper(run); !differences.empty()) {
      leave_out(fmt::format("not one of the paper's arteries: {}", fmt::join(differences, ", ")));
      continue;
    }
    if (run.result.observables.rows() == 0 || !(compared.beat = observables::last_beat(run)).whole) {
      leave_out("the run ended before its first beat was over");
      continue;
    }
    const Reading reading = read_reading(run);
    bool is_repeated = false;
    for (std::size_t k = 0; k < usable.size(); ++k)
      is_repeated |= usable[k].law == compared.law && same_reading(readings[k], reading);
    if (is_repeated) {
      leave_out("another run of this law and reading is compared");
      continue;
    }
    usable.push_back(std::move(compared));
    readings.push_back(reading);
  }

  // The most specific readings name the groups; a run with less to read joins all it fits.
  std::vector<ReadingGroup> groups;
  for (const bool want_activation : {true, false})
    for (const bool want_exponent : {true, false})
      for (const Reading& reading : readings) {
        if (std::isnan(reading.activation_squared) == want_activation) continue;
        if ((reading.exponent == 0) == want_exponent) continue;
        const bool covered = std::any_of(groups.begin(), groups.end(), [&](const ReadingGroup& group) {
          return fits(reading, group.reading);
        });
        if (!covered) groups.push_back({reading, {}});
      }
  for (ReadingGroup& group : groups)
    for (const PaperLaw& law : paper_laws)
      for (std::size_t index = 0; index < usable.size(); ++index) {
        if (usable[index].law != law.name || !fits(readings[index], group.reading)) continue;
        group.runs.push_back(usable[index]);
      }
  return groups;
}

}  // namespace tunica::verification
