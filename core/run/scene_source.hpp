// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/given.hpp"
#include "core/scene/scene.hpp"

namespace tunica::run {

/// A scene file and overrides that all cases made of it share, read once.
class SceneSource {
 public:
  /// Throws InvalidInput as read_scene does.
  explicit SceneSource(std::filesystem::path file, std::vector<std::string> overrides = {});

  /// The scene with further overrides ("key=value"). Throws InvalidInput as read_scene does. Where all of
  /// them are numbers of plain keys the file is not parsed again.
  Scene with(const std::vector<std::string>& overrides) const;

  const Scene& scene() const { return scene_; }  ///< without further overrides
  const std::filesystem::path& file() const { return file_; }
  const std::vector<std::string>& overrides() const { return overrides_; }

 private:
  Scene read(scene::GivenScene given) const;
  std::filesystem::path file_;
  std::vector<std::string> overrides_;
  std::string text_, label_;
  scene::GivenScene given_;  ///< by the file and overrides_
  Scene scene_;
};

}  // namespace tunica::run
