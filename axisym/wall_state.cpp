// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/wall_state.hpp"

#include <cmath>

#include "axisym/gather.hpp"

namespace tunica::axisym {

kernel::NodalVector<Frame, cell_width> nodal_displacement(const Assembler& assembler, int cell,
                                                          std::span<const double> y) {
  const Problem& problem = assembler.problem();
  const CellNodes nodes(problem.mesh, problem.discretisation.element, problem.mesh.cells[cell]);
  return coupled::nodal_displacement<Frame, cell_width>(assembler.layout(), nodes.displacement(), y);
}

kernel::NodalVector<Frame, cell_width> nodal_velocity(const Assembler& assembler, int cell,
                                                      std::span<const double> y) {
  const Problem& problem = assembler.problem();
  const CellNodes nodes(problem.mesh, problem.discretisation.element, problem.mesh.cells[cell]);
  return coupled::nodal_velocity<Frame, cell_width>(assembler.layout(), nodes.displacement(), y);
}

WallCell::WallCell(const Assembler& assembler, const WallTable& table, std::span<const double> y)
    : problem_(assembler.problem()),
      table_(table),
      displacement_(nodal_displacement(assembler, table.cell, y)) {
  if (table.pressure_terms == 0) return;
  const kernel::WallParameters parameters{&problem_.laws[table.layer], 0, 0, table.pressure_terms};
  kernel::WallNodes<Frame, cell_width> nodes;
  nodes.displacement = displacement_;
  pressure_.emplace(parameters, table.points, kernel::gradients(table.points, nodes));
}

WallStrain WallCell::at(const element::Local& local) const {
  const auto shapes = lifted_at(problem_.mesh, problem_.discretisation.element, table_.cell, local);
  WallStrain strain{kernel::field_value(shapes, displacement_), kernel::field_gradient(shapes, displacement_),
                    0};
  if (pressure_) {
    const double basis[kernel::max_pressure_terms<Frame>] = {1, local[0], local[1]};
    strain.pressure = pressure_->at(basis);
  } else {
    strain.take_own_pressure(problem_.laws[table_.layer]);
  }
  return strain;
}

WallReader::WallReader(const Assembler& assembler) : assembler_(assembler) {
  tables_.assign(assembler.problem().mesh.cells.size(), nullptr);
  for (const WallTable& table : assembler.tables().wall) tables_[table.cell] = &table;
}

WallCell WallReader::cell(int cell, std::span<const double> y) const {
  return {assembler_, *tables_[cell], y};
}

WallStrain WallReader::mean(std::span<const Place> places, std::span<const double> y) const {
  WallStrain sum;
  for (const Place& place : places)
    sum.add(1.0 / static_cast<double>(places.size()), cell(place.cell, y).at(place.local));
  return sum;
}

Tensor<double> WallReader::cauchy(int layer, const WallStrain& strain, const wall::MaterialAxes& axes) const {
  return coupled::cauchy(assembler_.problem().laws[layer], strain, axes);
}

wall::MaterialAxes WallReader::axes(std::span<const Place> places) const {
  Vector<double> sum{};
  for (const Place& place : places) {
    const auto axes = assembler_.tables().axes.at(place.cell, place.local);
    if (std::isnan(axes.axial[0])) continue;
    for (int i = 0; i < 3; ++i) sum[i] += axes.axial[i];
  }
  const double length = std::hypot(sum[0], sum[2]);  // 0 leads to NaN: no direction
  return {{0, 1, 0}, {sum[0] / length, 0, sum[2] / length}};
}

}  // namespace tunica::axisym
