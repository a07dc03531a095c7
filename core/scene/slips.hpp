// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.hpp"

namespace tunica::scene {

/// What a number without a unit was probably meant to be where the parameter's own unit makes no sense of it,
/// as a scene would write it: "80 mmHg", quotes included, for an outlet.pressure of 80; empty when it may be
/// meant as it is.
std::string unit_meant(std::string_view key, double value);

/// True for keys that the scene gives as numbers without a unit: those that may be slips.
using IsPlain = std::function<bool(std::string_view key)>;

/// One line for every number without a unit that makes no sense in its parameter's own.
std::vector<std::string> remarks_on_units(const Scene& scene, const IsPlain& is_plain);

/// What a scene makes of its loads before anything is computed, one line each where it is not what an artery
/// lives with: the mean pressure R Q + p_v of a prescribed flow Q through the outlet's resistance R, the mean
/// velocity Q/(pi R0^2), a flow that leaves through the inlet, the time R C of an RCR outlet, a ramp longer
/// than the pulse or the beat that it grows, a wall thicker than its lumen is wide. Where one number without
/// a unit explains it, the unit that it was meant in.
std::vector<std::string> remarks_on_loads(const Scene& scene, const IsPlain& is_plain);

}  // namespace tunica::scene
