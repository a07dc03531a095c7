// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/scene.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tunica {

namespace {

template <class T>
const T& value_at(const Scene& scene, std::string_view key) {
  const auto entry = scene.values().find(key);
  if (entry == scene.values().end())
    throw std::logic_error(
        fmt::format("the scene {} holds no {}: it does not apply or is not declared", scene.name(), key));
  if (const T* value = std::get_if<T>(&entry->second)) return *value;
  throw std::logic_error(fmt::format("{} is of another kind than the one asked for", key));
}

}  // namespace

double Scene::number(std::string_view key) const {
  return value_at<double>(*this, key);
}
long Scene::integer(std::string_view key) const {
  return value_at<long>(*this, key);
}
bool Scene::flag(std::string_view key) const {
  return value_at<bool>(*this, key);
}
const std::string& Scene::text(std::string_view key) const {
  return value_at<std::string>(*this, key);
}
const std::vector<double>& Scene::numbers(std::string_view key) const {
  return value_at<std::vector<double>>(*this, key);
}
const std::vector<std::string>& Scene::texts(std::string_view key) const {
  return value_at<std::vector<std::string>>(*this, key);
}

bool Scene::has(std::string_view key) const {
  return values_.contains(key);
}

bool Scene::was_set(std::string_view key) const {
  return set_.contains(key);
}

std::size_t Scene::count(std::string_view array_key) const {
  const auto entry = counts_.find(array_key);
  if (entry == counts_.end())
    throw std::logic_error(fmt::format("the scene {} has no array of tables {}", name_, array_key));
  return entry->second;
}

Scene Scene::with_number(std::string_view key, double value) const {
  value_at<double>(*this, key);
  Scene other = *this;
  other.values_.find(key)->second = value;
  if (key == "geometry.radius" && has("inlet.flow") && !was_set("inlet.flow")) {
    const double ratio = value / number(key);
    other.values_.find("inlet.flow")->second = number("inlet.flow") * ratio * ratio;
  }
  return other;
}

}  // namespace tunica
