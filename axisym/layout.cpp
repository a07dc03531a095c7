// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/layout.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "core/coupled/openings.hpp"
#include "core/coupled/sectional_motion.hpp"

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

/// Each section's nodes in the blood by that on its interface.
void share_sections(const Problem& problem, coupled::LayoutSpec& spec) {
  const Mesh& mesh = problem.mesh;
  std::map<double, int> interface;  // by height
  for (const Edge& edge : mesh.edges)
    if (edge.boundary == Boundary::interface)
      for (const int node : mesh.side_nodes(edge.cell, edge.side))
        if (spec.has_displacement[node]) interface.emplace(mesh.points[node][1], node);
  const auto is_clamped = [&](Boundary end) { return problem.on(end).displacement[0]; };
  const coupled::SectionalMotion motion{interface.begin()->first, interface.rbegin()->first,
                                        is_clamped(Boundary::inlet), is_clamped(Boundary::outlet)};
  for (int node = 0; node < static_cast<int>(mesh.points.size()); ++node) {
    if (!spec.has_displacement[node] || spec.on_wall[node]) continue;
    const auto found = interface.find(mesh.points[node][1]);
    if (found == interface.end())
      throw std::logic_error("share_sections: a node in the blood lies in no section of the mesh");
    const auto [z, of] = *found;
    const double radius = mesh.points[of][0], s = mesh.points[node][0] / radius;
    const double fade = std::pow(s, motion.power_at(radius, z));
    spec.shares.push_back({node, 0, of, s});
    spec.shares.push_back({node, 1, of, fade, (1 - fade) * motion.lean_at(radius, z)});
  }
}

}  // namespace

Layout layout_of(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  coupled::LayoutSpec spec;
  spec.components = 2;
  spec.mesh_follows = problem.discretisation.lagged_mesh;
  mark_nodes(problem, spec);
  if (problem.discretisation.motion == coupled::MeshMotion::sectional) share_sections(problem, spec);
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
