// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/coupled/conditions.hpp"

namespace tunica::coupled {

/// A line on walls that elements of linear displacement on triangles or tetrahedra (`simplices`) cannot
/// follow, with whatever pressure: tissue nearer to incompressible than the paper's, in which they barely
/// move.
std::optional<std::string> locking_remark(Element element, bool simplices,
                                          const std::vector<wall::Law<double>>& laws);

}  // namespace tunica::coupled
