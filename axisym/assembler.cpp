// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/assembler.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::axisym {

namespace {

using BloodNodes = kernel::BloodNodes<Frame, cell_width>;
using WallNodes = kernel::WallNodes<Frame, cell_width>;
using SideNodes = kernel::SideNodes<Frame, side_width>;
using BloodTangent = kernel::BloodTangent<Frame, cell_width>;
using WallTangent = kernel::WallTangent<Frame, cell_width>;
using SideTangent = kernel::SideTangent<Frame, side_width>;
using BloodResidual = kernel::BloodResidual<Frame, cell_width>;
using WallResidual = kernel::WallResidual<Frame, cell_width>;
using SideResidual = kernel::SideResidual<Frame, side_width>;

double rate(const Stage& stage, std::span<const double> y, std::size_t entry) {
  const double history = stage.history.empty() ? 0 : stage.history[entry];
  return stage.coefficient * y[entry] + history;
}

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

/// Visits every block of a tangent with the rows and columns that it belongs to.
template <class Numbers, class Visit>
void visit_blocks(const Numbers& n, const BloodTangent& t, const Visit& visit) {
  constexpr bool by_velocity = true;
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      visit(n.momentum[a], n.velocity[b], by_velocity, t.momentum_velocity[a][b]);
      visit(n.momentum[a], n.displacement[b], !by_velocity, t.momentum_displacement[a][b]);
    }
    visit(n.mesh[a], n.displacement[a], !by_velocity, t.mesh_displacement[a][a]);
    visit(n.momentum[a], n.pressure, !by_velocity, t.momentum_pressure[a][0]);
    visit(n.continuity, n.velocity[a], by_velocity, t.continuity_velocity[0][a]);
    visit(n.continuity, n.displacement[a], !by_velocity, t.continuity_displacement[0][a]);
  }
  visit(n.continuity, n.pressure, !by_velocity, t.continuity_pressure[0][0]);
}
template <class Numbers, class Visit>
void visit_blocks(const Numbers& n, const WallTangent& t, const Visit& visit) {
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) visit(n.momentum[a], n.displacement[b], false, t.momentum[a][b]);
}
template <class Numbers, class Visit>
void visit_blocks(const Numbers& n, const SideTangent& t, const Visit& visit) {
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      visit(n.momentum[a], n.velocity[b], true, t.momentum_velocity[a][b]);
      visit(n.momentum[a], n.displacement[b], false, t.momentum_displacement[a][b]);
    }
}

/// Finds the places of a tangent's entries in the matrix, in the order in which scatter() visits them.
template <class Tangent, class Numbers, class Place>
std::vector<int> find_places(const Numbers& numbers, const Place& place) {
  std::vector<int> places;
  visit_blocks(numbers, Tangent{}, [&](const auto& rows, const auto& columns, bool, const auto& block) {
    constexpr int width = static_cast<int>(std::size(decltype(block.entry){}));
    for (int k = 0; k < width; ++k)
      for (int l = 0; l < width; ++l)
        places.push_back(rows[k] >= 0 && columns[l] >= 0 ? place(rows[k], columns[l]) : -1);
  });
  return places;
}

/// Adds a tangent to the matrix; the columns of a velocity that is the rate of a displacement are those of
/// the displacement, times d(rate)/d(displacement).
template <class Tangent, class Numbers>
void scatter(const Tangent& tangent, const Numbers& numbers, const std::vector<int>& places,
             double coefficient, double* values) {
  const int* place = places.data();
  visit_blocks(numbers, tangent, [&](const auto&, const auto&, bool by_velocity, const auto& block) {
    constexpr int width = static_cast<int>(std::size(decltype(block.entry){}));
    double factor[width];
    for (int l = 0; l < width; ++l) factor[l] = by_velocity && numbers.adheres[l] ? coefficient : 1.0;
    for (int k = 0; k < width; ++k)
      for (int l = 0; l < width; ++l, ++place)
        if (*place >= 0) values[*place] += factor[l] * block.entry[k][l];
  });
}

template <class Nodal, class Rows>
void add_rows(const Nodal& nodal, const Rows& rows, std::span<double> residual) {
  for (int c = 0; c < 2; ++c)
    for (std::size_t k = 0; k < std::size(nodal.value[c]); ++k)
      if (rows[c][k] >= 0) residual[rows[c][k]] += nodal.value[c][k];
}

}  // namespace

Assembler::Assembler(const Problem& problem)
    : problem_(problem), layout_(problem), tables_(tabulate(problem)) {
  const bool coupled = problem.mesh.has(Part::blood) && problem.mesh.has(Part::wall);
  std::erase_if(tables_.sides, [&](const SideTable& side) {
    const bool is_opening = side.boundary == Boundary::inlet || side.boundary == Boundary::outlet;
    const bool is_second_of_two = coupled && side.boundary == Boundary::interface && !side.of_wall;
    return !is_opening && !is_loaded(side) && (!problem_.loads.traction || is_second_of_two);
  });
  build_pattern();
}

