// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/interface_line.hpp"

#include <algorithm>
#include <cmath>

#include "axisym/meeting.hpp"
#include "core/observables/table.hpp"

namespace tunica::axisym {

InterfaceLine::InterfaceLine(const WallReader& reader) : reader_(reader) {
  const Problem& problem = reader.assembler().problem();
  const Layout& layout = reader.assembler().layout();
  const Mesh& mesh = problem.mesh;
  std::vector<int> index(mesh.points.size(), -1);
  for (const Edge& edge : mesh.edges) {
    if (edge.boundary != Boundary::interface) continue;
    const auto side = mesh.side_nodes(edge.cell, edge.side);
    for (int at = 0; at < 3; ++at) {
      const int node = side[at];
      if (!layout.has_displacement(node)) continue;
      if (index[node] < 0) {
        index[node] = static_cast<int>(nodes_.size());
        nodes_.push_back({node, {}, {}, {}, {}});
      }
      if (mesh.cells[edge.cell].part != Part::blood) continue;
      Node& entry = nodes_[index[node]];
      entry.sides.push_back({side, at});
      if (at == 2)
        entry.pressure_corners = {side[0], side[1]};
      else
        entry.pressure_corners = {node};
    }
  }
  const int count = counts(mesh.shape, problem.discretisation.element).displacement;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    for (int k = 0; k < count; ++k) {
      const int entry = index[mesh.cells[cell].nodes[k]];
      if (entry < 0) continue;
      auto& places = mesh.cells[cell].part == Part::blood ? nodes_[entry].blood : nodes_[entry].wall;
      places.push_back({cell, element::node_position(mesh.shape, k)});
    }
  for (Node& node : nodes_)
    if (!node.wall.empty()) node.wall = in_innermost_layer(mesh, std::move(node.wall));
  std::sort(nodes_.begin(), nodes_.end(), [&](const Node& a, const Node& b) {
    const auto &p = mesh.points[a.node], &q = mesh.points[b.node];
    return p[1] != q[1] ? p[1] < q[1] : p[0] < q[0];
  });
}

/// Blood's cells lie to the left of their sides, so that the interface runs downstream.
std::array<double, 2> InterfaceLine::tangent(const Node& node, std::span<const double> y) const {
  const Assembler& assembler = reader_.assembler();
  const Mesh& mesh = assembler.problem().mesh;
  const bool quadratic = assembler.problem().discretisation.element == Element::quadratic;
  // Derivatives of the side's shape functions at its nodes.
  constexpr double parabola[3][3] = {{-1.5, -0.5, 2}, {0.5, 1.5, -2}, {-0.5, 0.5, 0}};
  constexpr double chord[3] = {-0.5, 0.5, 0};
  std::array<double, 2> sum{};
  for (const SideAt& side : node.sides) {
    const auto& slope = quadratic ? parabola[side.at] : chord;
    std::array<double, 2> along{};
    for (int k = 0; k < 3; ++k) {
      if (slope[k] == 0) continue;
      for (int i = 0; i < 2; ++i)
        along[i] +=
            slope[k] * (mesh.points[side.nodes[k]][i] + y[assembler.layout().displacement(side.nodes[k], i)]);
    }
    const double length = std::hypot(along[0], along[1]);
    for (int i = 0; i < 2; ++i) sum[i] += along[i] / length;
  }
  const double length = std::hypot(sum[0], sum[1]);
  return {sum[0] / length, sum[1] / length};
}

double InterfaceLine::shear_stress(const Node& node, std::span<const double> y) const {
  const Assembler& assembler = reader_.assembler();
  const Problem& problem = assembler.problem();
  Tensor<double> gradient;
  for (const Place& place : node.blood) {
    const auto shapes = lifted_at(problem.mesh, problem.discretisation.element, place.cell, place.local);
    const auto f = Tensor<double>::identity() +
                   kernel::field_gradient(shapes, nodal_displacement(assembler, place.cell, y));
    const auto velocity = kernel::field_gradient(shapes, nodal_velocity(assembler, place.cell, y));
    // grad v = dv/dX F^-1
    const double share = 1.0 / static_cast<double>(node.blood.size());
    gradient = gradient + (share / determinant(f)) * (velocity * transpose(cofactor(f)));
  }
  const auto t = tangent(node, y);
  const Vector<double> along{t[0], 0, t[1]}, outward{t[1], 0, -t[0]};
  const Tensor<double> rate = gradient + transpose(gradient);
  return -problem.blood.viscosity * dot(along, rate * outward);
}

std::vector<InterfaceState> InterfaceLine::states(double time, std::span<const double> y) const {
  const Assembler& assembler = reader_.assembler();
  const Problem& problem = assembler.problem();
  const Layout& layout = assembler.layout();
  std::vector<InterfaceState> states;
  states.reserve(nodes_.size());
  for (const Node& node : nodes_) {
    const double outward = y[layout.displacement(node.node, 0)];
    InterfaceState& state = states.emplace_back();
    state.radial_displacement = outward;
    state.radius = problem.mesh.points[node.node][0] + outward;
    state.z = problem.mesh.points[node.node][1] + y[layout.displacement(node.node, 1)];
    state.wall_shear_stress = state.von_mises = observables::none;
    if (node.blood.empty()) {
      state.pressure = problem.lumen_pressure(time);
    } else {
      state.pressure = 0;
      for (const int corner : node.pressure_corners)
        state.pressure += y[layout.pressure(corner)] / static_cast<double>(node.pressure_corners.size());
      state.wall_shear_stress = shear_stress(node, y);
    }
    if (node.wall.empty()) continue;
    const int layer = problem.mesh.cells[node.wall.front().cell].layer;
    state.von_mises =
        von_mises_stress(reader_.cauchy(layer, reader_.mean(node.wall, y), reader_.axes(node.wall)));
  }
  return states;
}

}  // namespace tunica::axisym
