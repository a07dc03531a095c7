// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "core/coupled/conditions.hpp"
#include "core/physics/mesh_motion.hpp"
#include "full3d/mesh.hpp"

namespace tunica::full3d {

using coupled::Discretisation;
using coupled::Element;
using coupled::InletKind;
using coupled::OutletKind;
using Prescribed = coupled::Prescribed<3>;

/// Circumference and axis of the vessel at a point of the unloaded wall, unit vectors, NaN where the mesh
/// leaves them open. The point is given both by its cell and local coordinates and by where it is.
using WallDirections =
    std::function<wall::MaterialAxes(int cell, const element::solid::Local& local, const Point& point)>;

/// Everything that is computed with: a vessel in space, or its blood or its wall alone.
struct Problem : coupled::Conditions<3> {
  Mesh mesh;
  WallDirections directions;
  /// How the mesh in the blood moves within sections, at a point, where it does (MeshMotion::sectional).
  std::function<physics::MotionInSections(const Point& point)> sections;
};

}  // namespace tunica::full3d
