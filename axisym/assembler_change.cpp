// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the residual along directions: all of them in one pass over the cells, by duals.
#include <algorithm>

#include "axisym/assembler.hpp"
#include "axisym/gather.hpp"
#include "core/coupled/openings.hpp"

namespace tunica::axisym {

namespace {

using BloodResidual = kernel::BloodResidual<Frame, cell_width>;
using SideResidual = kernel::SideResidual<Frame, side_width>;
using coupled::add_rows;

}  // namespace

template <int Directions>
void Assembler::add_change(const Stage& stage, std::span<const double> y, const Direction* along,
                           std::vector<double>* changes) const {
  for (std::size_t k = 0; k < tables_.blood.size(); ++k) {
    const BloodTable& table = tables_.blood[k];
    const Cell& cell = problem_.mesh.cells[table.cell];
    const auto nodes = blood_nodes(problem_, layout_, cell, stage, y);
    std::array<BloodNodes, Directions> moved;
    for (int d = 0; d < Directions; ++d)
      moved[d] = blood_nodes(problem_, layout_, cell, along[d].stage, along[d].y);
    std::array<BloodResidual, Directions> change;
    const auto parameters = blood_parameters(problem_, table, stage);
    for (const auto& at : table.points) kernel::add_blood_change(parameters, at, nodes, moved, change);
    const CellNumbers& n = map_.blood()[k].numbers;
    for (int d = 0; d < Directions; ++d) {
      add_rows(change[d].momentum, n.momentum, changes[d]);
      add_rows(change[d].mesh, n.mesh, changes[d]);
      for (int i = 0; i < cell_width; ++i)
        if (n.continuity[i] >= 0) changes[d][n.continuity[i]] += change[d].continuity[i];
    }
  }
  for (std::size_t k = 0; k < tables_.wall.size(); ++k) {
    const WallTable& table = tables_.wall[k];
    const Cell& cell = problem_.mesh.cells[table.cell];
    for (int d = 0; d < Directions; ++d) {
      const auto moved = wall_nodes(problem_, layout_, cell, along[d].stage, along[d].y);
      kernel::NodalVector<Frame, cell_width> momentum;
      kernel::add_inertia(problem_.wall_density, table.points, moved.acceleration, momentum);
      add_rows(momentum, map_.wall()[k].numbers.momentum, changes[d]);
    }
  }
  for (std::size_t s = 0; s < tables_.sides.size(); ++s) {
    const SideTable& side = tables_.sides[s];
    if (!is_loaded(side)) continue;
    SideNodes nodes = side_nodes(layout_, side, stage, y);
    nodes.pressure = coupled::pressure_on(problem_, layout_, side.boundary, stage.time, y);
    std::array<SideNodes, Directions> moved;
    for (int d = 0; d < Directions; ++d) moved[d] = side_nodes(layout_, side, along[d].stage, along[d].y);
    std::array<SideResidual, Directions> change;
    for (const auto& at : side.points)
      kernel::add_side_change(coupled::BoundaryTerms<2>{problem_, side.boundary}, at, nodes, moved, change);
    for (int d = 0; d < Directions; ++d) {
      add_rows(change[d].momentum, map_.sides()[s].numbers.momentum, changes[d]);
      for (const auto& row : coupled::scalar_rows(layout_, problem_, side.boundary))
        changes[d][layout_.unknown(row.entry)] += row.factor * change[d].flow;
    }
  }
  for (int d = 0; d < Directions; ++d)
    coupled::add_scalar_change(problem_.outlet, layout_, along[d].stage, along[d].y, changes[d]);
}

void Assembler::change(const Stage& stage, std::span<const double> y, std::span<const Direction> along,
                       std::span<std::vector<double>> changes) const {
  for (auto& one : changes) one.assign(layout_.unknowns(), 0.0);
  // A pass takes several along: fewer repeat what all share.
  for (std::size_t first = 0; first < along.size();) {
    const std::size_t left = along.size() - first;
    const auto pass = [&]<int Directions>() {
      add_change<Directions>(stage, y, &along[first], &changes[first]);
      first += Directions;
    };
    if (left >= 5)
      pass.template operator()<5>();
    else if (left >= 3)
      pass.template operator()<3>();
    else
      pass.template operator()<1>();
  }
}

}  // namespace tunica::axisym
