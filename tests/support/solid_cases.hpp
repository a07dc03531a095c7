// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <ostream>
#include <string>

#include "full3d/o_grid.hpp"
#include "full3d/problem.hpp"
#include "full3d/vessel_shape.hpp"

namespace tunica::test_support {

/// The discretisations in space.
struct SolidCase {
  const char* name;
  full3d::Shape shape;
  full3d::Element element;
};
inline constexpr std::array<SolidCase, 5> solid_cases{
    {{"quadratic_hexahedron", full3d::Shape::hexahedron, full3d::Element::quadratic},
     {"quadratic_tetrahedron", full3d::Shape::tetrahedron, full3d::Element::quadratic},
     {"linear_hexahedron", full3d::Shape::hexahedron, full3d::Element::linear},
     {"linear_tetrahedron", full3d::Shape::tetrahedron, full3d::Element::linear},
     {"bubble_tetrahedron", full3d::Shape::tetrahedron, full3d::Element::bubble}}};
inline std::ostream& operator<<(std::ostream& out, const SolidCase& c) {
  return out << c.name;
}

/// A vessel of R = 1, wall 0.5, L = 2 cm with as few cells as there are: 8 around, one ring, one through the
/// wall, two along.
inline full3d::VesselSpec coarse_vessel(const SolidCase& c, full3d::Sector sector, double bend_angle = 0) {
  full3d::VesselSpec spec;
  spec.radius = 1;
  spec.layers = {0.5};
  spec.length = 2;
  spec.bend_angle = bend_angle;
  spec.around_cells = 8;
  spec.ring_cells = spec.wall_cells = 1;
  spec.axial_cells = 2;
  spec.sector = sector;
  spec.shape = c.shape;
  spec.quadratic = c.element == full3d::Element::quadratic;
  return spec;
}

inline double copies(full3d::Sector sector) {
  return sector == full3d::Sector::quarter ? 4 : sector == full3d::Sector::half ? 2 : 1;
}

/// Circumference and axis of the wall of a vessel with one layer.
inline full3d::WallDirections directions_of(const full3d::VesselSpec& spec) {
  const full3d::VesselShape shape{spec.radius, spec.layers[0], spec.length, spec.bend_angle};
  return [shape](int, const element::solid::Local&, const full3d::Point& place) { return shape.axes(place); };
}

}  // namespace tunica::test_support
