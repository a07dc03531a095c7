// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.hpp"

namespace tunica::coupled {

/// How much smaller than the bending layers need cells are at the ends, and cells at the interface than far
/// from it. Strain and pressure are singular where the lumen ends at clamped faces (as the distance to the
/// power -0.4 for the wall, -0.5 for the blood), and the loss of pressure in the narrow ends depends on what
/// becomes of them: cells shrink towards there by the same factor along both directions.
inline constexpr double corner_grading = 16, interface_grading = 60;

/// Cells and errors that a scene's tolerance asks for in both tiers with meshes, found by computing the
/// paper's cylinder with each law against finer references (docs/verification/axisym.md).
struct CellCounts {
  int wall_cells = 0;          ///< through the wall
  int blood_cells = 0;         ///< to the wall
  int axial_cells = 0;         ///< along the artery
  double local_tolerance = 0;  ///< of a time step
  double newton_tolerance = 0;
};
CellCounts cell_counts(const Scene& scene);
/// Cells that the scene sets itself are taken as they are, and a wall has as many as layers.
void take_given(const Scene& scene, CellCounts& counts);

/// The same for cells of another kind: as many as `at_one_percent` for an error of 1 %, which falls as those
/// along the artery make it.
int cells_as_along(const Scene& scene, double at_one_percent);

/// Outer over inner radius, relative to that of the paper's artery; 1 for thinner walls.
double relative_thickness(const Scene& scene);

}  // namespace tunica::coupled
