// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/mesh.hpp"

#include <algorithm>

namespace tunica::full3d {

using element::solid::Basis;

bool Mesh::has(Part part) const {
  return std::any_of(cells.begin(), cells.end(), [&](const Cell& cell) { return cell.part == part; });
}

int Mesh::layers() const {
  int count = 0;
  for (const Cell& cell : cells)
    if (cell.part == Part::wall) count = std::max(count, cell.layer + 1);
  return count;
}

int node_place(Shape shape, Basis basis, int k) {
  if (shape == Shape::tetrahedron) return basis == Basis::linear_bubble && k == 4 ? 10 : k;
  if (basis == Basis::quadratic) return k;
  // Corner (i, j, k) of a cube is node (2i, 2j, 2k) of the triquadratic basis.
  return 2 * (k % 2) + 6 * (k / 2 % 2) + 18 * (k / 4);
}

int Mesh::node(int cell, Basis basis, int k) const {
  return cells[cell].nodes[node_place(shape, basis, k)];
}

double Image::determinant() const {
  const auto& s = slope;
  return s[0][0] * (s[1][1] * s[2][2] - s[1][2] * s[2][1]) -
         s[0][1] * (s[1][0] * s[2][2] - s[1][2] * s[2][0]) +
         s[0][2] * (s[1][0] * s[2][1] - s[1][1] * s[2][0]);
}

Image image(const Mesh& mesh, int cell, const element::solid::Local& local) {
  const Basis basis = mesh.quadratic ? Basis::quadratic : Basis::linear;
  const auto shapes = element::solid::shapes_at(mesh.shape, basis, local);
  Image image;
  for (int k = 0; k < shapes.count; ++k) {
    const Point& x = mesh.points[mesh.node(cell, basis, k)];
    for (int i = 0; i < 3; ++i) {
      image.point[i] += shapes.value[k] * x[i];
      for (int c = 0; c < 3; ++c) image.slope[i][c] += shapes.slope[k][c] * x[i];
    }
  }
  return image;
}

}  // namespace tunica::full3d
