// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/scene/scene.hpp"

/// What is known of the 3D tier without its libraries, so that a program which hands its scenes over to
/// another can tell.
namespace tunica::full3d {

inline constexpr const char* tier_name = "full3d";

/// As Tier::refusal and Tier::suits.
std::string refusal(const Scene& scene);
bool suits(const Scene& scene);

}  // namespace tunica::full3d
