// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/layout.hpp"

#include <algorithm>

namespace tunica::axisym {

namespace {

element::Basis displacement_basis(Element element) {
  return element == Element::quadratic ? element::Basis::quadratic : element::Basis::linear;
}

}  // namespace

Layout::Layout(const Problem& problem) {
  mark_nodes(problem);
  number(problem);
}

void Layout::mark_nodes(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  const std::size_t nodes = mesh.points.size();
  const int moved = element::shape_count(mesh.shape, displacement_basis(problem.discretisation.element));
  has_displacement_.assign(nodes, false);
  has_velocity_.assign(nodes, false);
  on_wall_.assign(nodes, false);
  pressure_index_.assign(nodes, -1);
  std::vector<bool> has_pressure(nodes, false);
  for (const Cell& cell : mesh.cells) {
    for (int k = 0; k < moved; ++k) {
      has_displacement_[cell.nodes[k]] = true;
      has_velocity_[cell.nodes[k]] = true;
      if (cell.part == Part::wall) on_wall_[cell.nodes[k]] = true;
    }
    if (cell.part == Part::wall) continue;
    if (problem.discretisation.element == Element::bubble)
      has_velocity_[cell.nodes[mesh.centre_node()]] = true;
    for (int k = 0; k < mesh.corners(); ++k) has_pressure[cell.nodes[k]] = true;
  }
  // A rigid pipe has no wall cells, but its surface is a wall all the same.
  for (const Edge& edge : mesh.edges)
    if (edge.boundary == Boundary::interface)
      for (const int node : mesh.side_nodes(edge.cell, edge.side))
        if (has_displacement_[node]) on_wall_[node] = true;
  int count = 0;
  for (std::size_t node = 0; node < nodes; ++node) {
    if (has_pressure[node]) pressure_index_[node] = count++;
    if (on_wall_[node]) wall_nodes_.push_back(static_cast<int>(node));
  }
  velocity_ = 2 * nodes;
  pressure_ = 4 * nodes;
  scalar_ = pressure_ + static_cast<std::size_t>(count);
  size_ = scalar_;
  if (!mesh.has(Part::blood)) return;
  if (problem.inlet.kind == InletKind::flow) inlet_pressure = size_++;
  if (problem.outlet.kind != OutletKind::prescribed) outlet_pressure = size_++;
  if (problem.outlet.kind == OutletKind::windkessel) windkessel_pressure = size_++;
}

void Layout::number(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  unknown_.assign(size_, -1);
  constexpr int wanted = -2;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const int node = static_cast<int>(n);
    for (int c = 0; c < 2; ++c) {
      if (has_displacement_[n]) unknown_[displacement(node, c)] = wanted;
      if (has_velocity_[n] && !on_wall_[n]) unknown_[velocity(node, c)] = wanted;
    }
    if (pressure_index_[n] >= 0) unknown_[pressure(node)] = wanted;
  }
  for (std::size_t s = scalar_; s < size_; ++s) unknown_[s] = wanted;

  const auto prescribe = [&](std::size_t entry, int node, int c, bool is_velocity) {
    if (unknown_[entry] != wanted) return;
    unknown_[entry] = -1;
    prescribed_.push_back({entry, node, c, is_velocity});
  };
  for (const Edge& edge : mesh.edges) {
    const Prescribed& fixed = problem.on(edge.boundary);
    for (const int node : mesh.side_nodes(edge.cell, edge.side))
      for (int c = 0; c < 2; ++c) {
        if (fixed.displacement[c]) prescribe(displacement(node, c), node, c, false);
        if (fixed.velocity[c]) prescribe(velocity(node, c), node, c, true);
      }
  }

  // Nodes by height, then radius: the vessel is long and thin, and orderings that reduce fill do well from
  // there.
  std::vector<int> order(mesh.points.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto &p = mesh.points[a], &q = mesh.points[b];
    return p[1] != q[1] ? p[1] < q[1] : p[0] != q[0] ? p[0] < q[0] : a < b;
  });
  const auto give_number = [&](std::size_t entry) {
    if (unknown_[entry] != wanted) return;
    unknown_[entry] = static_cast<int>(entries_.size());
    entries_.push_back(entry);
  };
  for (const int node : order) {
    for (int c = 0; c < 2; ++c) {
      give_number(displacement(node, c));
      give_number(velocity(node, c));
    }
    if (has_pressure(node)) give_number(pressure(node));
  }
  for (std::size_t s = scalar_; s < size_; ++s) give_number(s);
}

}  // namespace tunica::axisym
