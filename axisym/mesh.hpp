// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/coupled/vessel.hpp"
#include "core/element/cell.hpp"

namespace tunica::axisym {

using coupled::Boundary;
using coupled::Part;
using element::CellShape;  // one shape in a mesh

/// Corners counter-clockwise with r to the right and z up, then the nodes in the middle of side i, which
/// goes from corner i to corner i + 1, then the centre. A triangle has 7 nodes, its centre being the image
/// of the barycentre under the quadratic map of the other six; its last two entries are -1.
struct Cell {
  std::array<int, 9> nodes;
  Part part;
  int layer;  ///< of the wall, from the lumen outwards; 0 in blood
};

/// A side of a cell that lies on a boundary.
struct Edge {
  int cell;
  int side;
  Boundary boundary;
};

/// The (r, z) half plane of a vessel in quadratic cells that share their nodes. The inlet lies below the
/// outlet. A node lies on the axis when its r is exactly 0.
struct Mesh {
  CellShape shape = CellShape::quadrilateral;
  std::vector<std::array<double, 2>> points;  ///< (r, z) of every node, cm
  std::vector<Cell> cells;
  /// Each side on the boundary once, and each side on the interface from its blood cell and from its wall
  /// cell. With one part alone the interface is that part's own surface: the inner one of a wall, the
  /// lateral one of a rigid pipe.
  std::vector<Edge> edges;

  int corners() const { return element::corners(shape); }
  int sides() const { return corners(); }
  int nodes_per_cell() const { return 2 * corners() + 1; }
  int centre_node() const { return 2 * corners(); }  ///< its place in Cell::nodes
  /// The nodes of a side: first corner, second corner, middle.
  std::array<int, 3> side_nodes(int cell, int side) const;
  bool has(Part part) const;
  int layers() const;  ///< of the wall, 0 without one
};

/// The image of a point of a reference cell under the cell's quadratic map.
struct Image {
  element::Local point{};                 ///< (r, z), cm
  std::array<element::Local, 2> slope{};  ///< slope[i][c] = d point_i/d local_c
  double determinant() const { return slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0]; }
};
Image image(const Mesh& mesh, int cell, const element::Local& local);

/// Where the vessel begins and ends (cm): heights of the inlet and the outlet, or of the middle of the end
/// faces of a wall alone.
struct Extent {
  double inlet, outlet;
  double length() const { return outlet - inlet; }
};
Extent extent(const Mesh& mesh);

/// Radius of the lumen at the inlet, cm: the inner one of the wall's end face in a wall alone.
double inlet_radius(const Mesh& mesh);

/// Sides with what lies across: entry `cell * sides() + side` is the cell on the other side, or -1.
/// Throws std::logic_error if more than two cells share a side.
std::vector<int> neighbours(const Mesh& mesh);

}  // namespace tunica::axisym
