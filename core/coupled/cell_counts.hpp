// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

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
  int axial_cells = 0;         ///< along the artery, for its ends and for the waves that its inlet sends
  double local_tolerance = 0;  ///< of a time step
  double newton_tolerance = 0;
};
CellCounts cell_counts(const Scene& scene);
/// Cells that the scene sets itself are taken as they are, and a wall has as many as layers.
void take_given(const Scene& scene, CellCounts& counts);

/// Of cells along the vessel, how much longer they are at mid-length than at its ends: between clamped ends
/// as how these bend the wall asks for, and as its corners do.
double end_grading(const Scene& scene);

/// The same for cells of another kind: as many as `at_one_percent` for an error of 1 %, which falls as those
/// along the artery make it.
int cells_as_along(const Scene& scene, double at_one_percent);

/// The counts of cells in one direction that lead from few of them to those of the finest mesh.
struct CellDirection {
  int finest = 0;
  int least = 1;     ///< fewer than this the finest has at most
  int multiple = 1;  ///< of which all counts are one
};
/// By mesh, the coarsest first and without the finest, the count in each direction: in equal ratios rounded
/// up, so that no mesh has more than twice the cells of the one before in any direction.
std::vector<std::vector<int>> coarser_counts(const std::vector<CellDirection>& directions);

/// Outer over inner radius, relative to that of the paper's artery; 1 for thinner walls.
double relative_thickness(const Scene& scene);

}  // namespace tunica::coupled
