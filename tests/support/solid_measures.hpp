// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "full3d/mesh.hpp"

namespace tunica::test_support {

using full3d::Point;

inline element::solid::Basis basis_of(const full3d::Mesh& mesh) {
  return mesh.quadratic ? element::solid::Basis::quadratic : element::solid::Basis::linear;
}

/// Integral of a function over the cells that `counts` names, by the elements' own rule.
inline double integral(
    const full3d::Mesh& mesh, const std::function<bool(const full3d::Cell&)>& counts,
    const std::function<double(const Point&)>& f = [](const Point&) { return 1.0; }) {
  const auto rule = element::solid::cell_rule(mesh.shape, basis_of(mesh));
  double sum = 0;
  for (int k = 0; k < static_cast<int>(mesh.cells.size()); ++k) {
    if (!counts(mesh.cells[k])) continue;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const auto at = image(mesh, k, rule.points[q]);
      sum += rule.weights[q] * at.determinant() * f(at.point);
    }
  }
  return sum;
}

inline double volume(const full3d::Mesh& mesh, full3d::Part part) {
  return integral(mesh, [part](const full3d::Cell& cell) { return cell.part == part; });
}

/// Area of a face, and its normal out of the cell times area.
struct Surface {
  double area = 0;
  Point normal{};
  void add(const Surface& other) {
    area += other.area;
    for (int i = 0; i < 3; ++i) normal[i] += other.normal[i];
  }
};
inline Surface surface(const full3d::Mesh& mesh, int cell, int face) {
  const auto rule = element::solid::face_rule(mesh.shape, basis_of(mesh), face);
  Surface sum;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const auto at = image(mesh, cell, rule.points[q]);
    std::array<Point, 2> t{};
    for (int d = 0; d < 2; ++d)
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) t[d][i] += at.slope[i][c] * rule.directions[d][c];
    const Point n{t[0][1] * t[1][2] - t[0][2] * t[1][1], t[0][2] * t[1][0] - t[0][0] * t[1][2],
                  t[0][0] * t[1][1] - t[0][1] * t[1][0]};
    sum.add({rule.weights[q] * std::hypot(n[0], n[1], n[2]),
             {rule.weights[q] * n[0], rule.weights[q] * n[1], rule.weights[q] * n[2]}});
  }
  return sum;
}
inline Surface surface(const full3d::Mesh& mesh, full3d::Boundary boundary, full3d::Part part) {
  Surface sum;
  for (const auto& face : mesh.faces)
    if (face.boundary == boundary && mesh.cells[face.cell].part == part)
      sum.add(surface(mesh, face.cell, face.face));
  return sum;
}

/// Nodes of the mesh on a face, sorted.
inline std::vector<int> nodes_on(const full3d::Mesh& mesh, int cell, int face) {
  std::vector<int> nodes;
  for (const int k : element::solid::face_nodes(mesh.shape, basis_of(mesh), face))
    nodes.push_back(mesh.node(cell, basis_of(mesh), k));
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// The cells, with the number of their face, at each face of a mesh by its nodes.
struct CellFace {
  int cell, face;
};
inline std::map<std::vector<int>, std::vector<CellFace>> faces_of(const full3d::Mesh& mesh) {
  std::map<std::vector<int>, std::vector<CellFace>> faces;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    for (int face = 0; face < element::solid::faces(mesh.shape); ++face)
      faces[nodes_on(mesh, cell, face)].push_back({cell, face});
  return faces;
}

}  // namespace tunica::test_support
