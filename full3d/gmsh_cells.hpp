// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/element/gmsh_file.hpp"
#include "full3d/mesh.hpp"

namespace tunica::full3d {

/// The cells of a Gmsh file.
struct GmshCells {
  Mesh mesh;                  ///< quadratic, without faces
  std::vector<long> tags;     ///< of the cells, in the file
  std::vector<int> point_of;  ///< the mesh's point of each node of the file, -1 where none
  std::string label;          ///< names the file in messages

  /// "hexahedron 12 at (x, y, z) = ...".
  std::string cell_name(int cell) const;
};

/// "(x, y, z) = (...) cm".
std::string where(const Point& point);

/// Makes quadratic cells of the tetrahedra or hexahedra: parts and layers by name, left-handed ones turned
/// round; given nodes between corners curve the cells, missing ones are interpolated. Cells and nodes are
/// numbered from the inlet on. Throws InvalidInput for unnamed, unknown and mixed parts, mixed shapes,
/// degenerate cells, nodes that coincide and nodes that are the middle of one edge or face and something
/// else elsewhere.
GmshCells gmsh_cells(const element::GmshFile& file);

/// Place in Cell::nodes of each node of a Gmsh element of so many nodes.
std::vector<int> places_of_gmsh_nodes(Shape shape, int count);

}  // namespace tunica::full3d
