// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/cell_work.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/coupled/numbers.hpp"
#include "core/coupled/openings.hpp"
#include "core/threads.hpp"
#include "full3d/condensation.hpp"
#include "full3d/tables.hpp"

namespace tunica::full3d {

namespace {

using coupled::Stage;
using element::solid::shape_count;

/// Cells and faces are computed side by side in batches and added in their order, so that sums do not
/// depend on threads.
constexpr int residual_batch = 4096, tangent_batch = 64;

void watch(double jacobian, int cell, LeastJacobian& least) {
  if (jacobian < least.value || std::isnan(jacobian)) least = {jacobian, cell};
}

template <int Width, int SideWidth>
class Work final : public CellWork {
 public:
  using BloodTangent = kernel::BloodTangent<Frame, Width>;
  using WallTangent = kernel::WallTangent<Frame, Width>;
  using SideTangent = kernel::SideTangent<Frame, SideWidth>;
  using CellNumbers = coupled::Numbers<Frame, Width>;
  using SideNumbers = coupled::Numbers<Frame, SideWidth>;

  Work(const Problem& problem, const Layout& layout, const std::vector<int>& cells, int threads,
       bool condense)
      : problem_(problem), layout_(layout), tables_(problem), threads_(threads) {
    const Mesh& mesh = problem.mesh;
    const Element element = problem.discretisation.element;
    const Basis moving = displacement_basis(element), flowing = velocity_basis(element);
    std::vector<bool> mine(mesh.cells.size(), false);
    for (const int cell : cells) {
      mine[cell] = true;
      Nodes nodes{cell, {}, {}, {}};
      for (int k = 0; k < shape_count(mesh.shape, moving); ++k)
        nodes.displacement.push_back(mesh.node(cell, moving, k));
      if (mesh.cells[cell].part == Part::wall) {
        wall_.push_back(std::move(nodes));
        continue;
      }
      for (int k = 0; k < shape_count(mesh.shape, flowing); ++k)
        nodes.velocity.push_back(mesh.node(cell, flowing, k));
      for (int k = 0; k < shape_count(mesh.shape, Basis::linear); ++k)
        nodes.pressure.push_back(mesh.node(cell, Basis::linear, k));
      blood_.push_back(std::move(nodes));
    }
    if (condense && element == Element::bubble)
      for (const Nodes& cell : blood_)
        bubbles_.emplace_back(coupled::blood_numbers<Frame, Width>(layout_, cell.fields()),
                              shape_count(mesh.shape, Basis::linear));
    const bool coupled_parts = mesh.has(Part::blood) && mesh.has(Part::wall);
    for (const Face& face : mesh.faces) {
      if (!mine[face.cell]) continue;
      const bool of_wall = mesh.cells[face.cell].part == Part::wall;
      const bool is_opening = face.boundary == Boundary::inlet || face.boundary == Boundary::outlet;
      const bool loaded = coupled::is_loaded(problem, face.boundary, of_wall && !coupled_parts);
      const bool is_second_of_two = coupled_parts && face.boundary == Boundary::interface && !of_wall;
      if (!is_opening && !loaded && (!problem.loads.traction || is_second_of_two)) continue;
      Side side{face, loaded, {}};
      for (const int k : element::solid::face_nodes(mesh.shape, moving, face.face))
        side.nodes.push_back(mesh.node(face.cell, moving, k));
      sides_.push_back(std::move(side));
    }
  }

