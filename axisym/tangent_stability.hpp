// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "axisym/assembler.hpp"
#include "core/coupled/tangent_stability.hpp"

namespace tunica::axisym {

using coupled::TangentStability;

/// At a complete static state `y`. Throws std::logic_error for a problem with blood, SolverFailure when a
/// pivot vanishes.
TangentStability tangent_stability(const Assembler& assembler, double time, std::span<const double> y);

}  // namespace tunica::axisym
