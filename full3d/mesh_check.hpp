// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "full3d/mesh.hpp"

namespace tunica::full3d {

/// How a cell's map distorts the reference cell, at the worst of its corners and the points of
/// element::solid::cell_rule.
struct Distortion {
  /// Determinant of the map's derivative, cm^3.
  double least_determinant;
  /// Determinant of the derivative with columns of length 1: 1 where edges are at right angles (of the
  /// tetrahedron with corners 0, e_x, e_y, e_z too), 0 or less in cells turned inside out.
  double least_scaled;
};

/// Evaluates many cells of one mesh.
class DistortionMeter {
 public:
  explicit DistortionMeter(const Mesh& mesh);
  Distortion of(int cell) const;

 private:
  const Mesh& mesh_;
  std::vector<int> places_;  ///< in Cell::nodes of the map's shape functions
  std::vector<element::solid::Shapes> shapes_;
};

/// Throws InvalidInput that names the first cell with a determinant that is not positive.
void check_cells(const Mesh& mesh);

}  // namespace tunica::full3d
