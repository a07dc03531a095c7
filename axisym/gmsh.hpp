// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "axisym/mesh.hpp"
#include "core/coupled/gmsh_parts.hpp"

namespace tunica::axisym {

/// Reads the half plane of a vessel, x = r >= 0 and y = z in cm, from a Gmsh file (ASCII, format 2.2 or 4.1):
/// triangles of 3 or 6 nodes or quadrilaterals of 4, 8 or 9; given nodes curve the cells, missing ones are
/// interpolated. Physical surfaces: "blood" and "wall", or "wall:1", "wall:2", ... for layers from the lumen
/// outwards; one of blood and wall suffices. Physical curves: "inlet" and "outlet" (planes z = const, the
/// inlet below) of the blood, "outer", "wall_inlet" and "wall_outlet" of the wall. Axis and interface are
/// found without a name; named "axis" and "interface" they are checked. Clockwise cells are turned round.
/// Throws InvalidInput, one line with file, what is wrong, where, and the remedy, for everything else.
Mesh read_gmsh(const std::filesystem::path& file);

/// The same from text; `label` names it in messages.
Mesh parse_gmsh(std::string_view text, const std::string& label);

/// Refuses (InvalidInput) a mesh in another unit of length, by its radius at the inlet.
void check(const Mesh& mesh, const coupled::Expected& expected);

}  // namespace tunica::axisym
