// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.hpp"
#include "full3d/mesh.hpp"

namespace tunica::full3d {

/// Volume of a part, cm3.
double volume(const Mesh& mesh, Part part);

/// Area of a boundary (cm2), its centre, and the unit normal of its mean out of the mesh. An interface is
/// seen from the wall.
struct Surface {
  double area = 0;
  double projected = 0;  ///< along the normal, cm2
  Point centre{};
  Vector<double> normal{};
};
Surface surface(const Mesh& mesh, Boundary boundary);

/// Inclination of the faces of a boundary to its mean plane, rad: the root of 2 (area/projected - 1), the
/// root mean square where it is small.
double inclination(const Surface& surface);

/// The straight round tube whose wall has the volume V and the surfaces A_i and A_o of a mesh's:
/// h = 2V/(A_i + A_o), R = h A_i/(A_o - A_i), L = A_i/(2 pi R). Throws InvalidInput for a wall that is larger
/// inside than outside.
struct MeanTube {
  double radius, thickness, length;  ///< cm
};
MeanTube mean_tube(const Mesh& mesh);

/// Of the circle of the inlet's area or, without blood, of the mean tube, cm.
double inlet_radius(const Mesh& mesh);

}  // namespace tunica::full3d
