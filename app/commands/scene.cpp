// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/commands/commands.hpp"
#include "core/error.hpp"
#include "core/scene/manual.hpp"
#include "core/scene/scene.hpp"

namespace tunica {

namespace fs = std::filesystem;

namespace {

/// Folder of the shipped scenes: beside the installed program, or in the source tree it was built from.
fs::path scenes_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / TUNICA_SCENES_FROM_PREFIX;
  return fs::is_directory(installed, error) ? installed : fs::path(TUNICA_SOURCE_SCENES);
}

/// What the scene asks: its first comment line, the licence's apart.
std::string first_comment(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line)) {
    const auto text = line.find_first_not_of("# ");
    const bool is_comment = !line.empty() && line[0] == '#' && text != std::string::npos;
    if (is_comment && line.find("SPDX") == std::string::npos) return line.substr(text);
  }
  return {};
}

int list_scenes() {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(scenes_folder(), error))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (files.empty())
    throw InvalidInput(fmt::format("{}: no scenes found here; install Tunica or run it from its build",
                                   scenes_folder().string()));
  std::sort(files.begin(), files.end());
  for (const auto& file : files) fmt::print("{}\n    {}\n", file.string(), first_comment(file));
  return done;
}

}  // namespace

int scene_command(const SceneArguments& arguments) {
  if (arguments.list) return list_scenes();
  if (arguments.parameters) {
    fmt::print("{}", scene::manual());
    return done;
  }
  if (arguments.scene.empty())
    throw InvalidInput(
        "scene: name a scene file, or --list for the scenes at hand, or --parameters for every key");
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  for (const auto& remark : scene.remarks()) fmt::print("# {}\n", remark);
  fmt::print("{}", describe(scene));
  return done;
}

}  // namespace tunica
