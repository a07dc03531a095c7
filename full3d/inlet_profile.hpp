// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>

#include "core/tensor.hpp"
#include "full3d/mesh.hpp"

namespace tunica::full3d {

/// Velocity of fully developed flow through an inlet of any shape, per unit of flow: v = u n, n the normal
/// into the vessel,
///   -div grad u = constant on the inlet, u = 0 where it meets the interface, int u dA = 1,
/// which is Poiseuille's parabola on a circle. In the basis of the velocity on the corners and middles. n is
/// the mean normal of an inlet that is not quite flat, whose flow is int u n.dA.
class InletProfile {
 public:
  /// Throws InvalidInput for an inlet that has no node within it, or whose area is larger than its projection
  /// along n by more than the tolerance, a share: by as much, some half of the square of the inclination, the
  /// velocity differs.
  InletProfile(const Mesh& mesh, double tolerance);
  /// v/Q at a node of the mesh, 1/cm2; 0 at nodes that are not on the inlet.
  Vector<double> at(const Point& node) const;

 private:
  Vector<double> normal_;
  std::map<Point, double> speed_;
};

/// The coordinate along which a boundary's mean normal is, up to `tolerance` (rad); -1 for none.
int normal_axis(const Mesh& mesh, Boundary boundary, double tolerance);

}  // namespace tunica::full3d
