// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/coupled/loading.hpp"
#include "full3d/resolution.hpp"
#include "full3d/vessel_shape.hpp"
#include "full3d/wall_axes.hpp"

namespace tunica::full3d {

/// A scene in the terms of this tier. Stays where it was made: the problem's functions refer to it.
struct Setup : coupled::Loading {
  Resolution resolution;
  /// With a mesh from a file the mean_tube of its wall, which has no more than the size of the vessel.
  VesselShape shape;
  Sector sector = Sector::full;
  Problem problem;
  std::unique_ptr<const WallAxes> axes;  ///< of a mesh from a file
};

/// Throws InvalidInput for a scene that this tier cannot compute.
std::unique_ptr<Setup> setup_of(const Scene& scene);
/// The same with other numbers of cells than the scene asks for.
std::unique_ptr<Setup> setup_of(const Scene& scene, const Resolution& resolution);

}  // namespace tunica::full3d
