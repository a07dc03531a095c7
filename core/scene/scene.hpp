// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/parameter.hpp"

namespace tunica {

/// A scene with every default filled in and every check passed: what a tier computes.
///
/// Values are reached by their key ("wall.bulk_modulus", "wall.layers[0].fraction") and are in CGS
/// units (degrees for angles). Asking for a key that is not declared, has another kind or does not
/// apply to this scene (a fibre angle of an isotropic law) is a programming error: std::logic_error.
class Scene {
 public:
  double number(std::string_view key) const;
  long integer(std::string_view key) const;
  bool flag(std::string_view key) const;
  const std::string& text(std::string_view key) const;
  const std::vector<double>& numbers(std::string_view key) const;
  const std::vector<std::string>& texts(std::string_view key) const;

  /// True when the key holds a value: set in the file, or by a default that applies to this scene.
  bool has(std::string_view key) const;
  /// True when the scene file or an override gave the value, false for a default.
  bool was_set(std::string_view key) const;
  /// Number of tables in an array of tables: count("wall.layers").
  std::size_t count(std::string_view array_key) const;

  /// The scene with another value of a number and nothing checked: for derivatives, whose values lie beside
  /// one that was. All else is as it is but for a flow that was not given, which follows the lumen's area.
  Scene with_number(std::string_view key, double value) const;

  /// Name for titles and logs: the file's stem.
  const std::string& name() const { return name_; }
  /// Folder that relative file names in the scene start from.
  const std::filesystem::path& folder() const { return folder_; }
  /// Things a user should know although the scene is valid: keys that its choices do not use, numbers that
  /// look like another unit's, loads that no artery lives with.
  const std::vector<std::string>& remarks() const { return remarks_; }

  /// All values by key, sorted, defaults included.
  const std::map<std::string, scene::Value, std::less<>>& values() const { return values_; }

 private:
  friend class SceneReader;
  std::string name_;
  std::filesystem::path folder_;
  std::map<std::string, scene::Value, std::less<>> values_;
  std::set<std::string, std::less<>> set_;
  std::map<std::string, std::size_t, std::less<>> counts_;
  std::vector<std::string> remarks_;
};

/// Reads a TOML scene, applies overrides ("key=value", the value as TOML or as a bare string), fills
/// in the defaults and checks everything that can be checked before any work.
/// Throws InvalidInput with one line: key, value, what is allowed, nearest known name.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same from text; `name` stands for the file in messages. `folder` resolves relative paths.
Scene parse_scene(std::string_view toml_text, std::string name, const std::filesystem::path& folder,
                  const std::vector<std::string>& overrides = {});

/// The complete scene as TOML with unit and meaning of every key as a comment. Reading it back gives
/// the same scene (numbers are written with 17 digits where needed).
std::string describe(const Scene& scene);

/// The keys that sensitivity.parameters may name in a scene: numbers of the physics that act in it.
std::vector<std::string> keys_with_sensitivity(const Scene& scene);

/// Converts "75 mmHg" to a number in `target_unit`. Throws InvalidInput when the text is no number
/// with a unit or when its dimension is another one. `key` is for the message.
double convert_quantity(std::string_view text, const std::string& target_unit, std::string_view key);

/// The factor from a unit to `target`. Throws InvalidInput, beginning with `complaint` and ending with
/// `remedy`, for what is no unit, holds a number, is not known or has another dimension.
double unit_factor(const std::string& text, const std::string& target, const std::string& complaint,
                   const std::string& remedy);

}  // namespace tunica
