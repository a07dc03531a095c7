// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "axisym/mesh.hpp"
#include "core/scene/scene.hpp"

namespace tunica::axisym {

/// Cells and steps that a scene's tolerance asks for. The numbers were found by computing the paper's
/// cylinder with each law against finer references (docs/verification/axisym.md).
struct Resolution {
  int wall_cells = 0;   ///< through the wall
  int blood_cells = 0;  ///< from the axis to the wall
  int axial_cells = 0;
  double local_tolerance = 0;  ///< of a time step
  double newton_tolerance = 0;
};

/// Cells that the scene sets itself are taken as they are.
Resolution resolution(const Scene& scene);

/// The mesh of a scene: of its cylinder at a resolution, or from its file.
/// Throws InvalidInput for a file that cannot be used.
Mesh mesh_of(const Scene& scene, const Resolution& resolution, bool with_blood);

}  // namespace tunica::axisym
