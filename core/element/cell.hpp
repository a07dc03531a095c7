// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace tunica::element {

/// Reference cells of plane meshes: the square [-1,1]^2 with corners (-1,-1), (1,-1), (1,1), (-1,1), and
/// the triangle (0,0), (1,0), (0,1).
enum class CellShape { quadrilateral, triangle };

/// Lagrange bases on a cell's nodes: corners, then the middles of its sides (side i lies between corners i
/// and i+1), then its centre.
///   linear         on the corners (bilinear on squares);
///   quadratic      on all nodes: biquadratic, and on triangles quadratic enriched with the cubic bubble;
///   linear_bubble  on triangles: linear on the corners, plus the cubic bubble, which vanishes on the sides,
///                  as a coefficient of its own (Arnold, Brezzi and Fortin, Calcolo 21:337, 1984).
enum class Basis { linear, quadratic, linear_bubble };

inline constexpr int max_cell_nodes = 9;

constexpr int corners(CellShape shape) {
  return shape == CellShape::quadrilateral ? 4 : 3;
}
constexpr int shape_count(CellShape shape, Basis basis) {
  const bool square = shape == CellShape::quadrilateral;
  if (basis == Basis::linear) return corners(shape);
  if (basis == Basis::linear_bubble) return corners(shape) + 1;
  return square ? 9 : 7;
}

using Local = std::array<double, 2>;

/// Values and derivatives by the local coordinates of all shape functions at a local point.
struct Shapes {
  int count = 0;
  std::array<double, max_cell_nodes> value{};
  std::array<Local, max_cell_nodes> slope{};
};
Shapes shapes_at(CellShape shape, Basis basis, const Local& point);

/// Local coordinates of the cell's nodes in the order of the quadratic basis.
Local node_position(CellShape shape, int node);

/// Points and weights in a cell; weights add up to the cell's local area (4, or 1/2).
struct CellRule {
  std::vector<Local> points;
  std::vector<double> weights;
};
/// Squares: exact for degree 3 in each coordinate with the linear basis, 5 with the quadratic one. Triangles:
/// degree 6, that of the bubble squared.
CellRule cell_rule(CellShape shape, Basis basis);

/// Points along side number `side` of a cell, in the direction from its first to its second corner, and the
/// derivative of the local coordinates by the side's own coordinate s in [-1, 1].
struct SideRule {
  std::vector<Local> points;
  std::vector<double> weights;
  Local direction;
};
SideRule side_rule(CellShape shape, int side, int points);

/// Nodes on a side in the order of the quadratic basis: first corner, second corner, middle.
std::array<int, 3> side_nodes(CellShape shape, int side);

}  // namespace tunica::element
