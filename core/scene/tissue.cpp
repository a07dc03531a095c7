// SPDX-License-Identifier: GPL-3.0-or-later
// How the wall, its layers and their collagen families get complete values.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scene/message.hpp"
#include "core/scene/reader.hpp"

namespace tunica {

namespace {

/// Keys of a tissue that its law may read, in the order of the manual.
const std::vector<std::string>& law_keys() {
  static const std::vector<std::string> keys = [] {
    constexpr std::string_view layer = "wall.layers[].";
    std::vector<std::string> names;
    for (const scene::Parameter& parameter : scene::parameters()) {
      if (!parameter.key.starts_with(layer)) continue;
      const std::string name = parameter.key.substr(layer.size());
      const bool own =
          name == "name" || name == "fraction" || name == "law" || name.starts_with("families[]");
      if (!own) names.push_back(name);
    }
    return names;
  }();
  return keys;
}

/// Keys whose value means the same whatever the law, so that layers take them from the wall.
bool independent_of_law(std::string_view key) {
  return key == "bulk_modulus" || key == "exponent" || key == "recruitment" || key == "sharpness";
}

bool is_activation(std::string_view key) {
  return key == "activation_stretch" || key == "activation_squared";
}

/// The tissue's value that a family's key falls back on.
std::string tissue_key(const std::string& family_key) {
  return "fiber_" + family_key;
}

}  // namespace

void SceneReader::read_wall() {
  const std::string wall = "wall.";
  take("wall.law");
  const wall::LawEntry& wall_law = *wall::find_law(scene_.text("wall.law"));
  const std::size_t layers = given_.count("wall.layers");
  scene_.counts_["wall.layers"] = layers;
  read_tissue(wall, wall_law, {wall});
  for (std::size_t i = 0; i < layers; ++i) {
    const std::string layer = fmt::format("wall.layers[{}].", i);
    take(layer + "name");
    take(layer + "fraction");
    if (!scene_.has(layer + "fraction"))
      refuse(layer + "fraction",
             fmt::format("{}fraction is missing; give each layer its share of the wall's thickness", layer));
    take(layer + "law");
    if (!scene_.has(layer + "law")) scene_.values_[layer + "law"] = std::string(wall_law.name);
    const wall::LawEntry& law = *wall::find_law(scene_.text(layer + "law"));
    read_tissue(layer, law, &law == &wall_law ? Prefixes{layer, wall} : Prefixes{layer});
  }
  if (layers > 0) {
    check_fractions();
    remark_on_wall_keys_without_use();
  }
}

void SceneReader::read_tissue(const std::string& prefix, const wall::LawEntry& law, const Prefixes& sources) {
  const std::string source = families_source(prefix, sources);
  const std::size_t families = given_.count(source + "families");
  scene_.counts_[prefix + "families"] = law.has_fibers ? families : 0;
  if (families > 0 && !law.has_fibers && source == prefix)
    scene_.remarks_.push_back(
        fmt::format("{}families are not used: the law {} has no fibres", prefix, law.name));
  const bool layered_wall = prefix == "wall." && given_.count("wall.layers") > 0;
  for (const std::string& key : law_keys()) {
    const std::string reason = reason_unused_in_tissue(prefix, key, law, sources);
    if (reason.empty())
      read_tissue_key(prefix, key, law, sources);
    else if (!layered_wall)
      leave_out(prefix + key, reason);
  }
  read_families(prefix, source, law, sources);
  if (!layered_wall) check_law(prefix, law);
}

std::string SceneReader::reason_unused_in_tissue(const std::string& prefix, std::string_view key,
                                                 const wall::LawEntry& law, const Prefixes& sources) const {
  if (!wall::law_reads(law, key)) return fmt::format("the law {} does not read it", law.name);
  if (key == "bulk_modulus" && scene_.flag("wall.incompressible")) return "wall.incompressible is true";
  if (key == "fiber_angle" && scene_.count(prefix + "families") > 0)
    return "its families give their own angles";
  if (is_activation(key)) {
    const std::string used = activation(sources, law).first;
    if (used != key) return fmt::format("{} is given", used);
  }
  return {};
}

void SceneReader::read_tissue_key(const std::string& prefix, const std::string& key,
                                  const wall::LawEntry& law, const Prefixes& sources) {
  const std::string full = prefix + key;
  if (given_.find(full)) return take(full);
  if (is_activation(key)) {
    scene_.values_[full] = activation(sources, law).second;
    return;
  }
  const bool from_wall = independent_of_law(key) || sources.back() == "wall.";
  if (const scene::GivenValue* given = given_.find("wall." + key); given && from_wall) {
    scene_.values_[full] = given->value;
    return;
  }
  const auto of_law = std::find_if(law.parameters.begin(), law.parameters.end(),
                                   [&](const wall::LawParameter& parameter) { return parameter.key == key; });
  if (of_law != law.parameters.end())
    scene_.values_[full] = of_law->value;
  else if (const auto& value = scene::find_parameter("wall." + key)->default_value)
    scene_.values_[full] = *value;
}

std::pair<std::string, scene::Value> SceneReader::activation(const Prefixes& sources,
                                                             const wall::LawEntry& law) const {
  for (const std::string& source : sources)
    for (const char* key : {"activation_squared", "activation_stretch"})
      if (const scene::GivenValue* given = given_.find(source + key)) return {key, given->value};
  for (const wall::LawParameter& parameter : law.parameters)
    if (parameter.key == "activation_stretch") return {"activation_stretch", parameter.value};
  throw std::logic_error(fmt::format("the law {} has no activation", law.name));
}

std::string SceneReader::families_source(const std::string& prefix, const Prefixes& sources) const {
  const bool own = given_.count(prefix + "families") > 0 || given_.find(prefix + "fiber_angle");
  return own ? prefix : sources.back();
}

void SceneReader::read_families(const std::string& prefix, const std::string& source,
                                const wall::LawEntry& law, const Prefixes& tissue_sources) {
  for (std::size_t i = 0; i < scene_.count(prefix + "families"); ++i) {
    const std::string family = fmt::format("{}families[{}].", prefix, i);
    const std::string from = fmt::format("{}families[{}].", source, i);
    const auto store = [&](const std::string& key, const scene::Value& value) {
      scene_.values_[family + key] = value;
    };
    const auto read = [&](const std::string& key) -> const scene::GivenValue* {
      const scene::GivenValue* value = given_.find(from + key);
      if (!value) return nullptr;
      store(key, value->value);
      if (from == family) scene_.set_.insert(family + key);
      return value;
    };

    if (!read("angle"))
      refuse(from + "angle", fmt::format("{}angle is missing; give each family its angle in deg", from));
    if (!read("weight")) store("weight", *scene::find_parameter(family + "weight")->default_value);
    for (const std::string key : {"stiffness", "stiffening"}) {
      if (!read(key)) store(key, scene_.values_.at(prefix + tissue_key(key)));
    }
    Prefixes sources{from};
    sources.insert(sources.end(), tissue_sources.begin(), tissue_sources.end());
    for (const std::string key : {"activation_squared", "activation_stretch"}) {
      const std::string reason = !law.has_activation ? fmt::format("the law {} does not read it", law.name)
                                 : activation(sources, law).first != key ? "activation_squared is given"
                                                                         : "";
      if (!reason.empty()) {
        if (from == family) leave_out(family + key, reason);
      } else if (!read(key)) {
        store(key, activation(sources, law).second);
      }
    }
  }
}

void SceneReader::remark_on_wall_keys_without_use() {
  const std::size_t layers = scene_.count("wall.layers");
  const std::size_t families = given_.count("wall.families");
  bool families_used = families == 0;
  for (std::size_t i = 0; i < layers; ++i)
    families_used |= scene_.count(fmt::format("wall.layers[{}].families", i)) == families;
  if (!families_used) scene_.remarks_.emplace_back("wall.families are not used: no layer takes them over");
  for (const std::string& key : law_keys()) {
    const scene::GivenValue* given = given_.find("wall." + key);
    if (!given) continue;
    bool used = false;
    for (std::size_t i = 0; i < layers && !used; ++i) {
      const auto value = scene_.values_.find(fmt::format("wall.layers[{}].{}", i, key));
      used = value != scene_.values_.end() && value->second == given->value;
    }
    if (!used)
      scene_.remarks_.push_back(
          fmt::format("wall.{0} is not used: no layer takes it over; set wall.layers[0].{0} and so on", key));
  }
}

}  // namespace tunica
