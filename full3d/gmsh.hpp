// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "full3d/problem.hpp"

namespace tunica::full3d {

/// Reads a vessel in space, in cm, from a Gmsh file (ASCII, format 2.2 or 4.1): tetrahedra of 4 or 10 nodes
/// or hexahedra of 8, 20 or 27; given nodes curve the cells, missing ones are interpolated. Physical volumes:
/// "wall", or "wall:1", "wall:2", ... for layers from the lumen outwards, and "blood". Physical surfaces:
/// "inlet" and "outlet" of the blood, "outer", "wall_inlet" and "wall_outlet" of the wall, "interface" of a
/// wall alone. Throws InvalidInput, one line with file, what is wrong, where, and the remedy, for everything
/// else.
Mesh read_gmsh(const std::filesystem::path& file);

/// The same from text; `label` names it in messages.
Mesh parse_gmsh(std::string_view text, const std::string& label);

/// The mesh as the element needs it, without its blood if that is not wanted: linear cells keep their corners
/// and, for a bubble, their centre.
Mesh adapted(const Mesh& mesh, Element element, bool with_blood);

}  // namespace tunica::full3d
