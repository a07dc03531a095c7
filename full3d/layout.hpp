// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/coupled/layout.hpp"
#include "full3d/problem.hpp"

namespace tunica::full3d {

using coupled::Layout;
using element::solid::Basis;

/// Bases of the fields: displacement (and geometry), velocity.
Basis displacement_basis(Element element);
Basis velocity_basis(Element element);

/// The layout of a problem's state. Nodes are numbered as in the mesh.
Layout layout_of(const Problem& problem);

/// Rows of the linear systems: unknowns but for those of bubbles, which are condensed.
int rows_of(const Problem& problem, const Layout& layout);

}  // namespace tunica::full3d
