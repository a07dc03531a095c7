// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "axisym/mesh.hpp"
#include "core/element/grading.hpp"

namespace tunica::axisym {

using element::bending_layer_grading;
using element::steepest_grading;

/// A straight tube in rows and columns of rectangles, from z = 0 (inlet) to z = length (outlet).
struct TubeSpec {
  double radius = 0;           ///< of the lumen, cm
  std::vector<double> layers;  ///< thicknesses of the wall's layers from the lumen outwards, cm
  double length = 0;           ///< cm
  int blood_cells = 0;         ///< from the axis to the interface
  /// Through the whole wall. Cell lines fall on the boundaries of the layers, so that a wall has at least
  /// as many cells as layers; they are shared out so that the widest cell is as thin as can be.
  int wall_cells = 0;
  int axial_cells = 0;  ///< even, so that mid-length is a cell line
  /// Lengths of cells compared, each 1 (uniform) or more: at mid-length to at the ends, at the axis to at
  /// the interface, at the outer surface to at the inner one.
  double end_grading = 1;
  double interface_grading = 1;
  double wall_grading = 1;
  bool blood = true;  ///< which parts are meshed
  bool wall = true;
  CellShape shape = CellShape::quadrilateral;
};

/// Cell lines: element::lines_along, shrinking_lines in blood and wall_lines. Nodes between corners lie
/// midway. Triangles are made by halving each rectangle, diagonals alternating so that the mesh is its own
/// mirror image about mid-length and that no triangle has two sides on inlet and interface.
/// Throws InvalidInput for sizes that are not positive and finite, counts below 1, an odd number of axial
/// cells, gradings outside 1 to 10^6, and more than ten million nodes.
Mesh structured_tube(const TubeSpec& spec);

}  // namespace tunica::axisym
