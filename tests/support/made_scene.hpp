// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/run/door.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica::test_support {

/// The door of a scene "made" of defaults, for tiers that the caller has.
inline run::Door door_of_made_scene(std::vector<std::string> overrides = {}) {
  static const TierList none;
  const TemporaryFolder folder;
  const auto file = folder.path() / "made.toml";
  write_whole(file, "[geometry]\n");
  return {none, run::SceneSource(file, std::move(overrides))};
}

}  // namespace tunica::test_support
