// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/coupled/equations.hpp"
#include "core/kernel/blood_cell.hpp"
#include "core/kernel/surface_side.hpp"
#include "core/kernel/wall_cell.hpp"

/// What kernels need of a state: the nodal values and rates of a cell or side.
namespace tunica::coupled {

/// Displacement and its rate of a node: off the wall as the stage gives them, where it does.
struct Motion {
  double displacement, velocity;
};
inline Motion motion(const Layout& layout, const Stage& stage, std::span<const double> y, int node,
                     std::size_t entry) {
  if (stage.mesh.empty() || layout.on_wall(node)) return {y[entry], rate(stage, y, entry)};
  return {stage.mesh[entry], stage.mesh_rate[entry]};
}

/// Nodes of the mesh that the shape functions of a blood cell's fields belong to.
struct BloodCellNodes {
  std::span<const int> displacement, velocity, pressure;
};

template <class Frame, int Width>
kernel::BloodNodes<Frame, Width> blood_nodes(const Layout& layout, const BloodCellNodes& cell,
                                             const Stage& stage, std::span<const double> y) {
  kernel::BloodNodes<Frame, Width> nodes;
  for (int c = 0; c < Frame::components; ++c) {
    for (std::size_t k = 0; k < cell.displacement.size(); ++k) {
      const int node = cell.displacement[k];
      const Motion mesh = motion(layout, stage, y, node, layout.displacement(node, c));
      nodes.displacement.value[c][k] = mesh.displacement;
      nodes.mesh_velocity.value[c][k] = mesh.velocity;
    }
    for (std::size_t k = 0; k < cell.velocity.size(); ++k) {
      const std::size_t entry = layout.velocity(cell.velocity[k], c);
      nodes.velocity.value[c][k] = y[entry];
      nodes.acceleration.value[c][k] = rate(stage, y, entry);
    }
  }
  for (std::size_t k = 0; k < cell.pressure.size(); ++k)
    nodes.pressure[k] = y[layout.pressure(cell.pressure[k])];
  return nodes;
}

template <class Frame, int Width>
kernel::WallNodes<Frame, Width> wall_nodes(const Layout& layout, std::span<const int> cell,
                                           const Stage& stage, std::span<const double> y) {
  kernel::WallNodes<Frame, Width> nodes;
  for (int c = 0; c < Frame::components; ++c)
    for (std::size_t k = 0; k < cell.size(); ++k) {
      nodes.displacement.value[c][k] = y[layout.displacement(cell[k], c)];
      nodes.acceleration.value[c][k] = rate(stage, y, layout.velocity(cell[k], c));
    }
  return nodes;
}

template <class Frame, int Width>
kernel::SideNodes<Frame, Width> side_nodes(const Layout& layout, std::span<const int> side,
                                           const Stage& stage, std::span<const double> y) {
  kernel::SideNodes<Frame, Width> nodes;
  for (int c = 0; c < Frame::components; ++c)
    for (std::size_t k = 0; k < side.size(); ++k) {
      const Motion mesh = motion(layout, stage, y, side[k], layout.displacement(side[k], c));
      nodes.displacement.value[c][k] = mesh.displacement;
      nodes.mesh_velocity.value[c][k] = mesh.velocity;
      nodes.velocity.value[c][k] = y[layout.velocity(side[k], c)];
    }
  return nodes;
}

/// Nodal displacements of a cell.
template <class Frame, int Width>
kernel::NodalVector<Frame, Width> nodal_displacement(const Layout& layout, std::span<const int> cell,
                                                     std::span<const double> y) {
  kernel::NodalVector<Frame, Width> nodal;
  for (int c = 0; c < Frame::components; ++c)
    for (std::size_t k = 0; k < cell.size(); ++k) nodal.value[c][k] = y[layout.displacement(cell[k], c)];
  return nodal;
}

/// Nodal velocities of a cell.
template <class Frame, int Width>
kernel::NodalVector<Frame, Width> nodal_velocity(const Layout& layout, std::span<const int> cell,
                                                 std::span<const double> y) {
  kernel::NodalVector<Frame, Width> nodal;
  for (int c = 0; c < Frame::components; ++c)
    for (std::size_t k = 0; k < cell.size(); ++k) nodal.value[c][k] = y[layout.velocity(cell[k], c)];
  return nodal;
}

}  // namespace tunica::coupled
