// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "full3d/mesh.hpp"

namespace tunica::full3d {

/// How much of a vessel is meshed: all of it, y >= 0, or x >= 0 and y >= 0.
enum class Sector { full, half, quarter };

struct SectionSpec {
  double radius;     ///< of the interface
  int around_cells;  ///< around the whole circumference, a multiple of 8
  int ring_cells;    ///< of the blood around its core; 0 for no blood
  double interface_grading;
  std::vector<double> wall_lines;  ///< radii from the interface outwards, empty for no wall
  std::vector<int> wall_layers;    ///< of the cells between them
  Sector sector;
  bool quadratic;
};

/// The cross-section of a vessel in quadrilaterals: an O-grid.
///
/// The lumen has a core of n x n cells, n = around_cells/4, whose corners lie on the diagonals at 0.55 R and
/// whose sides bulge so that the three cells at a corner meet at about 120 degrees each: side points are the
/// mean, weighted 0.6 to 0.4, of those of a square and of a circle on the same ray. Inside, Coons's
/// transfinite interpolation. Rings lie between the core and the interface, on straight rays at equidistant
/// angles, which go on through the wall; element::shrinking_lines and wall_lines place them. One octant is
/// computed and reflected, so that the section is bitwise its own mirror image about x = 0, y = 0 and x = y,
/// and a sector is a subset of the whole.
struct Section {
  std::vector<std::array<double, 2>> points;
  /// Of each corner: rises outwards from ring to ring, then from the axes to the diagonals. Mirror images
  /// have the same rank; the ends of a side or of a cell's rising diagonal have not.
  std::vector<int> ranks;
  /// Nodes of the biquadratic basis in lexicographic order, -1 for the middles of linear cells.
  struct Quad {
    std::array<int, 9> nodes;
    Part part;
    int layer;
  };
  std::vector<Quad> quads;
  /// Sides of cells on boundaries; sides are numbered as faces of cubes: -xi, +xi, -eta, +eta.
  struct Side {
    int quad, side;
    Boundary boundary;
  };
  std::vector<Side> sides;
};

Section o_grid_section(const SectionSpec& spec);

}  // namespace tunica::full3d
