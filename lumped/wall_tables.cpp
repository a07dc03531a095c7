// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/wall_tables.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_map>

#include "core/observables/result.hpp"
#include "core/radial/from_scene.hpp"

namespace tunica::lumped {

namespace {

/// Relative accuracy of the wall's response: small beside what the scene asks for, as slopes and recruitment
/// show more of an error than pressures.
double wall_accuracy(const Scene& scene) {
  return std::clamp(2e-2 * scene.number("accuracy.tolerance"), 1e-10, 3e-4);
}

/// xi of P1..P4.
std::vector<double> wall_places() {
  std::vector<double> places;
  for (int k = 0; k < observables::wall_points; ++k)
    places.push_back(static_cast<double>(k) / (observables::wall_points - 1));
  return places;
}

void append(std::string& text, std::string_view bytes) {
  text += bytes;
  text += '\0';
}

/// Everything that the wall's response is computed from.
std::string identity(const Scene& scene) {
  constexpr std::array of_ring{"geometry.radius", "geometry.thickness", "tether.stiffness", "tether.traction",
                               "accuracy.tolerance"};
  std::string text;
  for (const auto& [key, value] : scene.values()) {
    if (!key.starts_with("wall.") && std::find(of_ring.begin(), of_ring.end(), key) == of_ring.end())
      continue;
    append(text, key);
    if (const double* number = std::get_if<double>(&value))
      append(text, {reinterpret_cast<const char*>(number), sizeof *number});
    else if (const auto* word = std::get_if<std::string>(&value))
      append(text, *word);
    else if (const bool* flag = std::get_if<bool>(&value))
      append(text, *flag ? "true" : "false");
    else if (const long* integer = std::get_if<long>(&value))
      append(text, std::to_string(*integer));
  }
  return text;
}

}  // namespace

std::shared_ptr<const WallTable> wall_table(const Scene& scene, const std::vector<std::string>& parameters) {
  const auto make = [&] {
    return std::make_shared<const WallTable>(radial::ring_model(scene, parameters, wall_accuracy(scene)),
                                             wall_places());
  };
  if (!parameters.empty()) return make();
  thread_local std::unordered_map<std::string, std::shared_ptr<const WallTable>> kept;
  // Some tens of kilobytes each.
  constexpr std::size_t most = 1000;
  const std::string key = identity(scene);
  if (const auto found = kept.find(key); found != kept.end()) return found->second;
  if (kept.size() >= most) kept.clear();
  return kept[key] = make();
}

}  // namespace tunica::lumped
