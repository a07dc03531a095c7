// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "axisym/mesh.hpp"
#include "core/element/gmsh_file.hpp"

namespace tunica::axisym {

using element::GmshFile;

/// The cells of a Gmsh file.
struct GmshCells {
  Mesh mesh;                  ///< without edges
  std::vector<long> tags;     ///< of the cells, in the file
  std::vector<int> point_of;  ///< the mesh's point of each node of the file, -1 where none
};

/// The same for both directions of a side.
inline std::uint64_t side_key(int first, int second) {
  return static_cast<std::uint64_t>(std::min(first, second)) << 32 |
         static_cast<std::uint64_t>(std::max(first, second));
}

/// Makes cells of the triangles or quadrilaterals: parts and layers by name, corners counter-clockwise, all
/// nodes there, r = 0 where it is but for rounding. Throws InvalidInput for unnamed, unknown and mixed parts,
/// mixed shapes, points out of the plane or left of the axis, degenerate cells, nodes that coincide and
/// nodes that are the middle of one side and something else elsewhere.
GmshCells gmsh_cells(const GmshFile& file);

}  // namespace tunica::axisym
