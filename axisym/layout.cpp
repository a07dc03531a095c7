// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/layout.hpp"

#include <algorithm>
#include <numeric>

#include "core/coupled/openings.hpp"

namespace tunica::axisym {

namespace {

element::Basis displacement_basis(Element element) {
  return element == Element::quadratic ? element::Basis::quadratic : element::Basis::linear;
}

void mark_nodes(const Problem& problem, coupled::LayoutSpec& spec) {
  const Mesh& mesh = problem.mesh;
  const std::size_t nodes = mesh.points.size();
  const int moved = element::shape_count(mesh.shape, displacement_basis(problem.discretisation.element));
  spec.has_displacement.assign(nodes, false);
  spec.has_velocity.assign(nodes, false);
  spec.on_wall.assign(nodes, false);
  spec.has_pressure.assign(nodes, false);
  for (const Cell& cell : mesh.cells) {
    for (int k = 0; k < moved; ++k) {
      spec.has_displacement[cell.nodes[k]] = true;
      spec.has_velocity[cell.nodes[k]] = true;
      if (cell.part == Part::wall) spec.on_wall[cell.nodes[k]] = true;
    }
    if (cell.part == Part::wall) continue;
    if (problem.discretisation.element == Element::bubble)
      spec.has_velocity[cell.nodes[mesh.centre_node()]] = true;
    for (int k = 0; k < mesh.corners(); ++k) spec.has_pressure[cell.nodes[k]] = true;
  }
  // A rigid pipe has no wall cells, but its surface is a wall all the same.
  for (const Edge& edge : mesh.edges)
    if (edge.boundary == Boundary::interface)
      for (const int node : mesh.side_nodes(edge.cell, edge.side))
        if (spec.has_displacement[node]) spec.on_wall[node] = true;
}

}  // namespace

Layout layout_of(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  coupled::LayoutSpec spec;
  spec.components = 2;
  spec.mesh_follows = problem.discretisation.lagged_mesh;
  mark_nodes(problem, spec);
  if (mesh.has(Part::blood)) coupled::add_openings(problem, spec);
  for (const Edge& edge : mesh.edges) {
    const Prescribed& fixed = problem.on(edge.boundary);
    for (const int node : mesh.side_nodes(edge.cell, edge.side))
      for (int c = 0; c < 2; ++c) {
        if (fixed.displacement[c]) spec.fixed.push_back({node, c, false});
        if (fixed.velocity[c]) spec.fixed.push_back({node, c, true});
      }
  }
  // Nodes by height, then radius: the vessel is long and thin, and orderings that reduce fill do well from
  // there.
  spec.order.resize(mesh.points.size());
  std::iota(spec.order.begin(), spec.order.end(), 0);
  std::sort(spec.order.begin(), spec.order.end(), [&](int a, int b) {
    const auto &p = mesh.points[a], &q = mesh.points[b];
    return p[1] != q[1] ? p[1] < q[1] : p[0] != q[0] ? p[0] < q[0] : a < b;
  });
  return Layout(spec);
}

}  // namespace tunica::axisym
