// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/radial/wall_curve.hpp"
#include "core/scene/scene.hpp"

namespace tunica::lumped {

/// The response of a scene's wall at P1..P4, as accurate as the scene asks, with derivatives by the
/// parameters. Scenes that differ in nothing that the wall knows (inflow, outlet, blood, length, times)
/// share one, which a sweep then tabulates once. It belongs to the thread that asks: others have their own.
/// A thread keeps some thousand of the latest. Throws InvalidInput as radial::ring_model does.
std::shared_ptr<const radial::WallCurve> wall_curve(const Scene& scene,
                                                    const std::vector<std::string>& parameters);

}  // namespace tunica::lumped
