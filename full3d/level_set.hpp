// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "full3d/mesh.hpp"

namespace tunica::full3d {

/// A triangle within a cell, its corners in local coordinates; values rise along its right-handed normal.
struct Triangle {
  int cell;
  std::array<element::solid::Local, 3> corners;
};

/// Where values by node, linear in tetrahedra that the cells of a part are divided into, equal a level.
std::vector<Triangle> level_set(const Mesh& mesh, Part part, std::span<const double> values, double level);

}  // namespace tunica::full3d
