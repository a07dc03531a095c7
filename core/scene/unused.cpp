// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/unused.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace tunica::scene {

std::vector<std::string> remarks_on(const Scene& scene, std::span<const Unused> unused) {
  std::vector<std::string> lines;
  std::set<std::string> told;
  for (const Unused& one : unused) {
    std::vector<std::string> set;
    for (const auto& [key, value] : scene.values()) {
      const auto names = [&](std::string_view name) {
        return name.ends_with('.') ? key.starts_with(name) : key == name;
      };
      if (scene.was_set(key) && std::any_of(one.keys.begin(), one.keys.end(), names) &&
          told.insert(key).second)
        set.push_back(key);
    }
    if (set.empty()) continue;
    const std::string last = set.back();
    set.pop_back();
    lines.push_back(set.empty()
                        ? fmt::format("{} is not used: {}", last, one.reason)
                        : fmt::format("{} and {} are not used: {}", fmt::join(set, ", "), last, one.reason));
  }
  return lines;
}

}  // namespace tunica::scene
