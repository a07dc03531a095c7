// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "axisym/mesh.hpp"
#include "core/element/cell.hpp"

namespace tunica::test_support {

/// Volume of revolution of the cells that `counts` names, by the elements' own rule.
inline double volume(const axisym::Mesh& mesh, const std::function<bool(const axisym::Cell&)>& counts) {
  const auto rule = element::cell_rule(mesh.shape, element::Basis::quadratic);
  double sum = 0;
  for (int k = 0; k < static_cast<int>(mesh.cells.size()); ++k) {
    if (!counts(mesh.cells[k])) continue;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const axisym::Image at = axisym::image(mesh, k, rule.points[q]);
      sum += rule.weights[q] * 2 * std::numbers::pi * at.point[0] * at.determinant();
    }
  }
  return sum;
}

inline double volume(const axisym::Mesh& mesh, axisym::Part part) {
  return volume(mesh, [part](const axisym::Cell& cell) { return cell.part == part; });
}

/// Area of revolution of a boundary, and the integral of the normal that points out of the cells times
/// 2 pi r (radial, axial).
struct Surface {
  double area = 0, radial = 0, axial = 0;
};
inline Surface surface(const axisym::Mesh& mesh, axisym::Boundary boundary, axisym::Part part) {
  Surface sum;
  for (const axisym::Edge& edge : mesh.edges) {
    if (edge.boundary != boundary || mesh.cells[edge.cell].part != part) continue;
    const auto rule = element::side_rule(mesh.shape, edge.side, 4);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const axisym::Image at = axisym::image(mesh, edge.cell, rule.points[q]);
      double tangent[2];
      for (int i = 0; i < 2; ++i)
        tangent[i] = at.slope[i][0] * rule.direction[0] + at.slope[i][1] * rule.direction[1];
      const double weight = rule.weights[q] * 2 * std::numbers::pi * at.point[0];
      sum.area += weight * std::hypot(tangent[0], tangent[1]);
      sum.radial += weight * tangent[1];
      sum.axial -= weight * tangent[0];
    }
  }
  return sum;
}

/// The cells, and the middle node, at each side of the mesh, by its corner nodes.
struct SideUse {
  std::set<int> middles;
  std::multiset<axisym::Part> parts;
  int forwards = 0;  ///< traversed from the lower to the higher node
};
inline std::map<std::pair<int, int>, SideUse> sides_of(const axisym::Mesh& mesh) {
  std::map<std::pair<int, int>, SideUse> uses;
  for (int k = 0; k < static_cast<int>(mesh.cells.size()); ++k) {
    for (int side = 0; side < mesh.sides(); ++side) {
      const auto [first, second, middle] = mesh.side_nodes(k, side);
      SideUse& use = uses[std::minmax(first, second)];
      use.middles.insert(middle);
      use.parts.insert(mesh.cells[k].part);
      if (first < second) ++use.forwards;
    }
  }
  return uses;
}

}  // namespace tunica::test_support
