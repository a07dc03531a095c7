// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <string>

#include "axisym/mesh.hpp"

namespace tunica::axisym {

/// "(r, z) = (0.033, 0.1) cm", for messages.
std::string where(const std::array<double, 2>& point);

/// "triangle 12": by the file's tags, or counted from 0 without them.
std::string cell_name(const Mesh& mesh, int cell, std::span<const long> tags = {});

/// The checks below refuse a mesh (InvalidInput: label, what is wrong, where, remedy) that no computation
/// could use; `tags` are those of the cells in the mesh's file.

/// The determinant of every cell's map is positive at its quadrature points and not negative at its nodes.
void check_cells(const Mesh& mesh, const std::string& label, std::span<const long> tags = {});

/// Each part is bounded by one closed line, which passes its boundaries once each in their order about the
/// part.
void check_outline(const Mesh& mesh, const std::string& label);

/// A boundary is a plane z = const.
void check_plane(const Mesh& mesh, Boundary boundary, const std::string& label);

/// Root mean square inclination (rad, where it is small) of a boundary to planes z = const.
double inclination(const Mesh& mesh, Boundary boundary);

/// Layers follow each other from the interface to the outer surface.
void check_layers(const Mesh& mesh, const std::string& label, std::span<const long> tags = {});

}  // namespace tunica::axisym
