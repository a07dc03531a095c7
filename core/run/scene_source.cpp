// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/scene_source.hpp"

#include "core/scene/given.hpp"
#include "core/scene/message.hpp"
#include "core/scene/reader.hpp"
#include "core/scene/text.hpp"

namespace tunica::run {

SceneSource::SceneSource(std::filesystem::path file, std::vector<std::string> overrides)
    : file_(std::move(file)),
      overrides_(std::move(overrides)),
      text_(scene::load_text(file_, "scene", ".toml", scene::largest_scene)),
      scene_(with({})) {}

Scene SceneSource::with(const std::vector<std::string>& overrides) const {
  std::vector<std::string> all = overrides_;
  all.insert(all.end(), overrides.begin(), overrides.end());
  const std::filesystem::path folder = file_.has_parent_path() ? file_.parent_path() : ".";
  const std::string label = scene::one_line(file_.string(), 400);
  return SceneReader(scene::read_given(text_, label, all), file_.stem().string(), folder).read();
}

}  // namespace tunica::run
