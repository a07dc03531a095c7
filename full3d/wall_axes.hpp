// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "full3d/locate.hpp"
#include "full3d/problem.hpp"

namespace tunica::full3d {

/// Unit vectors of the wall: outwards, around the vessel, along it; right-handed in this order. NaN where
/// they are not known.
struct Directions {
  Vector<double> radial, circumferential, axial;
};
Directions directions_of(const wall::MaterialAxes& axes);

/// Of a problem's directions at a point, their mean over some places in wall cells that meet there: over
/// those that have one, NaN where none has.
Directions mean_directions(const Problem& problem, std::span<const Place> places, const Point& point);

/// Circumference and axis of the wall of a vessel of any shape, from harmonic functions in the wall.
/// The axis is the direction of grad(a),
///   div grad a = 0, a = 0 on wall_inlet, a = 1 on wall_outlet, da/dn = 0 on the surfaces,
/// as in the axisymmetric tier. The circumference is normal to it and to grad(t),
///   div (|grad a| grad t) = 0, t = 0 on the interface, t = 1 on outer, dt/dn = 0 on the ends,
/// which is Laplace's equation within each section a = const, |grad a| being the inverse of the distance
/// between sections: in a torus, where sections are planes, it has the torus's own directions. Layers are one
/// wall.
///
/// Both are computed in the basis of the displacement, so that directions are of their gradients' order: 2
/// with the quadratic element, 1 with the others.
class WallAxes {
 public:
  /// Keeps a reference to the mesh. Throws InvalidInput for a wall that has no way through.
  explicit WallAxes(const Mesh& mesh);

  /// At a local point of a wall cell; a direction that the mesh leaves open is NaN. That happens in cells
  /// with all of their corners on one boundary, or on two that meet, as along a crease of the surface.
  wall::MaterialAxes at(int cell, const element::solid::Local& local) const;

 private:
  const Mesh& mesh_;
  std::vector<double> along_, through_;  ///< a and t by node
};

}  // namespace tunica::full3d
