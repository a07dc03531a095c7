// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace tunica::coupled {

enum class Part { blood, wall };
/// wall_inlet and wall_outlet are the end faces of the wall. A half plane has an axis; a vessel in space
/// that is cut along planes x = 0 or y = 0, the rest being its mirror image, has symmetry_x or symmetry_y.
enum class Boundary {
  axis,
  inlet,
  outlet,
  interface,
  outer,
  wall_inlet,
  wall_outlet,
  symmetry_x,
  symmetry_y
};
inline constexpr int boundaries = 9;

/// The names that mesh files and messages use: "blood", "wall_inlet", ...
std::string_view name(Part part);
std::string_view name(Boundary boundary);

}  // namespace tunica::coupled
