// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "full3d/gmsh_cells.hpp"

namespace tunica::full3d {

/// Fills in the mesh's faces: the interface from the cells, the other boundaries from the physical surfaces
/// of the file. Throws InvalidInput for missing surfaces, surfaces that lie elsewhere than their name says,
/// faces without a name or a neighbour (an open interface, cells that do not fit together), cells on top of
/// each other, layers that do not follow each other, and boundaries of several pieces.
void mark_boundaries(const element::GmshFile& file, GmshCells& cells);

}  // namespace tunica::full3d
