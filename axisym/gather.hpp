// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "axisym/layout.hpp"
#include "axisym/tables.hpp"
#include "core/coupled/gather.hpp"

/// The nodes of a cell, and the parameters of its equations.
namespace tunica::axisym {

using BloodNodes = kernel::BloodNodes<Frame, cell_width>;
using WallNodes = kernel::WallNodes<Frame, cell_width>;
using SideNodes = kernel::SideNodes<Frame, side_width>;
using coupled::Stage;

/// Nodes of a cell by the fields of its part.
class CellNodes {
 public:
  CellNodes(const Mesh& mesh, Element element, const Cell& cell)
      : counts_(counts(mesh.shape, element)), nodes_(cell.nodes), velocity_(cell.nodes) {
    for (int k = 0; k < counts_.velocity; ++k) velocity_[k] = velocity_node(mesh, element, cell, k);
  }
  std::span<const int> displacement() const {
    return {nodes_.data(), static_cast<std::size_t>(counts_.displacement)};
  }
  coupled::BloodCellNodes blood() const {
    return {displacement(),
            {velocity_.data(), static_cast<std::size_t>(counts_.velocity)},
            {nodes_.data(), static_cast<std::size_t>(counts_.pressure)}};
  }

 private:
  Counts counts_;
  std::array<int, 9> nodes_, velocity_;
};

inline std::span<const int> nodes_of(const SideTable& side) {
  return {side.nodes.data(), static_cast<std::size_t>(side.count)};
}

inline BloodNodes blood_nodes(const Problem& problem, const Layout& layout, const Cell& cell,
                              const Stage& stage, std::span<const double> y) {
  const CellNodes nodes(problem.mesh, problem.discretisation.element, cell);
  return coupled::blood_nodes<Frame, cell_width>(layout, nodes.blood(), stage, y);
}

inline WallNodes wall_nodes(const Problem& problem, const Layout& layout, const Cell& cell,
                            const Stage& stage, std::span<const double> y) {
  const CellNodes nodes(problem.mesh, problem.discretisation.element, cell);
  return coupled::wall_nodes<Frame, cell_width>(layout, nodes.displacement(), stage, y);
}

inline SideNodes side_nodes(const Layout& layout, const SideTable& side, const Stage& stage,
                            std::span<const double> y) {
  return coupled::side_nodes<Frame, side_width>(layout, nodes_of(side), stage, y);
}

inline kernel::BloodParameters blood_parameters(const Problem& problem, const BloodTable& table,
                                                const Stage& stage) {
  kernel::BloodParameters parameters{problem.blood, stage.coefficient, 1.0, {}, 0.0};
  if (problem.discretisation.motion == coupled::MeshMotion::stiffened)
    parameters.mesh_stiffness = 1 / (table.size * table.size);
  if (problem.discretisation.element == Element::linear) parameters.stabilised_size = table.size;
  return parameters;
}

inline kernel::WallParameters wall_parameters(const Problem& problem, const WallTable& table,
                                              const Stage& stage) {
  return {&problem.laws[table.layer], problem.wall_density, stage.coefficient, table.pressure_terms,
          stage.wall_pressure_bound};
}

}  // namespace tunica::axisym
