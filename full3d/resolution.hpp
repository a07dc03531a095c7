// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/coupled/cell_counts.hpp"
#include "full3d/o_grid.hpp"
#include "full3d/share.hpp"

namespace tunica::full3d {

/// Cells and steps that a scene's tolerance asks for: those of the half plane, blood cells being from the
/// core of the lumen's O-grid to the wall, and `around_cells` around the whole circumference.
struct Resolution : coupled::CellCounts {
  int around_cells = 0;
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
