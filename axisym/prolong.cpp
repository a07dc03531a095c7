// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/prolong.hpp"

#include <algorithm>
#include <stdexcept>

#include "axisym/locate.hpp"
#include "axisym/wall_state.hpp"

namespace tunica::axisym {

namespace {

double pressure_at(const Assembler& assembler, const Place& place, std::span<const double> y) {
  const Mesh& mesh = assembler.problem().mesh;
  const auto shapes = element::shapes_at(mesh.shape, element::Basis::linear, place.local);
  double pressure = 0;
  for (int k = 0; k < shapes.count; ++k)
    pressure += shapes.value[k] * y[assembler.layout().pressure(mesh.cells[place.cell].nodes[k])];
  return pressure;
}

}  // namespace

std::vector<double> prolong(const Assembler& from, std::span<const double> y, const Assembler& to) {
  const Mesh &source = from.problem().mesh, &mesh = to.problem().mesh;
  const Layout& layout = to.layout();
  std::vector<double> state(layout.size(), 0.0);
  std::vector<bool> done(mesh.points.size(), false);
  // On the interface both parts have the same values, and pressures are those of the blood.
  for (const Cell& cell : mesh.cells)
    for (const int node : cell.nodes) {
      if (node < 0 || (done[node] && cell.part == Part::wall)) continue;
      const auto place = locate(source, mesh.points[node], cell.part);
      if (!place) throw std::logic_error("prolong: the meshes are not of the same vessel");
      const auto shapes = lifted_at(source, from.problem().discretisation.element, place->cell, place->local);
      const auto displacement = kernel::field_value(shapes, nodal_displacement(from, place->cell, y));
      const auto velocity = kernel::field_value(shapes, nodal_velocity(from, place->cell, y));
      for (int c = 0; c < 2; ++c) {
        state[layout.displacement(node, c)] = displacement[Frame::axes[c]];
        state[layout.velocity(node, c)] = velocity[Frame::axes[c]];
      }
      if (cell.part == Part::blood && layout.has_pressure(node))
        state[layout.pressure(node)] = pressure_at(from, *place, y);
      done[node] = true;
    }
  std::copy(y.begin() + static_cast<std::ptrdiff_t>(from.layout().scalar_begin()), y.end(),
            state.begin() + static_cast<std::ptrdiff_t>(layout.scalar_begin()));
  return state;
}

}  // namespace tunica::axisym
