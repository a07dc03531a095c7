// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "axisym/layout.hpp"
#include "tests/mms/manufactured_vessel.hpp"

namespace tunica::axisym::mms {

/// The exact fields at the nodes as the elements hold them, or with `rates` their rates.
template <class Motion>
std::vector<double> nodal(const Problem& problem, const Layout& layout, const Vessel<Motion>& vessel,
                          double time, bool rates = false) {
  const Mesh& mesh = problem.mesh;
  std::vector<double> y(layout.size());
  const auto at = [&](const auto& field, const Vector<double>& x) {
    return rates ? manufactured::rate(field, x, time) : field(x, time);
  };
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const int node = static_cast<int>(n);
    const Vector<double> x{mesh.points[n][0], 0, mesh.points[n][1]};
    const auto d = at(vessel.displacement_field(), x);
    const auto v =
        layout.on_wall(node) ? at(vessel.mesh_velocity_field(), x) : at(vessel.velocity_field(), x);
    for (int c = 0; c < 2; ++c) {
      if (layout.has_displacement(node)) y[layout.displacement(node, c)] = d[2 * c];
      if (layout.has_velocity(node)) y[layout.velocity(node, c)] = v[2 * c];
    }
    if (layout.has_pressure(node)) y[layout.pressure(node)] = at(vessel.pressure_field(), x);
  }
  // The coefficient of a bubble is what the centre has beyond the mean of the corners.
  if (problem.discretisation.element == Element::bubble)
    for (const Cell& cell : mesh.cells) {
      if (cell.part == Part::wall) continue;
      for (int c = 0; c < 2; ++c)
        for (int k = 0; k < 3; ++k)
          y[layout.velocity(cell.nodes[mesh.centre_node()], c)] -= y[layout.velocity(cell.nodes[k], c)] / 3;
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

/// By a rule of its own, of degree 9: at the points of the elements' rules errors may be smaller than
/// elsewhere.
Errors errors(const Problem& problem, const Layout& layout, std::span<const double> y,
              const Vessel<SmoothMotion>& vessel, double time);

}  // namespace tunica::axisym::mms
