// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace tunica::full3d {

/// Memory that a run takes at its greatest, bytes, by solver.method and the number of unknowns; from runs of
/// the paper's cylinder (docs/verification/full3d-solvers.md).
double estimated_memory(const std::string& method, int unknowns);

/// Throws InvalidInput when the estimate for a method is more than what is available.
void check_memory(const std::string& method, int unknowns, std::optional<double> available);

}  // namespace tunica::full3d