bool Assembler::is_loaded(const SideTable& side) const {
  switch (side.boundary) {
    case Boundary::inlet:
      return problem_.inlet.kind != InletKind::prescribed;
    case Boundary::outlet:
      return problem_.outlet.kind != OutletKind::prescribed;
    case Boundary::outer:
      return problem_.tether.stiffness > 0;
    case Boundary::interface:
      return side.of_wall && !problem_.mesh.has(Part::blood);
    default:
      return false;
  }
}

Assembler::Numbers Assembler::cell_numbers(int index) const {
  const Mesh& mesh = problem_.mesh;
  const Element element = problem_.discretisation.element;
  const Cell& cell = mesh.cells[index];
  const Counts n = counts(mesh.shape, element);
  Numbers numbers;
  for (auto* list : {&numbers.momentum, &numbers.mesh, &numbers.velocity, &numbers.displacement})
    for (auto& component : *list) component.fill(-1);
  numbers.continuity.fill(-1);
  numbers.pressure.fill(-1);
  numbers.adheres.fill(false);
  for (int c = 0; c < 2; ++c) {
    for (int k = 0; k < n.displacement; ++k) {
      const int node = cell.nodes[k];
      const int unknown = layout_.unknown(layout_.displacement(node, c));
      numbers.displacement[c][k] = unknown;
      if (layout_.on_wall(node))
        numbers.momentum[c][k] = unknown;
      else
        numbers.mesh[c][k] = unknown;
    }
    if (cell.part == Part::wall) continue;
    for (int k = 0; k < n.velocity; ++k) {
      const int node = velocity_node(mesh, element, cell, k);
      numbers.adheres[k] = layout_.on_wall(node);
      const std::size_t entry =
          numbers.adheres[k] ? layout_.displacement(node, c) : layout_.velocity(node, c);
      numbers.velocity[c][k] = layout_.unknown(entry);
      if (!numbers.adheres[k]) numbers.momentum[c][k] = layout_.unknown(entry);
    }
  }
  if (cell.part == Part::blood)
    for (int k = 0; k < n.pressure; ++k)
      numbers.continuity[k] = numbers.pressure[k] = layout_.unknown(layout_.pressure(cell.nodes[k]));
  return numbers;
}

Assembler::Numbers Assembler::side_numbers(const SideTable& side) const {
  Numbers numbers;
  for (auto* list : {&numbers.momentum, &numbers.mesh, &numbers.velocity, &numbers.displacement})
    for (auto& component : *list) component.fill(-1);
  numbers.continuity.fill(-1);
  numbers.pressure.fill(-1);
  numbers.adheres.fill(false);
  for (int k = 0; k < side.count; ++k) {
    const int node = side.nodes[k];
    numbers.adheres[k] = layout_.on_wall(node);
    for (int c = 0; c < 2; ++c) {
      numbers.displacement[c][k] = layout_.unknown(layout_.displacement(node, c));
      numbers.velocity[c][k] =
          numbers.adheres[k] ? numbers.displacement[c][k] : layout_.unknown(layout_.velocity(node, c));
      numbers.momentum[c][k] = numbers.velocity[c][k];
    }
  }
  return numbers;
}

std::optional<std::size_t> Assembler::pressure_entry(Boundary boundary) const {
  if (boundary == Boundary::inlet) return layout_.inlet_pressure;
  if (boundary == Boundary::outlet) return layout_.outlet_pressure;
  return std::nullopt;
}

std::vector<Assembler::ScalarRow> Assembler::scalar_rows(Boundary boundary) const {
  if (boundary == Boundary::inlet && layout_.inlet_pressure) return {{*layout_.inlet_pressure, -1.0}};
  if (boundary != Boundary::outlet || !layout_.outlet_pressure) return {};
  const OutletCondition& outlet = problem_.outlet;
  if (!layout_.windkessel_pressure) return {{*layout_.outlet_pressure, -outlet.resistance}};
  return {{*layout_.outlet_pressure, -outlet.proximal_resistance}, {*layout_.windkessel_pressure, -1.0}};
}

