// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/scene_source.hpp"

#include "core/scene/message.hpp"
#include "core/scene/override.hpp"
#include "core/scene/reader.hpp"
#include "core/scene/text.hpp"

namespace tunica::run {

SceneSource::SceneSource(std::filesystem::path file, std::vector<std::string> overrides)
    : file_(std::move(file)),
      overrides_(std::move(overrides)),
      text_(scene::load_text(file_, "scene", ".toml", scene::largest_scene)),
      label_(scene::one_line(file_.string(), 400)),
      given_(scene::read_given(text_, label_, overrides_)),
      scene_(read(given_)) {}

Scene SceneSource::read(scene::GivenScene given) const {
  return SceneReader(std::move(given), file_.stem().string(),
                     file_.has_parent_path() ? file_.parent_path() : ".")
      .read();
}

Scene SceneSource::with(const std::vector<std::string>& overrides) const {
  scene::GivenScene given = given_;
  for (const std::string& text : overrides) {
    if (scene::apply_number(given, text)) continue;
    std::vector<std::string> all = overrides_;
    all.insert(all.end(), overrides.begin(), overrides.end());
    return read(scene::read_given(text_, label_, all));
  }
  return read(std::move(given));
}

}  // namespace tunica::run
