// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/record.hpp"

namespace tunica::observables {

namespace {

using Json = nlohmann::ordered_json;

const Json& member(const Json& object, std::string_view key) {
  static const Json nothing;
  if (!object.is_object()) return nothing;
  const auto found = object.find(key);
  return found == object.end() ? nothing : *found;
}

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

}  // namespace

std::string record_text(const Json& record, std::string_view key) {
  return text_of(member(record, key));
}

bool record_flag(const Json& record, std::string_view key) {
  return member(record, key) == true;
}

const Json& recorded_scene(const Json& record) {
  static const Json empty = Json::object();
  const Json& scene = member(record, "scene");
  return scene.is_object() ? scene : empty;
}

std::string scene_text(const Json& record, std::string_view key) {
  return text_of(member(recorded_scene(record), key));
}

double scene_number(const Json& record, std::string_view key) {
  const Json& value = member(recorded_scene(record), key);
  return value.is_number() ? value.get<double>() : none;
}

}  // namespace tunica::observables
