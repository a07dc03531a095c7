// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.hpp"
#include "full3d/o_grid.hpp"
#include "full3d/share.hpp"

namespace tunica::full3d {

/// Cells and steps that a scene's tolerance asks for. The numbers were found by computing the paper's
/// cylinder and torus against finer meshes (docs/verification/full3d.md).
struct Resolution {
  int wall_cells = 0;          ///< through the wall
  int blood_cells = 0;         ///< from the core of the lumen's O-grid to the wall
  int axial_cells = 0;         ///< along the artery
  int around_cells = 0;        ///< around the whole circumference
  double local_tolerance = 0;  ///< of a time step
  double newton_tolerance = 0;
};

/// Cells that the scene sets itself are taken as they are.
Resolution resolution(const Scene& scene);

/// How much of the vessel is meshed: what mesh.symmetry asks for or, for "auto", the least part that the
/// vessel and its fibres make its mirror images of. Throws InvalidInput for a symmetry that there is not.
Sector sector_of(const Scene& scene);

/// The vessel's mesh at a resolution.
VesselSpec vessel_spec(const Scene& scene, const Resolution& resolution, bool with_blood);

SolverChoice solver_of(const Scene& scene);

}  // namespace tunica::full3d
