// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "axisym/mesh.hpp"

namespace tunica::axisym {

/// Ratio of the longest to the shortest cell in one direction that numbers still resolve.
inline constexpr double steepest_grading = 1e6;

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

/// Axial cell lines: z = L/2 (1 + tanh(d x)/tanh d) at equidistant x in [-1, 1], with cosh^2 d the end
/// grading (Vinokur, J. Comput. Phys. 50:215, 1983). Radial cell lines: lengths of cells in geometric
/// progression. Nodes between corners lie midway. Triangles are made by halving each rectangle,
/// diagonals alternating so that the mesh is its own mirror image about mid-length and that no triangle
/// has two sides on inlet and interface.
/// Throws InvalidInput for sizes that are not positive and finite, counts below 1, an odd number of axial
/// cells, gradings outside 1 to 10^6, and more than ten million nodes.
Mesh structured_tube(const TubeSpec& spec);

/// End grading that gives half of the axial cells to the two boundary layers in which a clamped shell bends:
/// each of width 3 sqrt(R h), after which exp(-1.22 z/sqrt(R h)) has fallen to 3 %. 1 for a tube so short
/// that they cover half of it.
double bending_layer_grading(double radius, double thickness, double length);

}  // namespace tunica::axisym