  LeastJacobian residual(const LoadedStage& at, std::span<const double> y,
                         std::span<double> residual) const override {
    LeastJacobian least;
    in_batches<kernel::BloodResidual<Frame, Width>>(
        blood_, residual_batch,
        [&](const Nodes& cell, auto& result) {
          static thread_local std::vector<typename Tables<Width, SideWidth>::BloodPoint> points;
          tables_.blood(cell.cell, points);
          const auto nodes = coupled::blood_nodes<Frame, Width>(layout_, cell.fields(), at.stage, y);
          auto parameters = blood_parameters(points, at.stage);
          for (const auto& point : points) {
            if (problem_.sections) parameters.sections = problem_.sections(point.place);
            kernel::add_blood_residual(parameters, point, nodes, result);
          }
        },
        [&](const Nodes& cell, const auto& result) {
          const auto n = coupled::blood_numbers<Frame, Width>(layout_, cell.fields());
          coupled::add_rows(result.momentum, n.momentum, residual);
          coupled::add_rows(result.mesh, n.mesh, residual);
          for (int i = 0; i < Width; ++i)
            if (n.continuity[i] >= 0) residual[n.continuity[i]] += result.continuity[i];
          watch(result.least_jacobian, cell.cell, least);
        });
    in_batches<kernel::WallResidual<Frame, Width>>(
        wall_, residual_batch,
        [&](const Nodes& cell, auto& result) {
          static thread_local std::vector<typename Tables<Width, SideWidth>::WallPoint> points;
          tables_.wall(cell.cell, points);
          const auto nodes = coupled::wall_nodes<Frame, Width>(layout_, cell.displacement, at.stage, y);
          kernel::add_wall_residual(wall_parameters(cell.cell, at.stage), points, nodes, result);
        },
        [&](const Nodes& cell, const auto& result) {
          const auto n = coupled::wall_numbers<Frame, Width>(layout_, cell.displacement);
          coupled::add_rows(result.momentum, n.momentum, residual);
          watch(result.least_jacobian, cell.cell, least);
        });
    std::vector<typename Tables<Width, SideWidth>::SidePoint> points;
    for (const Side& side : sides_) {
      if (!side.loaded) continue;
      tables_.side(side.face, points);
      const auto nodes = side_nodes(side, at, y);
      kernel::SideResidual<Frame, SideWidth> result;
      for (const auto& point : points)
        kernel::add_side_residual(terms(side.face.boundary), point, nodes, result);
      coupled::add_rows(result.momentum, numbers(side).momentum, residual);
      for (const auto& row : coupled::scalar_rows(layout_, problem_, side.face.boundary))
        residual[layout_.unknown(row.entry)] += row.factor * result.flow;
    }
    return least;
  }

  std::vector<MatrixPlace> pattern() const override {
    std::vector<MatrixPlace> places;
    const auto note = [&](int row, int column) {
      if (row >= 0 && column >= 0) places.push_back({row, column});
    };
    for (const auto& bubble : bubbles_) bubble.visit_places(note);
    if (bubbles_.empty())
      for (const Nodes& cell : blood_)
        coupled::visit_places<BloodTangent>(coupled::blood_numbers<Frame, Width>(layout_, cell.fields()),
                                            note);
    for (const Nodes& cell : wall_)
      coupled::visit_places<WallTangent>(coupled::wall_numbers<Frame, Width>(layout_, cell.displacement),
                                         note);
    for (const Side& side : sides_) {
      if (!side.loaded) continue;
      const SideNumbers n = numbers(side);
      coupled::visit_places<SideTangent>(n, note);
      visit_scalars(side, n, SideTangent{}, 1, [&](int row, int column, double) { note(row, column); });
    }
    return places;
  }

