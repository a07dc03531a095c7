// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/assembler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "axisym/gather.hpp"
#include "core/coupled/openings.hpp"
#include "core/error.hpp"

namespace tunica::axisym {

namespace {

using BloodResidual = kernel::BloodResidual<Frame, cell_width>;
using WallResidual = kernel::WallResidual<Frame, cell_width>;
using SideResidual = kernel::SideResidual<Frame, side_width>;

using BoundaryTerms = coupled::BoundaryTerms<2>;
using coupled::add_rows;

/// On fewer cells a residual takes less than a millisecond, and threads are not worth their making.
constexpr int least_shared_cells = 500;

/// Tables of the cells, and of the sides that have something to do.
Tables needed_tables(const Problem& problem) {
  Tables tables = tabulate(problem);
  const bool coupled = problem.mesh.has(Part::blood) && problem.mesh.has(Part::wall);
  std::erase_if(tables.sides, [&](const SideTable& side) {
    const bool is_opening = side.boundary == Boundary::inlet || side.boundary == Boundary::outlet;
    const bool is_second_of_two = coupled && side.boundary == Boundary::interface && !side.of_wall;
    const bool is_pressed =
        coupled::is_loaded(problem, side.boundary, side.of_wall && !problem.mesh.has(Part::blood));
    return !is_opening && !is_pressed && (!problem.loads.traction || is_second_of_two);
  });
  return tables;
}

}  // namespace

Assembler::Assembler(const Problem& problem, int threads)
    : problem_(problem),
      threads_(static_cast<int>(problem.mesh.cells.size()) < least_shared_cells ? 1 : threads),
      layout_(layout_of(problem)),
      tables_(needed_tables(problem)),
      map_(problem, layout_, tables_) {}

bool Assembler::is_loaded(const SideTable& side) const {
  return coupled::is_loaded(problem_, side.boundary, side.of_wall && !has_blood());
}

void Assembler::complete(const Stage& stage, std::span<double> y) const {
  coupled::complete(problem_, layout_, problem_.mesh.points, Frame::axes, stage, y);
}

bool Assembler::residual_of(const Parts& parts, const Stage& stage, std::span<const double> y,
                            std::span<double> residual) const {
  const int blood_count = parts.blood ? static_cast<int>(tables_.blood.size()) : 0;
  const int wall_count = parts.wall ? static_cast<int>(tables_.wall.size()) : 0;
  std::vector<BloodResidual> blood(blood_count);
  std::vector<WallResidual> wall(wall_count);
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
    const CellNumbers& n = map_.blood()[k].numbers;
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
  coupled::add_scalars(problem_.inlet, problem_.outlet, layout_, stage, y, residual);
  add_loads(stage.time, residual);
  return std::all_of(residual.begin(), residual.end(), [](double r) { return std::isfinite(r); });
}

void Assembler::add_sides(const Stage& stage, std::span<const double> y, std::span<double> residual) const {
  for (std::size_t s = 0; s < tables_.sides.size(); ++s) {
    const SideTable& side = tables_.sides[s];
    if (!is_loaded(side)) continue;
    SideNodes nodes = side_nodes(layout_, side, stage, y);
    nodes.pressure = coupled::pressure_on(problem_, layout_, side.boundary, stage.time, y);
    SideResidual result;
    for (const auto& at : side.points)
      kernel::add_side_residual(BoundaryTerms{problem_, side.boundary}, at, nodes, result);
    add_rows(result.momentum, map_.sides()[s].numbers.momentum, residual);
    for (const auto& row : coupled::scalar_rows(layout_, problem_, side.boundary))
      residual[layout_.unknown(row.entry)] += row.factor * result.flow;
  }
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
        const CellNumbers& n = map_.blood()[k].numbers;
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
      auto parameters = blood_parameters(problem_, table, stage);
      parameters.mesh_is_given = !coupled::has_displacement(map_.blood()[k].numbers);
      BloodTangent& t = blood[index];
      t = {};
      for (const auto& at : table.points) kernel::add_blood_tangent(parameters, at, nodes, t);
      coupled::share_columns(map_.blood()[k].numbers, t);
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
    if (!is_loaded(side)) continue;
    SideNodes nodes = side_nodes(layout_, side, stage, y);
    nodes.pressure = coupled::pressure_on(problem_, layout_, side.boundary, stage.time, y);
    SideTangent t;
    for (const auto& at : side.points)
      kernel::add_side_tangent(BoundaryTerms{problem_, side.boundary}, c, at, nodes, t);
    const SideNumbers& n = map_.sides()[s].numbers;
    coupled::share_columns(n, t);
    scatter(t, map_.sides()[s], c, values);
    const auto pressure = coupled::pressure_entry(layout_, side.boundary);
    const auto rows = coupled::scalar_rows(layout_, problem_, side.boundary);
    for (int b = 0; b < 2; ++b)
      for (int k = 0; k < side.count; ++k) {
        if (pressure && n.momentum[b][k] >= 0)
          matrix.coeffRef(n.momentum[b][k], layout_.unknown(*pressure)) += t.momentum_pressure.value[b][k];
        for (const auto& row : rows) {
          const int r = layout_.unknown(row.entry);
          if (n.velocity[b][k] >= 0)
            matrix.coeffRef(r, n.velocity[b][k]) +=
                row.factor * (n.adheres[k] ? c : 1.0) * t.flow_velocity.value[b][k];
          if (n.displacement[b][k] >= 0)
            matrix.coeffRef(r, n.displacement[b][k]) += row.factor * t.flow_displacement.value[b][k];
        }
      }
  }
  for (const auto& entry : coupled::scalar_tangent(problem_.outlet, layout_, c))
    matrix.coeffRef(entry.row, entry.column) += entry.value;
}

