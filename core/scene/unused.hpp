// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.hpp"

namespace tunica::scene {

/// Keys that a scene may set although a tier, or a mode of it, does nothing with them.
struct Unused {
  std::vector<std::string_view> keys;  ///< "time.step"; with a dot behind it ("mesh.") a whole table
  std::string_view reason;
};

/// A line for each reason with the keys of it that the scene file or an override sets: "mesh.element and
/// time.step are not used: the 0D tier has no mesh". Keys that an earlier line names are left out.
std::vector<std::string> remarks_on(const Scene& scene, std::span<const Unused> unused);

}  // namespace tunica::scene
