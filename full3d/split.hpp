// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

namespace tunica::full3d {

/// A tetrahedron in a hexahedron, its corners as nodes of the triquadratic lattice, 0 to 26. Half the sum of
/// two corners' lattice coordinates are those of the middle between them.
using LatticeTetrahedron = std::array<int, 4>;

/// Lattice node in the middle of two.
int middle(int a, int b);

/// Six tetrahedra that fill a hexahedron, with positive volumes. `ranks` belong to the four upright edges in
/// lexicographic order. The section is divided along the rising diagonal (0-3) or falling one (1-2) that the
/// lowest rank is on. The diagonal of an upright face leads from bottom to top towards the lower rank if
/// `inwards`, and otherwise towards the higher one, which makes the mirror image about the middle height.
/// Faces shared by cells are so divided alike. As ranks are in order, each prism of ranks a < b < c has a
/// corner, the top of a, or the bottom of a if not `inwards`, that is in all its three tetrahedra. (Dompierre
/// et al., How to subdivide pyramids, prisms and hexahedra into tetrahedra, 1999.)
std::array<LatticeTetrahedron, 6> split_hexahedron(const std::array<int, 4>& ranks, bool inwards);

}  // namespace tunica::full3d
