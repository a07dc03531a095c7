// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "axisym/gmsh_cells.hpp"

namespace tunica::axisym {

/// Fills in the mesh's edges: the axis and the interface from the cells, the other boundaries from the
/// physical curves of the file. Throws InvalidInput for missing curves, curves that run elsewhere than their
/// name says, sides without a name or a neighbour (an open interface, a hanging node), cells on top of each
/// other.
void mark_boundaries(const GmshFile& file, GmshCells& cells);

}  // namespace tunica::axisym
