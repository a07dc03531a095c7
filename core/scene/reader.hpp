// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/scene/given.hpp"
#include "core/scene/scene.hpp"
#include "core/wall/catalog.hpp"

namespace tunica {

/// Makes a complete scene of what a file gives: fills in defaults, lets layers and families inherit,
/// leaves out (with a remark) what the scene's choices do not use, and checks the values against each
/// other.
class SceneReader {
 public:
  SceneReader(scene::GivenScene given, std::string name, std::filesystem::path folder);
  Scene read();

 private:
  using Prefixes = std::vector<std::string>;

  // reader.cpp: everything but the wall
  void read_plain_keys();
  void read_waveform_file();
  void fill_derived_defaults();
  /// Why the scene's other choices make a key useless; empty when it is used.
  std::string reason_unused(std::string_view key) const;

  // tissue.cpp: the wall, its layers and families
  void read_wall();
  void read_tissue(const std::string& prefix, const wall::LawEntry& law, const Prefixes& sources);
  void read_tissue_key(const std::string& prefix, const std::string& key, const wall::LawEntry& law,
                       const Prefixes& sources);
  void read_families(const std::string& prefix, const std::string& source, const wall::LawEntry& law,
                     const Prefixes& tissue_sources);
  /// Whose families a tissue has: its own, or the wall's where they are inherited.
  std::string families_source(const std::string& prefix, const Prefixes& sources) const;
  std::string reason_unused_in_tissue(const std::string& prefix, std::string_view key,
                                      const wall::LawEntry& law, const Prefixes& sources) const;
  /// The recruitment threshold that the first source gives: "activation_squared" before
  /// "activation_stretch" within one source, the law's default when none gives either.
  std::pair<std::string, scene::Value> activation(const Prefixes& sources, const wall::LawEntry& law) const;
  void remark_on_wall_keys_without_use();
  void check_fractions() const;

  /// Adds what slips.hpp says of the scene to its remarks.
  void remark_on_slips();

  // checks.cpp: values against each other
  void check() const;
  void check_geometry() const;
  void check_times() const;
  void check_outlet() const;
  void check_law(const std::string& prefix, const wall::LawEntry& law) const;
  void check_sensitivities() const;

  /// Stores the given value, else the default of its declaration, if any.
  void take(const std::string& key);
  /// Leaves a key out of the scene, with a remark if it was given.
  void leave_out(const std::string& key, const std::string& reason);
  [[noreturn]] void refuse(std::string_view key, const std::string& message) const;

  scene::GivenScene given_;
  Scene scene_;
};

}  // namespace tunica
