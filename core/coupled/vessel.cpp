// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/vessel.hpp"

#include <array>
#include <cstddef>

namespace tunica::coupled {

std::string_view name(Part part) {
  return part == Part::blood ? "blood" : "wall";
}

std::string_view name(Boundary boundary) {
  constexpr std::array<std::string_view, boundaries> names = {"axis",        "inlet",      "outlet",
                                                              "interface",   "outer",      "wall_inlet",
                                                              "wall_outlet", "symmetry_x", "symmetry_y"};
  return names[static_cast<std::size_t>(boundary)];
}

}  // namespace tunica::coupled
