// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "core/coupled/layout.hpp"
#include "core/quadrature.hpp"
#include "tests/mms/manufactured_vessel.hpp"

/// Manufactured motions at the nodes of a mesh, and what differs from them. `Cells` (HalfPlaneCells,
/// SolidCells) tells of a problem's mesh what has to be known.
namespace tunica::mms {

using coupled::Layout;

/// The exact fields at the nodes as the elements hold them, or with `rates` their rates.
template <class Cells, class Motion>
std::vector<double> nodal(const typename Cells::Problem& problem, const Layout& layout,
                          const Vessel<Motion>& vessel, double time, bool rates = false) {
  constexpr auto axes = Motion::Axes::axes;
  constexpr int n = Motion::dimension;
  const auto& mesh = problem.mesh;
  std::vector<double> y(layout.size());
  const auto at = [&](const auto& field, const Vector<double>& x) {
    return rates ? manufactured::rate(field, x, time) : field(x, time);
  };
  for (int node = 0; node < layout.nodes(); ++node) {
    const Vector<double> x = Motion::place(mesh.points[node]);
    const auto d = at(vessel.displacement_field(), x);
    const auto v =
        layout.on_wall(node) ? at(vessel.mesh_velocity_field(), x) : at(vessel.velocity_field(), x);
    for (int c = 0; c < n; ++c) {
      if (layout.has_displacement(node)) y[layout.displacement(node, c)] = d[axes[c]];
      if (layout.has_velocity(node)) y[layout.velocity(node, c)] = v[axes[c]];
    }
    if (layout.has_pressure(node)) y[layout.pressure(node)] = at(vessel.pressure_field(), x);
  }
  // The coefficient of a bubble is what the centre has beyond the mean of the corners.
  if (problem.discretisation.element == coupled::Element::bubble)
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
      if (mesh.cells[cell].part == coupled::Part::wall) continue;
      const auto node = [&](int k) {
        return Cells::node(problem, static_cast<int>(cell), Cells::flowing(problem), k);
      };
      for (int c = 0; c < n; ++c)
        for (int k = 0; k <= n; ++k)
          y[layout.velocity(node(n + 1), c)] -= y[layout.velocity(node(k), c)] / (n + 1);
    }
  const auto set = [&](const auto& entry, const Dual<double, 1>& value) {
    if (entry) y[*entry] = rates ? value.derivative[0] : value.value;
  };
  const auto t = seed(time);
  set(layout.inlet_pressure, vessel.inlet_pressure(t));
  set(layout.outlet_pressure, vessel.outlet_pressure(t));
  if (layout.windkessel_pressure) set(layout.windkessel_pressure, vessel.stored_pressure(problem.outlet, t));
  return y;
}

/// L2 norms over the unloaded vessel of what is computed minus what is exact, relative to those of what is
/// exact; of scalars that are unknowns, relative errors. The velocity is that of blood.
struct Errors {
  double wall_displacement = 0, blood_displacement = 0, velocity = 0, pressure = 0;
  double inlet_pressure = 0, outlet_pressure = 0;
};

namespace detail {

/// Squares of the error and of what is exact, summed.
struct Sum {
  double error = 0, exact = 0;
  void add(double weight, double computed, double expected) {
    error += weight * (computed - expected) * (computed - expected);
    exact += weight * expected * expected;
  }
  double relative() const { return exact > 0 ? std::sqrt(error / exact) : 0; }
};

}  // namespace detail

/// By Gauss's rule with five points along each side of the square or cube, which is mapped to triangles and
/// tetrahedra by drawing sides together: at the points of the elements' own rules errors may be smaller than
/// elsewhere.
template <class Cells, class Motion>
Errors errors(const typename Cells::Problem& problem, const Layout& layout, std::span<const double> y,
              const Vessel<Motion>& vessel, double time) {
  constexpr auto axes = Motion::Axes::axes;
  constexpr int n = Motion::dimension;
  const auto& mesh = problem.mesh;
  const auto rule = Cells::fine_rule(problem);
  detail::Sum wall, blood, velocity, pressure;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const auto moved = Cells::moved(problem);
      const auto d = Cells::shapes(problem, moved, rule.points[q]);
      std::array<double, n> place{};
      std::array<std::array<double, n>, n> slope{};
      Vector<double> displacement{};
      for (int k = 0; k < d.count; ++k) {
        const int node = Cells::node(problem, cell, moved, k);
        for (int c = 0; c < n; ++c) {
          place[c] += d.value[k] * mesh.points[node][c];
          for (int l = 0; l < n; ++l) slope[c][l] += d.slope[k][l] * mesh.points[node][c];
          displacement[axes[c]] += d.value[k] * y[layout.displacement(node, c)];
        }
      }
      const Vector<double> x = Motion::place(place);
      const double weight = rule.weights[q] * Cells::measure(place, slope);
      const bool of_wall = mesh.cells[cell].part == coupled::Part::wall;
      const auto exact = vessel.displacement(x, time);
      for (const int i : axes) (of_wall ? wall : blood).add(weight, displacement[i], exact[i]);
      if (of_wall) continue;
      const auto flowing = Cells::flowing(problem);
      const auto v = Cells::shapes(problem, flowing, rule.points[q]);
      const auto exact_velocity = vessel.velocity(x, time);
      for (int c = 0; c < n; ++c) {
        double sum = 0;
        for (int k = 0; k < v.count; ++k)
          sum += v.value[k] * y[layout.velocity(Cells::node(problem, cell, flowing, k), c)];
        velocity.add(weight, sum, exact_velocity[axes[c]]);
      }
      const auto p = Cells::shapes(problem, Cells::linear, rule.points[q]);
      double sum = 0;
      for (int k = 0; k < p.count; ++k)
        sum += p.value[k] * y[layout.pressure(Cells::node(problem, cell, Cells::linear, k))];
      pressure.add(weight, sum, vessel.pressure(x, time));
    }
  Errors all{wall.relative(), blood.relative(), velocity.relative(), pressure.relative()};
  if (layout.inlet_pressure)
    all.inlet_pressure = std::abs(y[*layout.inlet_pressure] / vessel.inlet_pressure(time) - 1);
  if (layout.outlet_pressure)
    all.outlet_pressure = std::abs(y[*layout.outlet_pressure] / vessel.outlet_pressure(time) - 1);
  return all;
}

}  // namespace tunica::mms
