// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/inlet_profile.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <cmath>

#include "core/error.hpp"
#include "full3d/measures.hpp"

namespace tunica::full3d {

using element::solid::Basis;

namespace {

Basis map_basis(const Mesh& mesh) {
  return mesh.quadratic ? Basis::quadratic : Basis::linear;
}

}  // namespace

InletProfile::InletProfile(const Mesh& mesh, double tolerance) {
  const Surface mean = surface(mesh, Boundary::inlet);
  if (const double excess = mean.area / mean.projected - 1; excess > tolerance)
    throw InvalidInput(fmt::format(
        "mesh: the inlet is no plane, which the velocity of a prescribed flow is computed for: its faces are "
        "inclined to their mean plane by {:.3g} rad, which changes that velocity by some {:.2g} %, and "
        "accuracy.tolerance allows {:.2g} %; draw it flat, or write inlet.profile = \"natural\"",
        inclination(mean), 100 * excess, 100 * tolerance));
  for (int i = 0; i < 3; ++i) normal_[i] = -mean.normal[i];

  const Basis basis = map_basis(mesh);
  constexpr int outside = -1, fixed = -2;
  std::vector<int> number(mesh.points.size(), outside);
  for (const Face& face : mesh.faces)
    if (face.boundary == Boundary::interface)
      for (const int k : element::solid::face_nodes(mesh.shape, basis, face.face))
        number[mesh.node(face.cell, basis, k)] = fixed;
  int unknowns = 0;
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> load,
      through;  // integrals of the shape functions over the area, and over its projection
  for (const Face& face : mesh.faces) {
    if (face.boundary != Boundary::inlet) continue;
    const auto places = element::solid::face_nodes(mesh.shape, basis, face.face);
    std::vector<int> rows;
    for (const int k : places) {
      int& own = number[mesh.node(face.cell, basis, k)];
      if (own == outside) own = unknowns++;
      rows.push_back(own);
    }
    load.resize(unknowns, 0.0);
    through.resize(unknowns, 0.0);
    const auto rule = element::solid::face_rule(mesh.shape, basis, face.face);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const auto shapes = element::solid::shapes_at(mesh.shape, basis, rule.points[q]);
      std::vector<std::array<double, 2>> slopes(places.size());
      Vector<double> along[2] = {};
      for (std::size_t k = 0; k < places.size(); ++k) {
        const Point& x = mesh.points[mesh.node(face.cell, basis, places[k])];
        for (int s = 0; s < 2; ++s) {
          for (int c = 0; c < 3; ++c) slopes[k][s] += shapes.slope[places[k]][c] * rule.directions[s][c];
          for (int i = 0; i < 3; ++i) along[s][i] += slopes[k][s] * x[i];
        }
      }
      const double g00 = dot(along[0], along[0]), g01 = dot(along[0], along[1]),
                   g11 = dot(along[1], along[1]);
      const double determinant = g00 * g11 - g01 * g01, area = rule.weights[q] * std::sqrt(determinant);
      const double projected = -rule.weights[q] * dot(cross(along[0], along[1]), normal_);
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (rows[i] < 0) continue;
        load[rows[i]] += area * shapes.value[places[i]];
        through[rows[i]] += projected * shapes.value[places[i]];
        for (std::size_t j = 0; j < places.size(); ++j) {
          if (rows[j] < 0) continue;
          const auto &a = slopes[i], &b = slopes[j];
          const double product = g11 * a[0] * b[0] - g01 * (a[0] * b[1] + a[1] * b[0]) + g00 * a[1] * b[1];
          entries.emplace_back(rows[i], rows[j], area * product / determinant);
        }
      }
    }
  }
  if (unknowns == 0) throw InvalidInput("mesh: all nodes of the inlet are on its rim; give it more cells");
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::Map<const Eigen::VectorXd> right_hand_side(load.data(), unknowns);
  const Eigen::VectorXd speed =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right_hand_side);
  const double flow = speed.dot(Eigen::Map<const Eigen::VectorXd>(through.data(), unknowns));
  for (std::size_t node = 0; node < number.size(); ++node)
    if (number[node] >= 0) speed_[mesh.points[node]] = speed[number[node]] / flow;
}

Vector<double> InletProfile::at(const Point& node) const {
  const auto found = speed_.find(node);
  if (found == speed_.end()) return {};
  const double speed = found->second;
  return {speed * normal_[0], speed * normal_[1], speed * normal_[2]};
}

int normal_axis(const Mesh& mesh, Boundary boundary, double tolerance) {
  const Vector<double> normal = surface(mesh, boundary).normal;
  for (int i = 0; i < 3; ++i)
    if (std::hypot(normal[(i + 1) % 3], normal[(i + 2) % 3]) < tolerance) return i;
  return -1;
}

}  // namespace tunica::full3d
