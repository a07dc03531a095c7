// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/scene/scene.hpp"

namespace tunica::stability {

/// The surrounding tissue does not turn with the wall, or there is none: ripples may grow
/// (docs/verification/tether-stability.md).
bool may_ripple(const Scene& scene);

/// One line that says at which lumen pressures up to the greatest one (dyn/cm2) the smooth wall of the scene
/// is linearly unstable to axisymmetric ripples, of which wave lengths, how fast they grow, and the remedy.
/// None when it is stable, and none when it has no equilibrium at that pressure, which is a failure of its
/// own. Pressures are good to about 1 mmHg. Takes 5 to 20 ms for the paper's wall.
std::optional<std::string> warning(const Scene& scene, double greatest_pressure);

}  // namespace tunica::stability
