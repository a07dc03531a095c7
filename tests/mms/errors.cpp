// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/mms/errors.hpp"

#include <cmath>

#include "axisym/tables.hpp"
#include "core/quadrature.hpp"

namespace tunica::axisym::mms {

namespace {

struct Rule {
  std::vector<element::Local> points;
  std::vector<double> weights;
};

/// Gauss's rule with five points along each side of the square; for the triangle, of the square that is
/// mapped to it by drawing one side together.
Rule fine_rule(CellShape shape) {
  Rule rule;
  const auto line = gauss_legendre(5);
  for (const auto& a : line)
    for (const auto& b : line) {
      if (shape == CellShape::quadrilateral) {
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

/// Squares of the error and of what is exact, summed.
struct Sum {
  double error = 0, exact = 0;
  void add(double weight, double computed, double expected) {
    error += weight * (computed - expected) * (computed - expected);
    exact += weight * expected * expected;
  }
  double relative() const { return exact > 0 ? std::sqrt(error / exact) : 0; }
};

}  // namespace

Errors errors(const Problem& problem, const Layout& layout, std::span<const double> y,
              const Vessel<SmoothMotion>& vessel, double time) {
  using element::Basis;
  const Mesh& mesh = problem.mesh;
  const Element element = problem.discretisation.element;
  const Basis moved = element == Element::quadratic ? Basis::quadratic : Basis::linear;
  const Basis flowing = element == Element::bubble ? Basis::linear_bubble : moved;
  const Rule rule = fine_rule(mesh.shape);
  Sum wall, blood, velocity, pressure;
  for (const Cell& cell : mesh.cells)
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const auto d = element::shapes_at(mesh.shape, moved, rule.points[q]);
      Vector<double> x{}, along_first{}, along_second{}, displacement{};
      for (int k = 0; k < d.count; ++k)
        for (int c = 0; c < 2; ++c) {
          const double place = mesh.points[cell.nodes[k]][c];
          x[2 * c] += d.value[k] * place;
          along_first[2 * c] += d.slope[k][0] * place;
          along_second[2 * c] += d.slope[k][1] * place;
          displacement[2 * c] += d.value[k] * y[layout.displacement(cell.nodes[k], c)];
        }
      const double weight = rule.weights[q] * x[0] *
                            std::abs(along_first[0] * along_second[2] - along_first[2] * along_second[0]);
      const auto exact = vessel.displacement(x, time);
      for (const int i : {0, 2})
        (cell.part == Part::wall ? wall : blood).add(weight, displacement[i], exact[i]);
      if (cell.part == Part::wall) continue;
      const auto v = element::shapes_at(mesh.shape, flowing, rule.points[q]);
      const auto exact_velocity = vessel.velocity(x, time);
      for (int c = 0; c < 2; ++c) {
        double sum = 0;
        for (int k = 0; k < v.count; ++k)
          sum += v.value[k] * y[layout.velocity(velocity_node(mesh, element, cell, k), c)];
        velocity.add(weight, sum, exact_velocity[2 * c]);
      }
      const auto p = element::shapes_at(mesh.shape, Basis::linear, rule.points[q]);
      double sum = 0;
      for (int k = 0; k < p.count; ++k) sum += p.value[k] * y[layout.pressure(cell.nodes[k])];
      pressure.add(weight, sum, vessel.pressure(x, time));
    }
  Errors all{wall.relative(), blood.relative(), velocity.relative(), pressure.relative()};
  if (layout.inlet_pressure)
    all.inlet_pressure = std::abs(y[*layout.inlet_pressure] / vessel.inlet_pressure(time) - 1);
  if (layout.outlet_pressure)
    all.outlet_pressure = std::abs(y[*layout.outlet_pressure] / vessel.outlet_pressure(time) - 1);
  return all;
}

}  // namespace tunica::axisym::mms
