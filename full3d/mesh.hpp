// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/coupled/vessel.hpp"
#include "core/element/solid.hpp"

namespace tunica::full3d {

using element::solid::Shape;  // one shape in a mesh
using Point = std::array<double, 3>;

using coupled::Boundary;
using coupled::Part;

/// Nodes in the order of the quadratic basis of element::solid: 27 of a cube, 10 of a tetrahedron, whose
/// node 10 is its centre, for the bubble. Entries beyond, and middles that a mesh of linear cells has not,
/// are -1.
struct Cell {
  std::array<int, 27> nodes;
  Part part;
  int layer;  ///< of the wall, from the lumen outwards; 0 in blood
};

/// A face of a cell that lies on a boundary.
struct Face {
  int cell;
  int face;
  Boundary boundary;
};

/// A vessel in cells that share their nodes.
struct Mesh {
  Shape shape = Shape::hexahedron;
  /// Cells have the nodes of quadratic bases; otherwise their corners alone (and the centre, for a bubble).
  bool quadratic = true;
  std::vector<Point> points;  ///< cm
  std::vector<Cell> cells;
  /// Each face on the boundary once, and each face on the interface from its blood cell and from its wall
  /// cell. With one part alone the interface is that part's own surface: the inner one of a wall, the
  /// lateral one of a rigid pipe.
  std::vector<Face> faces;

  bool has(Part part) const;
  int layers() const;  ///< of the wall, 0 without one
  /// Node of the mesh that shape function k of a basis belongs to in a cell.
  int node(int cell, element::solid::Basis basis, int k) const;
};

/// Place of shape function k of a basis in Cell::nodes.
int node_place(Shape shape, element::solid::Basis basis, int k);

/// The image of a point of a reference cell under the cell's map, which is quadratic in quadratic meshes and
/// else linear.
struct Image {
  Point point{};
  std::array<Point, 3> slope{};  ///< slope[i][c] = d point_i/d local_c
  double determinant() const;
};
Image image(const Mesh& mesh, int cell, const element::solid::Local& local);

}  // namespace tunica::full3d
