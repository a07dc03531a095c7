// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "axisym/problem.hpp"
#include "axisym/tables.hpp"
#include "core/quadrature.hpp"

namespace tunica::mms {

struct HalfPlaneCells {
  using Problem = axisym::Problem;
  using Basis = element::Basis;
  static constexpr Basis linear = Basis::linear;

  static Basis moved(const Problem& problem) {
    return problem.discretisation.element == axisym::Element::quadratic ? Basis::quadratic : Basis::linear;
  }
  static Basis flowing(const Problem& problem) {
    return problem.discretisation.element == axisym::Element::bubble ? Basis::linear_bubble : moved(problem);
  }
  static element::Shapes shapes(const Problem& problem, Basis basis, const element::Local& local) {
    return element::shapes_at(problem.mesh.shape, basis, local);
  }
  static int node(const Problem& problem, int cell, Basis basis, int k) {
    const axisym::Cell& c = problem.mesh.cells[cell];
    return basis == Basis::linear_bubble
               ? axisym::velocity_node(problem.mesh, problem.discretisation.element, c, k)
               : c.nodes[k];
  }
  /// Volume of revolution per radian and local area.
  static double measure(const std::array<double, 2>& place,
                        const std::array<std::array<double, 2>, 2>& slope) {
    return place[0] * std::abs(slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0]);
  }

  struct Rule {
    std::vector<element::Local> points;
    std::vector<double> weights;
  };
  static Rule fine_rule(const Problem& problem) {
    Rule rule;
    const auto line = gauss_legendre(5);
    for (const auto& a : line)
      for (const auto& b : line) {
        if (problem.mesh.shape == element::CellShape::quadrilateral) {
          rule.points.push_back({a.position, b.position});
          rule.weights.push_back(a.weight * b.weight);
        } else {
          const double x = 0.5 * (1 + a.position), left = 1 - x;
          rule.points.push_back({x, 0.5 * left * (1 + b.position)});
          rule.weights.push_back(0.25 * left * a.weight * b.weight);
        }
      }
    return rule;
  }
};

}  // namespace tunica::mms
