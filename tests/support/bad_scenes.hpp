// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace tunica::test_support {

/// A scene that must be refused before any work, with one line that helps its author.
struct BadScene {
  std::string name;  ///< letters, digits and underscores
  /// Writes the scene (and what it needs) into an empty folder and returns the path to read.
  std::function<std::filesystem::path(const std::filesystem::path& folder)> prepare;
  std::vector<std::string> overrides;  ///< "key=value"
  std::vector<std::string> words;      ///< what the message must contain: the place, the key, the remedy
};

/// Scenes that no tier takes: their file or their values are wrong.
const std::vector<BadScene>& bad_scenes();
/// Scenes that are sound by themselves, but not for the axisymmetric tier, with mesh files that are not for
/// them.
const std::vector<BadScene>& bad_axisym_scenes();

/// GoogleTest would print the bytes otherwise.
inline void PrintTo(const BadScene& scene, std::ostream* stream) {
  *stream << scene.name;
}

}  // namespace tunica::test_support