void Assembler::build_pattern() {
  for (const auto& table : tables_.blood) blood_targets_.push_back({cell_numbers(table.cell), {}});
  for (const auto& table : tables_.wall) wall_targets_.push_back({cell_numbers(table.cell), {}});
  for (const auto& table : tables_.sides) side_targets_.push_back({side_numbers(table), {}});

  std::vector<std::vector<int>> columns(layout_.unknowns());
  const auto note = [&](int row, int column) {
    columns[column].push_back(row);
    return 0;
  };
  // A cell's blocks repeat the same pairs: sorting and thinning as columns grow bounds the memory.
  const auto thin = [&] {
    for (auto& rows : columns) {
      std::sort(rows.begin(), rows.end());
      rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    }
  };
  for (const auto& t : blood_targets_) find_places<BloodTangent>(t.numbers, note);
  for (const auto& t : wall_targets_) find_places<WallTangent>(t.numbers, note);
  for (const auto& t : side_targets_) find_places<SideTangent>(t.numbers, note);
  for (std::size_t s = 0; s < tables_.sides.size(); ++s) {
    const Boundary boundary = tables_.sides[s].boundary;
    const Numbers& n = side_targets_[s].numbers;
    for (int c = 0; c < 2; ++c)
      for (int k = 0; k < tables_.sides[s].count; ++k) {
        if (const auto p = pressure_entry(boundary); p && n.momentum[c][k] >= 0)
          note(n.momentum[c][k], layout_.unknown(*p));
        for (const ScalarRow& row : scalar_rows(boundary))
          for (const int column : {n.velocity[c][k], n.displacement[c][k]})
            if (column >= 0) note(layout_.unknown(row.entry), column);
      }
  }
  for (std::size_t a = layout_.scalar_begin(); a < layout_.size(); ++a)
    for (std::size_t b = layout_.scalar_begin(); b < layout_.size(); ++b)
      note(layout_.unknown(a), layout_.unknown(b));
  thin();

  std::vector<int> sizes;
  for (const auto& rows : columns) sizes.push_back(static_cast<int>(rows.size()));
  pattern_.resize(layout_.unknowns(), layout_.unknowns());
  pattern_.reserve(sizes);
  for (std::size_t column = 0; column < columns.size(); ++column)
    for (const int row : columns[column]) pattern_.insert(row, static_cast<int>(column)) = 0;
  pattern_.makeCompressed();

  const auto place = [this](int row, int column) {
    const int* begin = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column];
    const int* end = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column + 1];
    return static_cast<int>(std::lower_bound(begin, end, row) - pattern_.innerIndexPtr());
  };
  for (auto& t : blood_targets_) t.places = find_places<BloodTangent>(t.numbers, place);
  for (auto& t : wall_targets_) t.places = find_places<WallTangent>(t.numbers, place);
  for (auto& t : side_targets_) t.places = find_places<SideTangent>(t.numbers, place);
}

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

