// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/inputs.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include "core/error.hpp"
#include "core/scene/message.hpp"

namespace tunica {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string shown(const Scene& scene, const std::string& key) {
  const auto entry = scene.values().find(key);
  if (entry == scene.values().end()) return "not there";
  return scene::shown(entry->second);
}

/// "geometry.radius was 0.4 and is 0.5"; empty when they have the same values.
std::string first_difference(const Scene& kept, const Scene& scene) {
  std::set<std::string> keys;
  for (const Scene* one : {&kept, &scene})
    for (const auto& [key, value] : one->values()) keys.insert(key);
  for (const std::string& key : keys) {
    const std::string before = shown(kept, key), now = shown(scene, key);
    if (before != now) return fmt::format("{} was {} and is {}", key, before, now);
  }
  return {};
}

}  // namespace

std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t sum = 14695981039346656037U;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    sum *= 1099511628211U;
  }
  return sum;
}

Json input_files(const Scene& scene) {
  Json files = Json::object();
  for (const auto& [key, value] : scene.values()) {
    const auto* name = std::get_if<std::string>(&value);
    std::error_code no_file;
    if (name && !name->empty() && fs::is_regular_file(scene.folder() / *name, no_file))
      files[key] = fmt::format("{:016x}", checksum(contents(scene.folder() / *name)));
  }
  return files;
}

std::string changed_input(const Scene& scene, const Json& files, std::string_view kept_toml,
                          const Json& kept_files) {
  for (const auto& [key, sum] : files.items()) {
    const std::string name = scene::in_quotes(scene.text(key));
    const bool is_named = kept_toml.find(name) != std::string_view::npos;
    if (is_named && kept_files.is_object() && kept_files.value(key, Json()) != sum)
      return fmt::format("the contents of {} = {} have changed", key, name);
  }
  if (kept_toml == describe(scene)) return {};
  const std::string file = scene.name() + ".toml";
  try {
    const std::string difference = first_difference(parse_scene(kept_toml, file, scene.folder()), scene);
    return difference.empty() ? "" : fmt::format("{}: {}", file, difference);
  } catch (const InvalidInput&) {
    return file + " or a file that it names has changed";
  }
}

}  // namespace tunica
