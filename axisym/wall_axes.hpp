// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "axisym/problem.hpp"

namespace tunica::axisym {

struct WallTable;

/// Circumference and axis of the vessel within its wall: e_theta, and the direction of grad(phi), where
///   div grad phi = 0 in the wall, phi = 0 and 1 on its end faces, d(phi)/dn = 0 on its surfaces.
/// This direction follows both surfaces and goes over from the one to the other in between. The equation is
/// that of the solid of revolution (measure 2 pi r): the wall of a mesh in three dimensions, which knows no
/// half plane, has the same axes. Layers are one wall.
///
/// phi is computed in the basis of the displacement, so that the direction is of its gradient's order: 2 with
/// the quadratic element, 1 with the others. A wall between two cylinders and two planes z = const has e_z
/// exactly.
class WallAxes {
 public:
  /// e_z everywhere.
  WallAxes() = default;
  /// `wall`: the wall's cells with their weights and shape functions. Keeps a reference to the mesh.
  WallAxes(const Problem& problem, const std::vector<WallTable>& wall);

  /// At a local point of a wall cell; the axis is NaN where the mesh leaves phi constant, as in a cell with
  /// all of its corners on one end face.
  wall::MaterialAxes at(int cell, const element::Local& local) const;

 private:
  const Mesh* mesh_ = nullptr;
  Element element_ = Element::quadratic;
  std::vector<double> potential_;  ///< phi by node; empty where the axis is e_z
};

}  // namespace tunica::axisym