  void tangent(const LoadedStage& at, std::span<const double> y, std::span<double> values) override {
    const double c = at.stage.coefficient;
    double* next = values.data();
    const auto put = [&](int row, int column, double value) {
      if (row >= 0 && column >= 0) *next++ = value;
    };
    struct BloodEntries {
      BloodTangent tangent;
      std::vector<double> condensed;
    };
    const bool condenses = !bubbles_.empty();
    in_batches<BloodEntries>(
        blood_, tangent_batch,
        [&](const Nodes& cell, BloodEntries& result) {
          static thread_local std::vector<typename Tables<Width, SideWidth>::BloodPoint> points;
          tables_.blood(cell.cell, points);
          const auto nodes = coupled::blood_nodes<Frame, Width>(layout_, cell.fields(), at.stage, y);
          auto parameters = blood_parameters(points, at.stage);
          parameters.mesh_is_given =
              !coupled::has_displacement(coupled::blood_numbers<Frame, Width>(layout_, cell.fields()));
          for (const auto& point : points) {
            if (problem_.sections) parameters.sections = problem_.sections(point.place);
            kernel::add_blood_tangent(parameters, point, nodes, result.tangent);
          }
          if (condenses)
            bubbles_[&cell - blood_.data()].take(result.tangent, c,
                                                 [&](double entry) { result.condensed.push_back(entry); });
        },
        [&](const Nodes& cell, const BloodEntries& result) {
          if (condenses)
            next = std::copy(result.condensed.begin(), result.condensed.end(), next);
          else
            coupled::visit_entries(result.tangent,
                                   coupled::blood_numbers<Frame, Width>(layout_, cell.fields()), c, put);
        });
    in_batches<WallTangent>(
        wall_, tangent_batch,
        [&](const Nodes& cell, WallTangent& result) {
          static thread_local std::vector<typename Tables<Width, SideWidth>::WallPoint> points;
          tables_.wall(cell.cell, points);
          const auto nodes = coupled::wall_nodes<Frame, Width>(layout_, cell.displacement, at.stage, y);
          kernel::add_wall_tangent(wall_parameters(cell.cell, at.stage), points, nodes, result);
        },
        [&](const Nodes& cell, const WallTangent& result) {
          coupled::visit_entries(result, coupled::wall_numbers<Frame, Width>(layout_, cell.displacement), c,
                                 put);
        });
    std::vector<typename Tables<Width, SideWidth>::SidePoint> points;
    for (const Side& side : sides_) {
      if (!side.loaded) continue;
      tables_.side(side.face, points);
      const auto nodes = side_nodes(side, at, y);
      SideTangent result;
      for (const auto& point : points)
        kernel::add_side_tangent(terms(side.face.boundary), c, point, nodes, result);
      const SideNumbers n = numbers(side);
      coupled::visit_entries(result, n, c, put);
      visit_scalars(side, n, result, c, put);
    }
  }

  std::vector<int> condensed() const override {
    std::vector<int> unknowns;
    for (const auto& bubble : bubbles_)
      unknowns.insert(unknowns.end(), bubble.inner().begin(), bubble.inner().end());
    return unknowns;
  }
  void condense(std::span<const double> right, std::span<double> change) const override {
    for (const auto& bubble : bubbles_) bubble.condense(right, change);
  }
  void recover(std::span<const double> right, std::span<double> solution) const override {
    for (const auto& bubble : bubbles_) bubble.recover(right, solution);
  }

  void add_loads(double time, std::span<double> residual) const override {
    const auto& loads = problem_.loads;
    const auto apply = [&](const auto& force, double weight, const auto& shapes, const auto& rows) {
      kernel::NodalVector<Frame, std::tuple_size_v<std::remove_cvref_t<decltype(rows[0])>>> nodal;
      kernel::test_vector(-weight, force, Tensor<double>{}, shapes, nodal);
      coupled::add_rows(nodal, rows, residual);
    };
    if (loads.blood_force || loads.mesh_force || loads.blood_volume)
      for (const Nodes& cell : blood_) {
        std::vector<typename Tables<Width, SideWidth>::BloodPoint> points;
        tables_.blood(cell.cell, points);
        const auto n = coupled::blood_numbers<Frame, Width>(layout_, cell.fields());
        for (const auto& at : points) {
          if (loads.blood_force) apply(loads.blood_force(at.place, time), at.weight, at.velocity, n.momentum);
          if (loads.mesh_force) apply(loads.mesh_force(at.place, time), at.weight, at.displacement, n.mesh);
          if (!loads.blood_volume) continue;
          const double volume = at.weight * loads.blood_volume(at.place, time);
          for (int i = 0; i < Width; ++i)
            if (n.continuity[i] >= 0) residual[n.continuity[i]] -= volume * at.pressure.lift[0][i];
        }
      }
    if (loads.wall_force)
      for (const Nodes& cell : wall_) {
        std::vector<typename Tables<Width, SideWidth>::WallPoint> points;
        tables_.wall(cell.cell, points);
        const auto n = coupled::wall_numbers<Frame, Width>(layout_, cell.displacement);
        for (const auto& at : points)
          apply(loads.wall_force(at.place, time), at.weight, at.displacement, n.momentum);
      }
    if (!loads.traction) return;
    for (const Side& side : sides_) {
      std::vector<typename Tables<Width, SideWidth>::SidePoint> points;
      tables_.side(side.face, points);
      const SideNumbers n = numbers(side);
      for (const auto& at : points)
        apply(loads.traction(at.place, time, side.face.boundary), at.weight, at.shapes, n.momentum);
    }
  }

