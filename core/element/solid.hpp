// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

/// Reference cells of meshes in space. Plane ones are in cell.hpp.
namespace tunica::element::solid {

/// The cube [-1,1]^3, and the tetrahedron with corners 0, e_x, e_y, e_z.
enum class Shape { hexahedron, tetrahedron };

/// Lagrange bases.
///   linear         on the corners (trilinear on cubes);
///   quadratic      cubes: triquadratic, on corners and middles of edges, faces and cell;
///                  tetrahedra: of degree 2, on corners and middles of edges;
///   linear_bubble  on tetrahedra: linear, plus 256 l0 l1 l2 l3, which vanishes on the faces, as a
///                  coefficient of its own (Arnold, Brezzi and Fortin, Calcolo 21:337, 1984).
///
/// Nodes of cubes are numbered by their coordinates, the first running fastest: node (i, j, k) of a basis
/// with m nodes to an edge is i + m (j + m k).
///
/// Those of tetrahedra are the corners 0, e_x, e_y, e_z, then the middles of the edges 01, 02, 03, 12, 13,
/// 23.
enum class Basis { linear, quadratic, linear_bubble };

inline constexpr int max_nodes = 27;

constexpr int shape_count(Shape shape, Basis basis) {
  if (shape == Shape::hexahedron) return basis == Basis::linear ? 8 : 27;
  return basis == Basis::linear ? 4 : basis == Basis::linear_bubble ? 5 : 10;
}

using Local = std::array<double, 3>;

/// Values and derivatives by the local coordinates of all shape functions at a local point.
struct Shapes {
  int count = 0;
  std::array<double, max_nodes> value{};
  std::array<Local, max_nodes> slope{};
};
/// Throws std::logic_error for a bubble on a cube.
Shapes shapes_at(Shape shape, Basis basis, const Local& point);

/// Local coordinates of a node of a basis; a bubble's is the cell's centre.
Local node_position(Shape shape, Basis basis, int node);

/// Points and weights in a cell; weights add up to its local volume (8, or 1/6).
struct Rule {
  std::vector<Local> points;
  std::vector<double> weights;
};
/// Cubes: exact for degree 3 in each coordinate with the linear basis, 5 with the quadratic one. Tetrahedra:
/// degree 2 with the linear basis, else 6, that of the product of two bubbles' gradients.
Rule cell_rule(Shape shape, Basis basis);

constexpr int faces(Shape shape) {
  return shape == Shape::hexahedron ? 6 : 4;
}
/// Nodes of a basis on face number `face`. Cubes: faces -x, +x, -y, +y, -z, +z, nodes in the order of their
/// numbers. Tetrahedra: the face opposite to corner `face`.
std::vector<int> face_nodes(Shape shape, Basis basis, int face);

/// Points on a face, and the derivatives of the local coordinates by the face's two own ones; their cross
/// product points out of the cell. Weights add up to the area of the face's own coordinates: 4 (cubes), 1/2.
struct FaceRule {
  std::vector<Local> points;
  std::vector<double> weights;
  std::array<Local, 2> directions{};
};
/// Cubes: as cell_rule in each coordinate. Tetrahedra: degree 6.
FaceRule face_rule(Shape shape, Basis basis, int face);

}  // namespace tunica::element::solid
