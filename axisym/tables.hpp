// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "axisym/problem.hpp"
#include "axisym/wall_axes.hpp"
#include "core/kernel/blood_cell.hpp"
#include "core/kernel/surface_side.hpp"
#include "core/kernel/wall_cell.hpp"

namespace tunica::axisym {

using Frame = frame::Axisymmetric;
/// Widths that hold nine nodes of a cell and three of a side, even for the sake of vector instructions.
inline constexpr int cell_width = 10;
inline constexpr int side_width = 4;
using BloodPoint = kernel::BloodPoint<Frame, cell_width>;
using WallPoint = kernel::WallPoint<Frame, cell_width>;
using SidePoint = kernel::SidePoint<Frame, side_width>;

/// Numbers of shape functions of the fields in a cell, on its first nodes (the bubble's velocity: on its
/// corners and its centre).
struct Counts {
  int displacement, velocity, pressure;
};
Counts counts(CellShape shape, Element element);

/// The node of a cell that velocity shape function k belongs to.
int velocity_node(const Mesh& mesh, Element element, const Cell& cell, int k);

struct BloodTable {
  int cell;
  double size;  ///< diameter of the circle of the cell's area, cm
  std::vector<BloodPoint> points;
};
struct WallTable {
  int cell;
  int layer;
  int pressure_terms;
  std::vector<WallPoint> points;
};
struct SideTable {
  Boundary boundary;
  int cell;
  bool of_wall;  ///< the side belongs to a wall cell
  int count;     ///< of nodes
  std::array<int, 3> nodes;
  std::vector<SidePoint> points;
};

/// Shape functions of all cells and boundary sides at their quadrature points, and the directions of the
/// wall, which refer to the problem's mesh. Throws InvalidInput for a cell whose map is not one to one.
struct Tables {
  std::vector<BloodTable> blood;
  std::vector<WallTable> wall;
  std::vector<SideTable> sides;
  WallAxes axes;
};
Tables tabulate(const Problem& problem);

/// Lifts of shape functions at a local point of a cell, for observers: the displacement's basis.
kernel::Lifted<Frame, cell_width> lifted_at(const Mesh& mesh, Element element, int cell,
                                            const std::array<double, 2>& local, Point* place = nullptr);

}  // namespace tunica::axisym
