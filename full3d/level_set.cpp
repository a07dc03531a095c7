// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/level_set.hpp"

#include "core/tensor.hpp"
#include "full3d/split.hpp"

namespace tunica::full3d {

using element::solid::Local;

namespace {

struct Corner {
  Local local;
  double value;
};

/// Adds the triangles of one tetrahedron: a corner is cut off, or two are from the other two.
void cut(int cell, const std::array<Corner, 4>& corners, double level, std::vector<Triangle>& triangles) {
  std::vector<const Corner*> below, above;
  for (const Corner& corner : corners) (corner.value < level ? below : above).push_back(&corner);
  const auto between = [&](const Corner& a, const Corner& b) {
    const double share = (level - a.value) / (b.value - a.value);
    Local local;
    for (int i = 0; i < 3; ++i) local[i] = a.local[i] + share * (b.local[i] - a.local[i]);
    return local;
  };
  std::vector<Local> polygon;
  if (below.size() == 2) {
    polygon = {between(*below[0], *above[0]), between(*below[0], *above[1]), between(*below[1], *above[1]),
               between(*below[1], *above[0])};
  } else {
    for (const Corner* a : below)
      for (const Corner* b : above) polygon.push_back(between(*a, *b));
  }
  if (polygon.empty()) return;
  Local rise{};
  for (int i = 0; i < 3; ++i) {
    for (const Corner* each : below) rise[i] -= each->local[i] / static_cast<double>(below.size());
    for (const Corner* each : above) rise[i] += each->local[i] / static_cast<double>(above.size());
  }
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    Local a, b;
    for (int i = 0; i < 3; ++i) {
      a[i] = polygon[k - 1][i] - polygon[0][i];
      b[i] = polygon[k][i] - polygon[0][i];
    }
    if (dot(cross(a, b), rise) > 0)
      triangles.push_back({cell, {polygon[0], polygon[k - 1], polygon[k]}});
    else
      triangles.push_back({cell, {polygon[0], polygon[k], polygon[k - 1]}});
  }
}

}  // namespace

std::vector<Triangle> level_set(const Mesh& mesh, Part part, std::span<const double> values, double level) {
  // Which diagonals divide the faces of a cube does not matter.
  const auto split = split_hexahedron({0, 1, 2, 3}, true);
  std::vector<Triangle> triangles;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    const Cell& own = mesh.cells[cell];
    if (own.part != part) continue;
    int below = 0;
    const int count = element::solid::shape_count(mesh.shape, element::solid::Basis::linear);
    for (int k = 0; k < count; ++k)
      below += values[mesh.node(cell, element::solid::Basis::linear, k)] < level ? 1 : 0;
    if (below == 0 || below == count) continue;
    std::array<Corner, 4> corners;
    if (mesh.shape == Shape::tetrahedron) {
      for (int k = 0; k < 4; ++k)
        corners[k] = {element::solid::node_position(mesh.shape, element::solid::Basis::linear, k),
                      values[own.nodes[k]]};
      cut(cell, corners, level, triangles);
      continue;
    }
    for (const LatticeTetrahedron& tetrahedron : split) {
      for (int k = 0; k < 4; ++k) {
        const int node = tetrahedron[k];
        corners[k] = {{node % 3 - 1.0, node / 3 % 3 - 1.0, node / 9 - 1.0}, values[own.nodes[node]]};
      }
      cut(cell, corners, level, triangles);
    }
  }
  return triangles;
}

}  // namespace tunica::full3d
