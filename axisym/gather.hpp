// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "axisym/assembler.hpp"

/// What kernels need of a state: the nodal values and rates of a cell or side, and the parameters of its
/// equations.
namespace tunica::axisym {

using BloodNodes = kernel::BloodNodes<Frame, cell_width>;
using WallNodes = kernel::WallNodes<Frame, cell_width>;
using SideNodes = kernel::SideNodes<Frame, side_width>;

inline double rate(const Stage& stage, std::span<const double> y, std::size_t entry) {
  const double history = stage.history.empty() ? 0 : stage.history[entry];
  return stage.coefficient * y[entry] + history;
}

inline BloodNodes blood_nodes(const Problem& problem, const Layout& layout, const Cell& cell,
                              const Stage& stage, std::span<const double> y) {
  const Element element = problem.discretisation.element;
  const Counts n = counts(problem.mesh.shape, element);
  BloodNodes nodes;
  for (int c = 0; c < 2; ++c) {
    for (int k = 0; k < n.displacement; ++k) {
      const std::size_t entry = layout.displacement(cell.nodes[k], c);
      nodes.displacement.value[c][k] = y[entry];
      nodes.mesh_velocity.value[c][k] = rate(stage, y, entry);
    }
    for (int k = 0; k < n.velocity; ++k) {
      const std::size_t entry = layout.velocity(velocity_node(problem.mesh, element, cell, k), c);
      nodes.velocity.value[c][k] = y[entry];
      nodes.acceleration.value[c][k] = rate(stage, y, entry);
    }
  }
  for (int k = 0; k < n.pressure; ++k) nodes.pressure[k] = y[layout.pressure(cell.nodes[k])];
  return nodes;
}

inline WallNodes wall_nodes(const Problem& problem, const Layout& layout, const Cell& cell,
                            const Stage& stage, std::span<const double> y) {
  WallNodes nodes;
  for (int c = 0; c < 2; ++c)
    for (int k = 0; k < counts(problem.mesh.shape, problem.discretisation.element).displacement; ++k) {
      nodes.displacement.value[c][k] = y[layout.displacement(cell.nodes[k], c)];
      nodes.acceleration.value[c][k] = rate(stage, y, layout.velocity(cell.nodes[k], c));
    }
  return nodes;
}

inline SideNodes side_nodes(const Layout& layout, const SideTable& side, const Stage& stage,
                            std::span<const double> y) {
  SideNodes nodes;
  for (int c = 0; c < 2; ++c)
    for (int k = 0; k < side.count; ++k) {
      const std::size_t d = layout.displacement(side.nodes[k], c);
      nodes.displacement.value[c][k] = y[d];
      nodes.mesh_velocity.value[c][k] = rate(stage, y, d);
      nodes.velocity.value[c][k] = y[layout.velocity(side.nodes[k], c)];
    }
  return nodes;
}

inline kernel::BloodParameters blood_parameters(const Problem& problem, const BloodTable& table,
                                                const Stage& stage) {
  kernel::BloodParameters parameters{problem.blood, stage.coefficient, 1.0, 0.0};
  if (problem.discretisation.stiffened_mesh) parameters.mesh_stiffness = 1 / (table.size * table.size);
  if (problem.discretisation.element == Element::linear) parameters.stabilised_size = table.size;
  return parameters;
}

inline kernel::WallParameters wall_parameters(const Problem& problem, const WallTable& table,
                                              const Stage& stage) {
  return {&problem.laws[table.layer], problem.wall_density, stage.coefficient, table.pressure_terms};
}

}  // namespace tunica::axisym
