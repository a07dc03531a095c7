// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "full3d/problem.hpp"
#include "full3d/ranks.hpp"

namespace tunica::full3d {

/// Rank that each cell belongs to, the same on all ranks: by PTScotch, cells that share a face attracting
/// each other, so that the cost of cells (relative_cost) is balanced, wall and blood together.
std::vector<int> partition(const Problem& problem, const Ranks& ranks);

}  // namespace tunica::full3d
