// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/quadrature.hpp"
#include "full3d/layout.hpp"

namespace tunica::mms {

struct SolidCells {
  using Problem = full3d::Problem;
  using Basis = element::solid::Basis;
  static constexpr Basis linear = Basis::linear;

  static Basis moved(const Problem& problem) {
    return full3d::displacement_basis(problem.discretisation.element);
  }
  static Basis flowing(const Problem& problem) {
    return full3d::velocity_basis(problem.discretisation.element);
  }
  static element::solid::Shapes shapes(const Problem& problem, Basis basis,
                                       const element::solid::Local& local) {
    return element::solid::shapes_at(problem.mesh.shape, basis, local);
  }
  static int node(const Problem& problem, int cell, Basis basis, int k) {
    return problem.mesh.node(cell, basis, k);
  }
  /// Volume per local volume.
  static double measure(const std::array<double, 3>&, const std::array<std::array<double, 3>, 3>& slope) {
    return std::abs(full3d::Image{{}, slope}.determinant());
  }

  static element::solid::Rule fine_rule(const Problem& problem) {
    element::solid::Rule rule;
    const auto line = gauss_legendre(5);
    for (const auto& a : line)
      for (const auto& b : line)
        for (const auto& c : line) {
          const double weight = a.weight * b.weight * c.weight;
          if (problem.mesh.shape == full3d::Shape::hexahedron) {
            rule.points.push_back({a.position, b.position, c.position});
            rule.weights.push_back(weight);
          } else {
            const double x = 0.5 * (1 + a.position), left = 1 - x, y = 0.5 * left * (1 + b.position),
                         rest = left - y;
            rule.points.push_back({x, y, 0.5 * rest * (1 + c.position)});
            rule.weights.push_back(0.125 * left * rest * weight);
          }
        }
    return rule;
  }
};

}  // namespace tunica::mms
