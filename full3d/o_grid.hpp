// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "full3d/section.hpp"

namespace tunica::full3d {

/// A vessel of circular cross-section, straight or bent to a part of a torus.
struct VesselSpec {
  double radius = 0;           ///< of the lumen, cm
  std::vector<double> layers;  ///< thicknesses of the wall's layers from the lumen outwards, cm
  double length = 0;           ///< of the centreline, cm
  double bend_angle = 0;       ///< of the centreline, rad; 0 for a straight vessel
  int around_cells = 0;        ///< around the whole circumference, a multiple of 8
  int ring_cells = 0;          ///< of the blood, from its core to the interface
  /// Through the whole wall, at least as many as layers; shared out as element::wall_lines does.
  int wall_cells = 0;
  int axial_cells = 0;  ///< even, so that mid-length is a cell line
  /// Lengths of cells compared, each 1 (uniform) or more: at mid-length to at the ends, at the core to at the
  /// interface, at the outer surface to at the inner one.
  double end_grading = 1;
  double interface_grading = 1;
  double wall_grading = 1;
  Sector sector = Sector::full;
  bool blood = true;  ///< which parts are meshed
  bool wall = true;
  Shape shape = Shape::hexahedron;
  bool quadratic = true;
};

/// The section of o_grid_section at element::lines_along of the centreline. In both vessels the inlet is in
/// the plane z = 0 and flow enters along +z. At section coordinates (x, y) and arc length s the point is
/// (x, y, s), or, with the bend's radius Rb = length/bend_angle and phi = s/Rb,
///   (-Rb + (Rb + x) cos phi, y, (Rb + x) sin phi):
/// the bend's centre is at (-Rb, 0, 0), and its plane y = 0 divides it into mirror images. Quadratic cells
/// are curved: each node, also between corners, is mapped so. Nodes are numbered from the inlet to the
/// outlet, cells likewise.
///
/// Each hexahedron is six tetrahedra. A diagonal divides its section into two triangles, and each prism on
/// one of them is divided by the diagonals of its upright faces, which lead, away from the nearer end of the
/// vessel, to the inner of two nodes (Section::ranks). Thus meshes of tetrahedra have the mirror images that
/// those of hexahedra have, about y = 0, mid-length and in straight vessels x = 0, and no tetrahedron of the
/// blood has all corners on inlet and interface, or on outlet and interface, where velocities are given.
///
/// Throws InvalidInput for sizes that are not positive and finite, counts below 1, numbers of cells around
/// that are no multiple of 8, odd numbers of axial cells, gradings outside 1 to 10^6, bends of a full turn or
/// more, with the centre inside the vessel, or of more than 45 degrees in a cell, a quarter of a bent vessel,
/// more than five million nodes, and cells turned inside out.
Mesh o_grid_vessel(const VesselSpec& spec);

/// Number of its nodes, which may be more than fit an int.
double expected_nodes(const VesselSpec& spec);

}  // namespace tunica::full3d