  void add_mesh(coupled::MeshExtension& extension) const override {
    std::vector<typename Tables<Width, SideWidth>::BloodPoint> points;
    for (const Nodes& cell : blood_) {
      tables_.blood(cell.cell, points);
      extension.add(cell.fields().displacement, blood_parameters(points, {}).mesh_stiffness,
                    std::span<const typename Tables<Width, SideWidth>::BloodPoint>(points));
    }
  }
  void add_mesh_loads(double time, const coupled::MeshExtension& extension,
                      std::span<double> loads) const override {
    const auto& force = problem_.loads.mesh_force;
    if (!force) return;
    std::vector<typename Tables<Width, SideWidth>::BloodPoint> points;
    for (const Nodes& cell : blood_) {
      tables_.blood(cell.cell, points);
      for (const auto& at : points)
        extension.add_load(cell.fields().displacement, at, force(at.place, time), loads);
    }
  }

  coupled::Throughflow flow(const Stage& stage, std::span<const double> y, Boundary boundary) const override {
    coupled::Throughflow sum;
    std::vector<typename Tables<Width, SideWidth>::SidePoint> points;
    for (const Side& side : sides_) {
      if (side.face.boundary != boundary) continue;
      tables_.side(side.face, points);
      const auto nodes = coupled::side_nodes<Frame, SideWidth>(layout_, side.nodes, stage, y);
      kernel::SideResidual<Frame, SideWidth> result;
      for (const auto& point : points) kernel::add_side_residual(terms(boundary), point, nodes, result);
      sum.add(result.flow, result.leaving);
    }
    return sum;
  }

  void add_volumes(Part part, std::span<double> volumes) const override {
    const auto add = [&](const auto& points, const Nodes& cell) {
      for (const auto& point : points)
        for (std::size_t k = 0; k < cell.displacement.size(); ++k)
          volumes[cell.displacement[k]] += point.weight * point.displacement.lift[0][k];
    };
    std::vector<typename Tables<Width, SideWidth>::BloodPoint> blood;
    std::vector<typename Tables<Width, SideWidth>::WallPoint> wall;
    for (const Nodes& cell : part == Part::blood ? blood_ : wall_) {
      if (part == Part::blood) {
        tables_.blood(cell.cell, blood);
        add(blood, cell);
      } else {
        tables_.wall(cell.cell, wall);
        add(wall, cell);
      }
    }
  }

  void add_blood_volumes(std::span<double> velocity, std::span<double> pressure) const override {
    std::vector<typename Tables<Width, SideWidth>::BloodPoint> points;
    for (const Nodes& cell : blood_) {
      tables_.blood(cell.cell, points);
      double volume = 0, sum = 0;
      std::array<double, Width> squares{};
      for (const auto& point : points) {
        volume += point.weight;
        for (std::size_t k = 0; k < cell.velocity.size(); ++k) {
          const double square = point.weight * point.velocity.lift[0][k] * point.velocity.lift[0][k];
          squares[k] += square;
          sum += square;
        }
        for (std::size_t k = 0; k < cell.pressure.size(); ++k)
          pressure[cell.pressure[k]] += point.weight * point.pressure.lift[0][k];
      }
      for (std::size_t k = 0; k < cell.velocity.size(); ++k)
        velocity[cell.velocity[k]] += volume * squares[k] / sum;
    }
  }

 private:
  /// Nodes of a cell by the fields of its part.
  struct Nodes {
    int cell;
    std::vector<int> displacement, velocity, pressure;
    coupled::BloodCellNodes fields() const { return {displacement, velocity, pressure}; }
  };
  struct Side {
    Face face;
    bool loaded;
    std::vector<int> nodes;
  };

