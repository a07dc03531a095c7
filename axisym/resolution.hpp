// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "axisym/mesh.hpp"
#include "core/coupled/cell_counts.hpp"

namespace tunica::axisym {

/// Cells and steps that a scene's tolerance asks for; blood cells from the axis to the wall.
using Resolution = coupled::CellCounts;

/// Cells that the scene sets itself are taken as they are.
Resolution resolution(const Scene& scene);

/// The mesh of a scene is Tunica's own, and its nodes lie in sections across the vessel.
bool has_sections(const Scene& scene);

/// The mesh of a scene: of its cylinder at a resolution, or from its file.
/// Throws InvalidInput for a file that cannot be used.
Mesh mesh_of(const Scene& scene, const Resolution& resolution, bool with_blood);

}  // namespace tunica::axisym
