// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "lumped/place_table.hpp"

namespace tunica::lumped {

/// The response of a scene's wall, and what is seen at its places.
struct WallTable {
  WallTable(std::unique_ptr<const radial::RingModel> model, std::vector<double> xi)
      : curve(std::move(model), std::move(xi)), places(curve) {}
  radial::WallCurve curve;
  PlaceTable places;
};

/// The response of a scene's wall at P1..P4, as accurate as the scene asks, with derivatives by the
/// parameters. Scenes that differ in nothing that the wall knows (inflow, outlet, blood, length, times)
/// share one, which a sweep then tabulates once. It belongs to the thread that asks: others have their own.
/// A thread keeps some thousand of the latest. Throws InvalidInput as radial::ring_model does.
std::shared_ptr<const WallTable> wall_table(const Scene& scene, const std::vector<std::string>& parameters);

}  // namespace tunica::lumped