void Assembler::follow(double time, std::span<double> y) const {
  // Shares of the wall's displacement are complete.
  if (layout_.followers().empty()) return;
  const auto nodes = [&](int cell) {
    return CellNodes(problem_.mesh, problem_.discretisation.element, problem_.mesh.cells[cell]);
  };
  if (!follower_) {
    follower_ = std::make_unique<Follower>(layout_);
    for (const BloodTable& table : tables_.blood)
      follower_->extension.add(nodes(table.cell).displacement(),
                               blood_parameters(problem_, table, {}).mesh_stiffness,
                               std::span<const BloodPoint>(table.points));
    follower_->extension.finish();
    follower_->factors.compute(follower_->extension.among());
    if (follower_->factors.info() != Eigen::Success)
      throw SolverFailure(
          "the motion of the mesh in the blood has no factors; take solver.geometry = \"implicit\"");
  }
  std::vector<double> loads(layout_.followers().size(), 0.0);
  if (problem_.loads.mesh_force)
    for (const BloodTable& table : tables_.blood)
      for (const auto& at : table.points)
        follower_->extension.add_load(nodes(table.cell).displacement(), at,
                                      problem_.loads.mesh_force(at.place, time), loads);
  follower_->extension.extend(
      loads,
      [&](std::span<double> b) {
        Eigen::Map<Eigen::VectorXd> right(b.data(), static_cast<Eigen::Index>(b.size()));
        right = follower_->factors.solve(right).eval();
      },
      y);
}

coupled::Throughflow Assembler::flow(const Stage& stage, std::span<const double> y, Boundary boundary) const {
  coupled::Throughflow sum;
  for (const SideTable& side : tables_.sides) {
    if (side.boundary != boundary) continue;
    const SideNodes nodes = side_nodes(layout_, side, stage, y);
    SideResidual result;
    for (const auto& at : side.points)
      kernel::add_side_residual(BoundaryTerms{problem_, boundary}, at, nodes, result);
    sum.add(result.flow, result.leaving);
  }
  return sum;
}

namespace {

/// Factors of the derivative, whose pattern stays.
class FactorisedTangent final : public coupled::TangentSolver {
 public:
  explicit FactorisedTangent(const Assembler& assembler)
      : assembler_(assembler), matrix_(assembler.pattern()) {}

  bool factorise(const Stage& stage, std::span<const double> y) override {
    assembler_.tangent(stage, y, matrix_);
    return solver_.factorise(matrix_);
  }
  bool solve(std::span<double> right_hand_side) override {
    solver_.solve(right_hand_side);
    return true;
  }
  void forget() override { solver_.forget(); }
  double entries() const override { return solver_.entries(); }

 private:
  const Assembler& assembler_;
  SparseMatrix matrix_;
  DirectSolver solver_;
};

}  // namespace

std::unique_ptr<coupled::TangentSolver> Assembler::tangent_solver() const {
  return std::make_unique<FactorisedTangent>(*this);
}

std::vector<double> Assembler::volume_shares() const {
  const Mesh& mesh = problem_.mesh;
  std::vector<double> shares(mesh.points.size(), 0.0);
  const int count = counts(mesh.shape, problem_.discretisation.element).displacement;
  const auto add = [&](const auto& tables) {
    for (const auto& table : tables)
      for (const auto& point : table.points)
        for (int k = 0; k < count; ++k)
          shares[mesh.cells[table.cell].nodes[k]] += point.weight * point.displacement.lift[0][k];
  };
  if (has_wall())
    add(tables_.wall);
  else
    add(tables_.blood);
  const double whole = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= whole;
  return shares;
}

namespace {

std::string place_of(const Mesh& mesh, int cell, int node) {
  return fmt::format("r = {:.4g}, z = {:.4g} cm (cell {} of {})", mesh.points[node][0], mesh.points[node][1],
                     cell, mesh.cells.size());
}

/// A wall that bulges or caves in beside an end that is held leans over it.
bool beside_clamped_end(const Problem& problem, const Point& place) {
  const Extent ends = extent(problem.mesh);
  const double near = 2 * inlet_radius(problem.mesh);
  return problem.on(Boundary::wall_inlet).displacement[0] &&
         (place[1] < ends.inlet + near || place[1] > ends.outlet - near);
}

}  // namespace

std::string Assembler::place_of_node(int node) const {
  const Mesh& mesh = problem_.mesh;
  const auto cell = std::find_if(mesh.cells.begin(), mesh.cells.end(), [&](const Cell& c) {
    return std::find(c.nodes.begin(), c.nodes.end(), node) != c.nodes.end();
  });
  return place_of(mesh, static_cast<int>(cell - mesh.cells.begin()), node);
}

std::string Assembler::compression(const LeastJacobian& least) const {
  const Mesh& mesh = problem_.mesh;
  const Cell& cell = mesh.cells[least.cell];
  const bool blood = cell.part == Part::blood;
  const int centre = cell.nodes[mesh.centre_node()];
  std::string text = fmt::format(
      "; the {} is {} at {}", blood ? "blood's mesh" : "wall",
      least.value > 0 ? fmt::format("compressed to J = {:.2g}", least.value) : "turned inside out",
      place_of(mesh, least.cell, centre));
  if (!blood) return text;
  if (beside_clamped_end(problem_, mesh.points[centre]))
    return text + ", beside a clamped end; geometry.ends = \"sliding\" bears more";
  return problem_.discretisation.motion == coupled::MeshMotion::harmonic
             ? text + "; mesh.motion = \"stiffened\" may bear more"
             : text;
}

}  // namespace tunica::axisym
