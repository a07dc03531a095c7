// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "full3d/layout.hpp"
#include "full3d/vessel_shape.hpp"

namespace tunica::full3d {

/// The state `y` of a problem, interpolated to the nodes of another mesh of the same vessel. The loads, and
/// with them the scalars, must be of the same kind. The bubble's velocity is left out: it follows from the
/// rest. Nodes of curved boundaries may lie beside the other mesh by what its cells leave out; they take the
/// value of the nearest place along the radius of the vessel's section.
/// Throws std::logic_error for a node that lies farther outside.
std::vector<double> prolong(const VesselShape& shape, const Problem& from, const Layout& from_layout,
                            std::span<const double> y, const Problem& to, const Layout& to_layout);

}  // namespace tunica::full3d
