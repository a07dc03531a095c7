// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/wall_axes.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <optional>

#include "axisym/tables.hpp"
#include "core/error.hpp"

namespace tunica::axisym {

namespace {

/// phi on an end face of the wall, nothing on other boundaries.
std::optional<double> prescribed(Boundary boundary) {
  if (boundary == Boundary::wall_inlet) return 0.0;
  if (boundary == Boundary::wall_outlet) return 1.0;
  return {};
}

/// All surfaces of the wall are cylinders and its end faces planes z = const, but for the rounding of
/// coordinates.
bool is_straight(const Mesh& mesh) {
  constexpr double tilt = 1e-9;
  for (const Edge& edge : mesh.edges) {
    if (mesh.cells[edge.cell].part != Part::wall) continue;
    const int constant = prescribed(edge.boundary) ? 1 : 0;  // z or r
    const auto nodes = mesh.side_nodes(edge.cell, edge.side);
    const Point &first = mesh.points[nodes[0]], &second = mesh.points[nodes[1]];
    const double length = std::hypot(second[0] - first[0], second[1] - first[1]);
    for (const int node : nodes)
      if (std::abs(mesh.points[node][constant] - first[constant]) > tilt * length) return false;
  }
  return true;
}

}  // namespace

WallAxes::WallAxes(const Problem& problem, const std::vector<WallTable>& wall) {
  const Mesh& mesh = problem.mesh;
  if (wall.empty() || is_straight(mesh)) return;
  mesh_ = &mesh;
  element_ = problem.discretisation.element;
  const int count = counts(mesh.shape, element_).displacement;

  constexpr int outside = -1, fixed = -2;
  std::vector<int> number(mesh.points.size(), outside);
  potential_.assign(mesh.points.size(), 0.0);
  bool begins = false, ends = false;
  for (const Edge& edge : mesh.edges) {
    const auto value = prescribed(edge.boundary);
    if (!value) continue;
    (edge.boundary == Boundary::wall_inlet ? begins : ends) = true;
    for (const int node : mesh.side_nodes(edge.cell, edge.side)) {
      number[node] = fixed;
      potential_[node] = *value;
    }
  }
  int unknowns = 0;
  for (const WallTable& table : wall)
    for (int k = 0; k < count; ++k) {
      int& own = number[mesh.cells[table.cell].nodes[k]];
      if (own == outside) own = unknowns++;
    }

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right_hand_side = Eigen::VectorXd::Zero(unknowns);
  for (const WallTable& table : wall) {
    const auto& nodes = mesh.cells[table.cell].nodes;
    for (int i = 0; i < count; ++i) {
      const int row = number[nodes[i]];
      if (row < 0) continue;
      for (int j = 0; j < count; ++j) {
        double entry = 0;
        for (const WallPoint& point : table.points) {
          const auto& lift = point.displacement.lift;
          entry += point.weight * (lift[1][i] * lift[1][j] + lift[2][i] * lift[2][j]);
        }
        const int column = number[nodes[j]];
        if (column == fixed)
          right_hand_side[row] -= entry * potential_[nodes[j]];
        else
          entries.emplace_back(row, column, entry);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (!begins || !ends || factor.info() != Eigen::Success)
    throw InvalidInput(
        "mesh: the wall has no direction from wall_inlet to wall_outlet; it takes both end faces, in one "
        "piece");
  const Eigen::VectorXd solution = factor.solve(right_hand_side);
  for (std::size_t node = 0; node < number.size(); ++node)
    if (number[node] >= 0) potential_[node] = solution[number[node]];
}

wall::MaterialAxes WallAxes::at(int cell, const element::Local& local) const {
  if (!mesh_) return {{0, 1, 0}, {0, 0, 1}};
  const auto shapes = lifted_at(*mesh_, element_, cell, local);
  const auto& nodes = mesh_->cells[cell].nodes;
  double gradient[2] = {0, 0};
  // Slopes add up to 0: without a constant the gradient of what is constant in the cell is 0, not rounding.
  for (int k = 0; k < counts(mesh_->shape, element_).displacement; ++k)
    for (int i = 0; i < 2; ++i)
      gradient[i] += shapes.lift[1 + i][k] * (potential_[nodes[k]] - potential_[nodes[0]]);
  const double size = std::hypot(gradient[0], gradient[1]);
  if (!(size > 0)) return {{0, 1, 0}, {NAN, 0, NAN}};
  return {{0, 1, 0}, {gradient[0] / size, 0, gradient[1] / size}};
}

}  // namespace tunica::axisym
