// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/assembler.hpp"

#include <algorithm>
#include <cmath>

#include "axisym/gather.hpp"

namespace tunica::axisym {

namespace {

using BloodResidual = kernel::BloodResidual<Frame, cell_width>;
using WallResidual = kernel::WallResidual<Frame, cell_width>;
using SideResidual = kernel::SideResidual<Frame, side_width>;

/// Loads on a boundary of the vessel and the flow through it.
struct BoundaryTerms {
  const Problem& problem;
  Boundary boundary;

  template <class S>
  kernel::SurfaceTerms<S> operator()(const kernel::SurfaceState<S>& state,
                                     const Vector<double>& normal) const {
    kernel::SurfaceTerms<S> terms;
    if (boundary == Boundary::outer) {
      terms.load = physics::tether_load(problem.tether, state.displacement, state.gradient, normal);
      return terms;
    }
    const Vector<S> area = physics::oriented_area(state.gradient, normal);
    terms.load = physics::pressure_load(state.pressure, area);
    if (boundary == Boundary::interface) return terms;
    terms.flow = physics::flow_density(state.velocity, state.mesh_velocity, area);
    if (boundary != Boundary::outlet || problem.outlet.backflow == 0) return terms;
    const auto back =
        physics::backflow_load(problem.outlet.backflow, problem.blood.density, terms.flow, state.velocity);
    for (int i = 0; i < 3; ++i) terms.load[i] = terms.load[i] + back[i];
    return terms;
  }
};

template <class Nodal, class Rows>
void add_rows(const Nodal& nodal, const Rows& rows, std::span<double> residual) {
  for (int c = 0; c < 2; ++c)
    for (std::size_t k = 0; k < std::size(nodal.value[c]); ++k)
      if (rows[c][k] >= 0) residual[rows[c][k]] += nodal.value[c][k];
}

bool is_loaded(const Problem& problem, const SideTable& side) {
  switch (side.boundary) {
    case Boundary::inlet:
      return problem.inlet.kind != InletKind::prescribed;
    case Boundary::outlet:
      return problem.outlet.kind != OutletKind::prescribed;
    case Boundary::outer:
      return problem.tether.stiffness > 0;
    case Boundary::interface:
      return side.of_wall && !problem.mesh.has(Part::blood);
    default:
      return false;
  }
}

/// On fewer cells a residual takes less than a millisecond, and threads are not worth their making.
constexpr int least_shared_cells = 500;

/// Tables of the cells, and of the sides that have something to do.
Tables needed_tables(const Problem& problem) {
  Tables tables = tabulate(problem);
  const bool coupled = problem.mesh.has(Part::blood) && problem.mesh.has(Part::wall);
  std::erase_if(tables.sides, [&](const SideTable& side) {
    const bool is_opening = side.boundary == Boundary::inlet || side.boundary == Boundary::outlet;
    const bool is_second_of_two = coupled && side.boundary == Boundary::interface && !side.of_wall;
    return !is_opening && !is_loaded(problem, side) && (!problem.loads.traction || is_second_of_two);
  });
  return tables;
}

}  // namespace

Assembler::Assembler(const Problem& problem, int threads)
    : problem_(problem),
      threads_(static_cast<int>(problem.mesh.cells.size()) < least_shared_cells ? 1 : threads),
      layout_(problem),
      tables_(needed_tables(problem)),
      map_(problem, layout_, tables_) {}

void Assembler::complete(const Stage& stage, std::span<double> y) const {
  const Vector<double> zero{};
  for (const auto& entry : layout_.prescribed()) {
    const auto& function = entry.is_velocity ? problem_.velocity : problem_.displacement;
    const auto value = function ? function(problem_.mesh.points[entry.node], stage.time) : zero;
    y[entry.entry] = value[Frame::axes[entry.component]];
  }
  for (const int node : layout_.wall_nodes())
    for (int c = 0; c < 2; ++c) y[layout_.velocity(node, c)] = rate(stage, y, layout_.displacement(node, c));
}

double Assembler::pressure_on(const SideTable& side, const Stage& stage, std::span<const double> y) const {
  if (const auto entry = map_.pressure_entry(side.boundary)) return y[*entry];
  if (side.boundary == Boundary::inlet && problem_.inlet.kind == InletKind::pressure)
    return problem_.inlet.value(stage.time);
  if (side.boundary == Boundary::interface) return problem_.lumen_pressure(stage.time);
  return 0;
}

bool Assembler::residual(const Stage& stage, std::span<const double> y, std::span<double> residual) const {
  const auto blood_count = static_cast<int>(tables_.blood.size());
  const auto wall_count = static_cast<int>(tables_.wall.size());
  std::vector<BloodResidual> blood(tables_.blood.size());
  std::vector<WallResidual> wall(tables_.wall.size());
  for_each_index(threads_, blood_count + wall_count, [&](int index) {
    if (index < blood_count) {
      const BloodTable& table = tables_.blood[index];
      const auto nodes = blood_nodes(problem_, layout_, problem_.mesh.cells[table.cell], stage, y);
      const auto parameters = blood_parameters(problem_, table, stage);
      for (const auto& at : table.points) kernel::add_blood_residual(parameters, at, nodes, blood[index]);
    } else {
      const int k = index - blood_count;
      const WallTable& table = tables_.wall[k];
      const auto nodes = wall_nodes(problem_, layout_, problem_.mesh.cells[table.cell], stage, y);
      kernel::add_wall_residual(wall_parameters(problem_, table, stage), table.points, nodes, wall[k]);
    }
  });
  std::fill(residual.begin(), residual.end(), 0.0);
  least_ = {};
  const auto watch = [this](double jacobian, int cell) {
    if (jacobian < least_.value || std::isnan(jacobian)) least_ = {jacobian, cell};
  };
  for (int k = 0; k < blood_count; ++k) {
    const Numbers& n = map_.blood()[k].numbers;
    add_rows(blood[k].momentum, n.momentum, residual);
    add_rows(blood[k].mesh, n.mesh, residual);
    for (int i = 0; i < cell_width; ++i)
      if (n.continuity[i] >= 0) residual[n.continuity[i]] += blood[k].continuity[i];
    watch(blood[k].least_jacobian, tables_.blood[k].cell);
  }
  for (int k = 0; k < wall_count; ++k) {
    add_rows(wall[k].momentum, map_.wall()[k].numbers.momentum, residual);
    watch(wall[k].least_jacobian, tables_.wall[k].cell);
  }
  if (!(least_.value > 0)) return false;
  add_sides(stage, y, residual);
  add_scalars(stage, y, residual);
  add_loads(stage.time, residual);
  return std::all_of(residual.begin(), residual.end(), [](double r) { return std::isfinite(r); });
}

void Assembler::add_sides(const Stage& stage, std::span<const double> y, std::span<double> residual) const {
  for (std::size_t s = 0; s < tables_.sides.size(); ++s) {
    const SideTable& side = tables_.sides[s];
    if (!is_loaded(problem_, side)) continue;
    SideNodes nodes = side_nodes(layout_, side, stage, y);
    nodes.pressure = pressure_on(side, stage, y);
    SideResidual result;
    for (const auto& at : side.points)
      kernel::add_side_residual(BoundaryTerms{problem_, side.boundary}, at, nodes, result);
    add_rows(result.momentum, map_.sides()[s].numbers.momentum, residual);
    for (const MatrixMap::ScalarRow& row : map_.scalar_rows(side.boundary))
      residual[layout_.unknown(row.entry)] += row.factor * result.flow;
  }
}

void Assembler::add_scalars(const Stage& stage, std::span<const double> y, std::span<double> residual) const {
  if (layout_.inlet_pressure)
    residual[layout_.unknown(*layout_.inlet_pressure)] -= problem_.inlet.value(stage.time);
  if (!layout_.outlet_pressure) return;
  const OutletCondition& outlet = problem_.outlet;
  double& row = residual[layout_.unknown(*layout_.outlet_pressure)];
  row += y[*layout_.outlet_pressure];
  const double beyond = outlet.pressure(stage.time);
  if (!layout_.windkessel_pressure) {
    row -= beyond;
    return;
  }
  const std::size_t stored = *layout_.windkessel_pressure;
  row -= y[stored];
  residual[layout_.unknown(stored)] +=
      outlet.compliance * rate(stage, y, stored) + (y[stored] - beyond) / outlet.resistance;
}

void Assembler::add_loads(double time, std::span<double> residual) const {
  const Loads& loads = problem_.loads;
  const auto apply = [&](const auto& function, double weight, const Point& place, const auto& shapes,
                         const auto& rows) {
    if (!function) return;
    Vector<double> force = function(place, time);
    std::remove_cvref_t<decltype(kernel::NodalVector<Frame, cell_width>{})> nodal;
    kernel::test_vector(-weight, force, Tensor<double>{}, shapes, nodal);
    add_rows(nodal, rows, residual);
  };
  if (loads.blood_force || loads.mesh_force || loads.blood_volume)
    for (std::size_t k = 0; k < tables_.blood.size(); ++k)
      for (const auto& at : tables_.blood[k].points) {
        const Numbers& n = map_.blood()[k].numbers;
        apply(loads.blood_force, at.weight, at.place, at.velocity, n.momentum);
        apply(loads.mesh_force, at.weight, at.place, at.displacement, n.mesh);
        if (!loads.blood_volume) continue;
        const double volume = at.weight * loads.blood_volume(at.place, time);
        for (int i = 0; i < cell_width; ++i)
          if (n.continuity[i] >= 0) residual[n.continuity[i]] -= volume * at.pressure.lift[0][i];
      }
  if (loads.wall_force)
    for (std::size_t k = 0; k < tables_.wall.size(); ++k)
      for (const auto& at : tables_.wall[k].points)
        apply(loads.wall_force, at.weight, at.place, at.displacement, map_.wall()[k].numbers.momentum);
  if (!loads.traction) return;
  for (std::size_t s = 0; s < tables_.sides.size(); ++s) {
    const SideTable& side = tables_.sides[s];
    for (const auto& at : side.points) {
      kernel::NodalVector<Frame, side_width> nodal;
      kernel::test_vector(-at.weight, loads.traction(at.place, time, side.boundary), Tensor<double>{},
                          at.shapes, nodal);
      add_rows(nodal, map_.sides()[s].numbers.momentum, residual);
    }
  }
}

void Assembler::tangent(const Stage& stage, std::span<const double> y, SparseMatrix& matrix) const {
  const auto blood_count = static_cast<int>(tables_.blood.size());
  const auto wall_count = static_cast<int>(tables_.wall.size());
  double* const values = matrix.valuePtr();
  std::fill(values, values + matrix.nonZeros(), 0.0);
  const double c = stage.coefficient;
  // Cells are computed side by side and added in their order, so that sums do not depend on threads.
  constexpr int batch = 64;
  std::vector<BloodTangent> blood(batch);
  for (int first = 0; first < blood_count; first += batch) {
    const int last = std::min(first + batch, blood_count);
    for_each_index(threads_, last - first, [&](int index) {
      const int k = first + index;
      const BloodTable& table = tables_.blood[k];
      const auto nodes = blood_nodes(problem_, layout_, problem_.mesh.cells[table.cell], stage, y);
      const auto parameters = blood_parameters(problem_, table, stage);
      BloodTangent& t = blood[index];
      t = {};
      for (const auto& at : table.points) kernel::add_blood_tangent(parameters, at, nodes, t);
    });
    for (int k = first; k < last; ++k) scatter(blood[k - first], map_.blood()[k], c, values);
  }
  std::vector<WallTangent> wall(batch);
  for (int first = 0; first < wall_count; first += batch) {
    const int last = std::min(first + batch, wall_count);
    for_each_index(threads_, last - first, [&](int index) {
      const int k = first + index;
      const WallTable& table = tables_.wall[k];
      const auto nodes = wall_nodes(problem_, layout_, problem_.mesh.cells[table.cell], stage, y);
      WallTangent& t = wall[index];
      t = {};
      kernel::add_wall_tangent(wall_parameters(problem_, table, stage), table.points, nodes, t);
    });
    for (int k = first; k < last; ++k) scatter(wall[k - first], map_.wall()[k], c, values);
  }
  for (std::size_t s = 0; s < tables_.sides.size(); ++s) {
    const SideTable& side = tables_.sides[s];
    if (!is_loaded(problem_, side)) continue;
    SideNodes nodes = side_nodes(layout_, side, stage, y);
    nodes.pressure = pressure_on(side, stage, y);
    SideTangent t;
    for (const auto& at : side.points)
      kernel::add_side_tangent(BoundaryTerms{problem_, side.boundary}, c, at, nodes, t);
    const Numbers& n = map_.sides()[s].numbers;
    scatter(t, map_.sides()[s], c, values);
    const auto pressure = map_.pressure_entry(side.boundary);
    const auto rows = map_.scalar_rows(side.boundary);
    for (int b = 0; b < 2; ++b)
      for (int k = 0; k < side.count; ++k) {
        if (pressure && n.momentum[b][k] >= 0)
          matrix.coeffRef(n.momentum[b][k], layout_.unknown(*pressure)) += t.momentum_pressure.value[b][k];
        for (const MatrixMap::ScalarRow& row : rows) {
          const int r = layout_.unknown(row.entry);
          if (n.velocity[b][k] >= 0)
            matrix.coeffRef(r, n.velocity[b][k]) +=
                row.factor * (n.adheres[k] ? c : 1.0) * t.flow_velocity.value[b][k];
          if (n.displacement[b][k] >= 0)
            matrix.coeffRef(r, n.displacement[b][k]) += row.factor * t.flow_displacement.value[b][k];
        }
      }
  }
  if (!layout_.outlet_pressure) return;
  const int outlet = layout_.unknown(*layout_.outlet_pressure);
  matrix.coeffRef(outlet, outlet) += 1;
  if (!layout_.windkessel_pressure) return;
  const int stored = layout_.unknown(*layout_.windkessel_pressure);
  matrix.coeffRef(outlet, stored) -= 1;
  matrix.coeffRef(stored, stored) += problem_.outlet.compliance * c + 1 / problem_.outlet.resistance;
}

double Assembler::flow(const Stage& stage, std::span<const double> y, Boundary boundary) const {
  double sum = 0;
  for (const SideTable& side : tables_.sides) {
    if (side.boundary != boundary) continue;
    const SideNodes nodes = side_nodes(layout_, side, stage, y);
    SideResidual result;
    for (const auto& at : side.points)
      kernel::add_side_residual(BoundaryTerms{problem_, boundary}, at, nodes, result);
    sum += result.flow;
  }
  return sum;
}

}  // namespace tunica::axisym
