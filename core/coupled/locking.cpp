// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/locking.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tunica::coupled {

std::optional<std::string> locking_remark(Element element, bool simplices,
                                          const std::vector<wall::Law<double>>& laws) {
  // 515 in the paper's stiffest law.
  constexpr double stiffest = 600;
  if (element == Element::quadratic || !simplices || laws.empty()) return {};
  double ratio = 0;
  for (const auto& law : laws) ratio = std::max(ratio, wall::volumetric_ratio(law));
  if (ratio <= stiffest) return {};
  return fmt::format(
      "the wall is {:.2g} times as stiff against changes of volume as of shape, and linear triangles and "
      "tetrahedra lock in "
      "such tissue, so that it moves too little; write mesh.element = \"quadratic\"",
      ratio);
}

}  // namespace tunica::coupled
