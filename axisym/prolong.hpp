// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "axisym/assembler.hpp"

namespace tunica::axisym {

/// The state `y` on the mesh of `from`, interpolated to the nodes of another mesh of the same vessel. The
/// loads, and with them the scalars, must be of the same kind. The bubble's velocity is left out: it follows
/// from the rest.
/// Throws std::logic_error for a node that lies outside of the mesh of `from`.
std::vector<double> prolong(const Assembler& from, std::span<const double> y, const Assembler& to);

}  // namespace tunica::axisym