namespace {

BloodNodes blood_nodes(const Problem& problem, const Layout& layout, const Cell& cell, const Stage& stage,
                       std::span<const double> y) {
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

WallNodes wall_nodes(const Problem& problem, const Layout& layout, const Cell& cell, const Stage& stage,
                     std::span<const double> y) {
  WallNodes nodes;
  for (int c = 0; c < 2; ++c)
    for (int k = 0; k < counts(problem.mesh.shape, problem.discretisation.element).displacement; ++k) {
      nodes.displacement.value[c][k] = y[layout.displacement(cell.nodes[k], c)];
      nodes.acceleration.value[c][k] = rate(stage, y, layout.velocity(cell.nodes[k], c));
    }
  return nodes;
}

SideNodes side_nodes(const Layout& layout, const SideTable& side, const Stage& stage,
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

kernel::BloodParameters blood_parameters(const Problem& problem, const BloodTable& table,
                                         const Stage& stage) {
  kernel::BloodParameters parameters{problem.blood, stage.coefficient, 1.0, 0.0};
  if (problem.discretisation.stiffened_mesh) parameters.mesh_stiffness = 1 / (table.size * table.size);
  if (problem.discretisation.element == Element::linear) parameters.stabilised_size = table.size;
  return parameters;
}

kernel::WallParameters wall_parameters(const Problem& problem, const WallTable& table, const Stage& stage) {
  return {&problem.laws[table.layer], problem.wall_density, stage.coefficient, table.pressure_terms};
}

}  // namespace

double Assembler::pressure_on(const SideTable& side, const Stage& stage, std::span<const double> y) const {
  if (const auto entry = pressure_entry(side.boundary)) return y[*entry];
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
  // On few cells waiting for each other takes threads longer than the work.
  const bool share = blood_count + wall_count > 1000;
#pragma omp parallel if (share)
  {
#pragma omp for schedule(static) nowait
    for (int k = 0; k < blood_count; ++k) {
      const BloodTable& table = tables_.blood[k];
      const auto nodes = blood_nodes(problem_, layout_, problem_.mesh.cells[table.cell], stage, y);
      const auto parameters = blood_parameters(problem_, table, stage);
      for (const auto& at : table.points) kernel::add_blood_residual(parameters, at, nodes, blood[k]);
    }
#pragma omp for schedule(static)
    for (int k = 0; k < wall_count; ++k) {
      const WallTable& table = tables_.wall[k];
      const auto nodes = wall_nodes(problem_, layout_, problem_.mesh.cells[table.cell], stage, y);
      kernel::add_wall_residual(wall_parameters(problem_, table, stage), table.points, nodes, wall[k]);
    }
  }
  std::fill(residual.begin(), residual.end(), 0.0);
  least_ = {};
  const auto watch = [this](double jacobian, int cell) {
    if (jacobian < least_.value || std::isnan(jacobian)) least_ = {jacobian, cell};
  };
  for (int k = 0; k < blood_count; ++k) {
    const Numbers& n = blood_targets_[k].numbers;
    add_rows(blood[k].momentum, n.momentum, residual);
    add_rows(blood[k].mesh, n.mesh, residual);
    for (int i = 0; i < cell_width; ++i)
      if (n.continuity[i] >= 0) residual[n.continuity[i]] += blood[k].continuity[i];
    watch(blood[k].least_jacobian, tables_.blood[k].cell);
  }
  for (int k = 0; k < wall_count; ++k) {
    add_rows(wall[k].momentum, wall_targets_[k].numbers.momentum, residual);
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
    if (!is_loaded(side)) continue;
    SideNodes nodes = side_nodes(layout_, side, stage, y);
    nodes.pressure = pressure_on(side, stage, y);
    SideResidual result;
    for (const auto& at : side.points)
      kernel::add_side_residual(BoundaryTerms{problem_, side.boundary}, at, nodes, result);
    add_rows(result.momentum, side_targets_[s].numbers.momentum, residual);
    for (const ScalarRow& row : scalar_rows(side.boundary))
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
        const Numbers& n = blood_targets_[k].numbers;
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
        apply(loads.wall_force, at.weight, at.place, at.displacement, wall_targets_[k].numbers.momentum);
  if (!loads.traction) return;
  for (std::size_t s = 0; s < tables_.sides.size(); ++s) {
    const SideTable& side = tables_.sides[s];
    for (const auto& at : side.points) {
      kernel::NodalVector<Frame, side_width> nodal;
      kernel::test_vector(-at.weight, loads.traction(at.place, time, side.boundary), Tensor<double>{},
                          at.shapes, nodal);
      add_rows(nodal, side_targets_[s].numbers.momentum, residual);
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
#pragma omp parallel for schedule(dynamic, 4)
    for (int k = first; k < last; ++k) {
      const BloodTable& table = tables_.blood[k];
      const auto nodes = blood_nodes(problem_, layout_, problem_.mesh.cells[table.cell], stage, y);
      const auto parameters = blood_parameters(problem_, table, stage);
      BloodTangent& t = blood[k - first];
      t = {};
      for (const auto& at : table.points) kernel::add_blood_tangent(parameters, at, nodes, t);
    }
    for (int k = first; k < last; ++k)
      scatter(blood[k - first], blood_targets_[k].numbers, blood_targets_[k].places, c, values);
  }
  std::vector<WallTangent> wall(batch);
  for (int first = 0; first < wall_count; first += batch) {
    const int last = std::min(first + batch, wall_count);
#pragma omp parallel for schedule(dynamic, 4)
    for (int k = first; k < last; ++k) {
      const WallTable& table = tables_.wall[k];
      const auto nodes = wall_nodes(problem_, layout_, problem_.mesh.cells[table.cell], stage, y);
      WallTangent& t = wall[k - first];
      t = {};
      kernel::add_wall_tangent(wall_parameters(problem_, table, stage), table.points, nodes, t);
    }
    for (int k = first; k < last; ++k)
      scatter(wall[k - first], wall_targets_[k].numbers, wall_targets_[k].places, c, values);
  }
  for (std::size_t s = 0; s < tables_.sides.size(); ++s) {
    const SideTable& side = tables_.sides[s];
    if (!is_loaded(side)) continue;
    SideNodes nodes = side_nodes(layout_, side, stage, y);
    nodes.pressure = pressure_on(side, stage, y);
    SideTangent t;
    for (const auto& at : side.points)
      kernel::add_side_tangent(BoundaryTerms{problem_, side.boundary}, c, at, nodes, t);
    const Numbers& n = side_targets_[s].numbers;
    scatter(t, n, side_targets_[s].places, c, values);
    const auto pressure = pressure_entry(side.boundary);
    const auto rows = scalar_rows(side.boundary);
    for (int b = 0; b < 2; ++b)
      for (int k = 0; k < side.count; ++k) {
        if (pressure && n.momentum[b][k] >= 0)
          matrix.coeffRef(n.momentum[b][k], layout_.unknown(*pressure)) += t.momentum_pressure.value[b][k];
        for (const ScalarRow& row : rows) {
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