  template <class Result, class Compute, class Add>
  void in_batches(const std::vector<Nodes>& cells, int batch, const Compute& compute, const Add& add) const {
    const int count = static_cast<int>(cells.size());
    std::vector<Result> results(std::min(count, batch));
    for (int first = 0; first < count; first += batch) {
      const int last = std::min(first + batch, count);
      for_each_index(threads_, last - first, [&](int index) {
        results[index] = {};
        compute(cells[first + index], results[index]);
      });
      for (int k = first; k < last; ++k) add(cells[k], results[k - first]);
    }
  }

  coupled::BoundaryTerms<3> terms(Boundary boundary) const { return {problem_, boundary}; }
  SideNumbers numbers(const Side& side) const {
    return coupled::side_numbers<Frame, SideWidth>(layout_, side.nodes);
  }
  kernel::SideNodes<Frame, SideWidth> side_nodes(const Side& side, const LoadedStage& at,
                                                 std::span<const double> y) const {
    auto nodes = coupled::side_nodes<Frame, SideWidth>(layout_, side.nodes, at.stage, y);
    nodes.pressure = at.pressure[static_cast<std::size_t>(side.face.boundary)];
    return nodes;
  }

  /// Entries of a side in the column of its pressure and in the rows of the scalars.
  template <class Visit>
  void visit_scalars(const Side& side, const SideNumbers& n, const SideTangent& t, double c,
                     const Visit& visit) const {
    const auto pressure = coupled::pressure_entry(layout_, side.face.boundary);
    const auto rows = coupled::scalar_rows(layout_, problem_, side.face.boundary);
    for (int b = 0; b < 3; ++b)
      for (std::size_t k = 0; k < side.nodes.size(); ++k) {
        if (pressure) visit(n.momentum[b][k], layout_.unknown(*pressure), t.momentum_pressure.value[b][k]);
        for (const auto& row : rows) {
          const int r = layout_.unknown(row.entry);
          visit(r, n.velocity[b][k], row.factor * (n.adheres[k] ? c : 1.0) * t.flow_velocity.value[b][k]);
          visit(r, n.displacement[b][k], row.factor * t.flow_displacement.value[b][k]);
        }
      }
  }

  template <class Points>
  kernel::BloodParameters blood_parameters(const Points& points, const Stage& stage) const {
    kernel::BloodParameters parameters{problem_.blood, stage.coefficient, 1.0, {}, 0.0};
    const double size = tables_.size(points);
    if (problem_.discretisation.motion == coupled::MeshMotion::stiffened)
      parameters.mesh_stiffness = 1 / (size * size);
    if (problem_.discretisation.element == Element::linear) parameters.stabilised_size = size;
    return parameters;
  }
  kernel::WallParameters wall_parameters(int cell, const Stage& stage) const {
    return {&problem_.laws[problem_.mesh.cells[cell].layer], problem_.wall_density, stage.coefficient,
            tables_.pressure_terms(cell), stage.wall_pressure_bound};
  }

  const Problem& problem_;
  const Layout& layout_;
  Tables<Width, SideWidth> tables_;
  int threads_;
  std::vector<Nodes> blood_, wall_;
  std::vector<Side> sides_;
  std::vector<CondensedCell<Frame, Width>> bubbles_;  ///< of the blood cells
};

}  // namespace

std::unique_ptr<CellWork> cell_work(const Problem& problem, const Layout& layout,
                                    const std::vector<int>& cells, int threads, bool condense) {
  const bool quadratic = problem.discretisation.element == Element::quadratic;
  if (problem.mesh.shape == Shape::hexahedron && quadratic)
    return std::make_unique<Work<28, 12>>(problem, layout, cells, threads, condense);
  if (quadratic) return std::make_unique<Work<12, 8>>(problem, layout, cells, threads, condense);
  return std::make_unique<Work<8, 4>>(problem, layout, cells, threads, condense);
}

double relative_cost(const Problem& problem, int cell) {
  // Measured on quadratic hexahedra: docs/verification/full3d.md.
  const Cell& c = problem.mesh.cells[cell];
  if (c.part == Part::blood) return 1;
  return has_front(problem.laws[c.layer]) ? 0.7 : 0.4;
}

}  // namespace tunica::full3d
