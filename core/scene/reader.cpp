// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/slips.hpp"
#include "core/scene/text.hpp"
#include "core/scene/waveform_file.hpp"

namespace tunica {

namespace {

const std::vector<std::string>& named_waveforms() {
  static const std::vector<std::string> names{"ica", "constant", "pressure", "pulse"};
  return names;
}

bool is_waveform_file(std::string_view waveform) {
  return waveform.ends_with(".csv");
}

bool is_law_key(std::string_view key) {
  constexpr std::string_view wall = "wall.";
  return key.starts_with(wall) &&
         scene::find_parameter("wall.layers[0]." + std::string(key.substr(wall.size()))) != nullptr;
}

}  // namespace

SceneReader::SceneReader(scene::GivenScene given, std::string name, std::filesystem::path folder)
    : given_(std::move(given)) {
  scene_.name_ = std::move(name);
  scene_.folder_ = std::move(folder);
}

Scene SceneReader::read() {
  read_plain_keys();
  read_waveform_file();
  fill_derived_defaults();
  read_wall();
  check();
  remark_on_slips();
  return std::move(scene_);
}

void SceneReader::read_plain_keys() {
  // Choices are declared before the keys that they make useful.
  for (const scene::Parameter& parameter : scene::parameters()) {
    if (parameter.key.find("[]") != std::string::npos || is_law_key(parameter.key)) continue;
    const std::string reason = reason_unused(parameter.key);
    if (reason.empty())
      take(parameter.key);
    else
      leave_out(parameter.key, reason);
  }
}

std::string SceneReader::reason_unused(std::string_view key) const {
  const auto because = [&](const char* choice) {
    return fmt::format("{} is {}", choice, scene::in_quotes(scene_.text(choice)));
  };
  if (key == "geometry.bend_angle" && scene_.text("geometry.kind") != "torus")
    return because("geometry.kind");
  if (key == "outlet.proximal_resistance" || key == "outlet.compliance")
    return scene_.text("outlet.kind") == "rcr" ? "" : because("outlet.kind");
  if (key == "time.ramp" && scene_.text("time.start") != "rest") return because("time.start");
  if (key == "inlet.flow" || key == "inlet.pressure") {
    const std::string& waveform = scene_.text("inlet.waveform");
    const bool is_pressure = waveform == "pressure" || waveform == "pulse";
    const bool used = !is_waveform_file(waveform) && is_pressure == (key == "inlet.pressure");
    return used ? "" : because("inlet.waveform");
  }
  if (key == "inlet.duration" && scene_.text("inlet.waveform") != "pulse") return because("inlet.waveform");
  if (key == "geometry.file" && scene_.text("geometry.kind") != "mesh") return because("geometry.kind");
  const bool shapes_cylinder = key == "mesh.cell" || key == "mesh.symmetry" || key.ends_with("_cells");
  if (shapes_cylinder && scene_.text("geometry.kind") == "mesh") return because("geometry.kind");
  if (key == "mesh.cell" && scene_.text("mesh.element") == "bubble") return because("mesh.element");
  if ((key == "time.scheme" || key == "time.step") && scene_.text("time.mode") == "static")
    return because("time.mode");
  return {};
}

void SceneReader::read_waveform_file() {
  const std::string& waveform = scene_.text("inlet.waveform");
  const std::vector<std::string>& names = named_waveforms();
  if (std::find(names.begin(), names.end(), waveform) != names.end()) return;
  if (!is_waveform_file(waveform)) {
    const std::string near = scene::nearest(waveform, names);
    refuse("inlet.waveform",
           fmt::format("inlet.waveform = {} is not known; write \"ica\", \"constant\", \"pressure\", "
                       "\"pulse\" or the name of a .csv file{}",
                       scene::in_quotes(waveform),
                       scene::did_you_mean(near.empty() ? near : scene::in_quotes(near))));
  }
  double period = 0;
  try {
    period = scene::read_waveform(scene_.folder_ / waveform).period;
  } catch (const InvalidInput& error) {
    refuse("inlet.waveform", fmt::format("inlet.waveform: {}", error.what()));
  }
  const scene::GivenValue* given = given_.find("inlet.period");
  if (given && std::get<double>(given->value) != period)
    scene_.remarks_.push_back(fmt::format("inlet.period is not used: {} has a period of {:g} s",
                                          scene::in_quotes(waveform), period));
  scene_.values_["inlet.period"] = period;
}

void SceneReader::fill_derived_defaults() {
  if (reason_unused("inlet.flow").empty() && !scene_.has("inlet.flow")) {
    constexpr double reference_flow = 255.0 / 60.0;  // cm3/s, internal carotid artery
    constexpr double reference_radius = 0.195;       // cm
    scene_.values_["inlet.flow"] =
        reference_flow * std::pow(scene_.number("geometry.radius") / reference_radius, 2);
  }
  if (!scene_.was_set("output.profile_times")) {
    // Of the carotid waveform with its period of 0.8 s: peak flow, and late in the beat.
    const double stretched = scene_.number("inlet.period") / 0.8;
    scene_.values_["output.profile_times"] = std::vector<double>{0.2112 * stretched, 0.6 * stretched};
  }
}

void SceneReader::take(const std::string& key) {
  if (const scene::GivenValue* given = given_.find(key)) {
    scene_.values_[key] = given->value;
    scene_.set_.insert(key);
  } else if (const auto& value = scene::find_parameter(key)->default_value) {
    scene_.values_[key] = *value;
  }
}

void SceneReader::leave_out(const std::string& key, const std::string& reason) {
  if (given_.find(key)) scene_.remarks_.push_back(fmt::format("{} is not used: {}", key, reason));
}

void SceneReader::remark_on_slips() {
  const auto is_plain = [this](std::string_view key) {
    const scene::GivenValue* given = given_.find(key);
    return given && given->is_plain;
  };
  for (const auto& remarks :
       {scene::remarks_on_units(scene_, is_plain), scene::remarks_on_loads(scene_, is_plain)})
    scene_.remarks_.insert(scene_.remarks_.end(), remarks.begin(), remarks.end());
}

void SceneReader::refuse(std::string_view key, const std::string& message) const {
  const scene::GivenValue* given = given_.find(key);
  const double* number = given && given->is_plain ? std::get_if<double>(&given->value) : nullptr;
  throw InvalidInput(fmt::format("{}: {}{}", given ? given->where : given_.label, message,
                                 scene::did_you_mean(number ? scene::unit_meant(key, *number) : "")));
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const std::string text = scene::load_text(file, "scene", ".toml", scene::largest_scene);
  const std::string label = scene::one_line(file.string(), 400);
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  return SceneReader(scene::read_given(text, label, overrides), file.stem().string(), folder).read();
}

Scene parse_scene(std::string_view toml_text, std::string name, const std::filesystem::path& folder,
                  const std::vector<std::string>& overrides) {
  const std::string label = scene::one_line(name, 400);
  constexpr std::string_view extension = ".toml";
  if (name.ends_with(extension)) name.resize(name.size() - extension.size());
  return SceneReader(scene::read_given(toml_text, label, overrides), std::move(name), folder).read();
}

}  // namespace tunica
