// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "axisym/mesh.hpp"

namespace tunica::axisym {

/// A point of a mesh: in quadrilaterals local coordinates are in [-1, 1]^2, in triangles in (0,0), (1,0),
/// (0,1).
struct Place {
  int cell;
  std::array<double, 2> local;
};

/// The place of a point (r, z) in a part, nothing if it lies outside. Newton's method on the quadratic
/// map; a point counts as inside to 1e-9 of the cell's size, and then its local coordinates are in the closed
/// reference cell. Of the cells that share a boundary point the one of the lowest index is taken.
std::optional<Place> locate(const Mesh& mesh, std::array<double, 2> point, Part part);

/// What the plane of height z cuts, seen from the axis: the lumen up to where the plane first meets the
/// interface, then the wall.
struct Section {
  double height;              ///< z, cm
  double inner;               ///< radius of the interface, cm
  double outer;               ///< radius of the outer surface, cm; equals `inner` without a wall
  std::vector<double> blood;  ///< radii from 0 to `inner` where the plane passes from cell to cell
  std::vector<double> wall;   ///< radii from `inner` to `outer` likewise
};

/// Throws InvalidInput if the plane does not cut the vessel.
Section section_at(const Mesh& mesh, double z);

/// A point of a quadrature rule over a section; sum of weights = integral dr.
struct SectionPoint {
  double radius;  ///< cm
  double weight;  ///< cm
  Place place;
};

/// Gauss-Legendre rule of `points` points between each two cell boundaries of the part.
std::vector<SectionPoint> section_rule(const Mesh& mesh, const Section& section, Part part, int points);

}  // namespace tunica::axisym
