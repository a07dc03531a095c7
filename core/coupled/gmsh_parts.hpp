// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "core/coupled/vessel.hpp"
#include "core/element/gmsh_file.hpp"
#include "core/scene/scene.hpp"

/// What the names of physical groups in a Gmsh file mean to all tiers that read one. The cells of a mesh are
/// in groups of its dimension: "blood" and "wall", or "wall:1", "wall:2", ... for layers from the lumen
/// outwards. What bounds them is in groups of one dimension less, named as the boundaries are.
namespace tunica::coupled {

struct Membership {
  Part part;
  int layer;  ///< from 0; of a wall that is not divided -1, until check_parts makes it 0
};

/// Throws InvalidInput for a file in which no cell is in a part with a name, and says what it has instead.
void check_named(const element::GmshFile& file, int dimension);

/// Part and layer of a cell that messages call `cell`. Throws InvalidInput for cells in no named group, in
/// several, or in one of another name.
Membership membership_of(const element::GmshFile& file, const element::GmshFile::Element& element,
                         const std::string& cell);

/// Throws InvalidInput for a wall of which some cells are in layers and others not, for a layer without
/// cells, and for a part that the file names and has no cells of.
void check_parts(const element::GmshFile& file, int dimension, std::span<Membership> cells);

/// The boundary that an element between cells is named after, if any. Throws InvalidInput for two.
std::optional<Boundary> boundary_of(const element::GmshFile& file, const element::GmshFile::Element& element);

/// Throws InvalidInput when a boundary that the parts have to have is named nowhere.
void check_boundaries_named(const element::GmshFile& file, int dimension, bool blood, bool wall);

/// What to change in a mesh whose layers do not lie one around the other.
inline constexpr const char* layers_remedy =
    "each layer lies all around the one before, numbered wall:1, wall:2, ... from the lumen outwards (what "
    "fills only a part of a layer, as a plaque, is not computed: give it the layer's name)";

/// Throws InvalidInput for a mesh of another number of layers than the scene's.
void check_layers(int of_mesh, std::size_t of_scene);
/// Throws InvalidInput for an end of a mesh that is too uneven to slide: each node slides in a plane of its
/// own, and what holds it pushes askew to the faces, which shears the wall by the inclination's (rad) share
/// of its stress.
void check_sliding(Boundary boundary, double inclination, double tolerance);
/// Throws InvalidInput for a mesh of a wall alone under anything but a pressure.
void require_pressure(bool is_pressure);

/// What the scene says of a mesh that it names.
struct Expected {
  double radius;      ///< geometry.radius, cm
  std::string label;  ///< names the mesh in messages
};

/// Refuses (InvalidInput) a mesh in another unit of length: its radius at the inlet is more than 50 times
/// geometry.radius or less than a 50th of it, or 10 times it (mm for cm) but for a factor of 1.25.
void check_unit(double inlet_radius, const Expected& expected);

/// A line about a mesh that passes check_unit and whose radius at the inlet is more than twice
/// geometry.radius or less than half of it; none otherwise.
std::optional<std::string> radius_remark(double inlet_radius, const Scene& scene);

}  // namespace tunica::coupled
