// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/harmonic.hpp"

#include <Eigen/SparseCholesky>

#include "core/error.hpp"
#include "full3d/tables.hpp"

namespace tunica::full3d {

using element::solid::Basis;
using element::solid::shape_count;

namespace {

/// The map of a cell and the slopes of a basis there, by place.
struct Slopes {
  double determinant;
  std::array<Point, element::solid::max_nodes> by_place;
};
Slopes slopes_at(const Mesh& mesh, int cell, const element::solid::Shapes& geometry,
                 const element::solid::Shapes& shapes) {
  const PlacedShapes at = placed(mesh, cell, geometry);
  Slopes slopes{at.determinant, {}};
  for (int k = 0; k < shapes.count; ++k) slopes.by_place[k] = at.slope(shapes.slope[k]);
  return slopes;
}

Basis map_basis(const Mesh& mesh) {
  return mesh.quadratic ? Basis::quadratic : Basis::linear;
}

}  // namespace

std::vector<double> harmonic(const Mesh& mesh, Basis basis, std::span<const int> cells,
                             std::span<const HeldBoundary> held,
                             const std::function<double(int, std::size_t)>& weight) {
  constexpr int outside = -1, fixed = -2;
  const int count = shape_count(mesh.shape, basis);
  std::vector<int> number(mesh.points.size(), outside);
  std::vector<double> values(mesh.points.size(), 0.0);
  for (const HeldBoundary& each : held)
    for (const Face& face : mesh.faces) {
      if (face.boundary != each.boundary) continue;
      for (const int k : element::solid::face_nodes(mesh.shape, basis, face.face)) {
        const int node = mesh.node(face.cell, basis, k);
        number[node] = fixed;
        values[node] = each.value;
      }
    }
  int unknowns = 0;
  for (const int cell : cells)
    for (int k = 0; k < count; ++k)
      if (int& own = number[mesh.node(cell, basis, k)]; own == outside) own = unknowns++;

  const auto rule = element::solid::cell_rule(mesh.shape, basis);
  std::vector<element::solid::Shapes> shapes, geometry;
  for (const auto& point : rule.points) {
    shapes.push_back(element::solid::shapes_at(mesh.shape, basis, point));
    geometry.push_back(element::solid::shapes_at(mesh.shape, map_basis(mesh), point));
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right_hand_side = Eigen::VectorXd::Zero(unknowns);
  Eigen::MatrixXd local(count, count), slopes(3, count);
  for (const int cell : cells) {
    local.setZero();
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Slopes at = slopes_at(mesh, cell, geometry[q], shapes[q]);
      for (int k = 0; k < count; ++k)
        for (int i = 0; i < 3; ++i) slopes(i, k) = at.by_place[k][i];
      const double factor = rule.weights[q] * at.determinant * (weight ? weight(cell, q) : 1);
      local.noalias() += factor * slopes.transpose() * slopes;
    }
    for (int i = 0; i < count; ++i) {
      const int row = number[mesh.node(cell, basis, i)];
      if (row < 0) continue;
      for (int j = 0; j < count; ++j) {
        const int node = mesh.node(cell, basis, j), column = number[node];
        if (column == fixed)
          right_hand_side[row] -= local(i, j) * values[node];
        else if (column <= row)
          entries.emplace_back(row, column, local(i, j));
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  // Of cells that nothing holds one pivot is what rounding leaves of a zero.
  constexpr double rounding = 1e-13;
  const bool regular =
      factor.info() == Eigen::Success &&
      (unknowns == 0 || factor.vectorD().minCoeff() > rounding * factor.vectorD().maxCoeff());
  if (!regular)
    throw InvalidInput(
        "mesh: there is no way through the cells from one end to the other; a part is in several pieces, or "
        "an "
        "end has no face");
  const Eigen::VectorXd solution = factor.solve(right_hand_side);
  for (std::size_t node = 0; node < number.size(); ++node)
    if (number[node] >= 0) values[node] = solution[number[node]];
  return values;
}

std::array<Vector<double>, 2> gradients(const Mesh& mesh, std::span<const double> first,
                                        std::span<const double> second, int cell,
                                        const element::solid::Local& local) {
  const Basis basis = map_basis(mesh);
  const auto shapes = element::solid::shapes_at(mesh.shape, basis, local);
  const PlacedShapes at = placed(mesh, cell, shapes);
  std::array<element::solid::Local, 2> slopes{};
  // Slopes add up to 0: without a constant the gradient of what is constant in the cell is 0, not rounding.
  const int any = mesh.node(cell, basis, 0);
  for (int k = 0; k < shapes.count; ++k) {
    const int node = mesh.node(cell, basis, k);
    for (int c = 0; c < 3; ++c) {
      slopes[0][c] += shapes.slope[k][c] * (first[node] - first[any]);
      slopes[1][c] += shapes.slope[k][c] * (second[node] - second[any]);
    }
  }
  return {at.slope(slopes[0]), at.slope(slopes[1])};
}

std::vector<int> cells_of(const Mesh& mesh, Part part) {
  std::vector<int> cells;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    if (mesh.cells[cell].part == part) cells.push_back(cell);
  return cells;
}

}  // namespace tunica::full3d
