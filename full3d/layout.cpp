// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/layout.hpp"

#include <algorithm>
#include <numeric>

#include "core/coupled/openings.hpp"

namespace tunica::full3d {

namespace {

using element::solid::shape_count;

void mark_nodes(const Problem& problem, coupled::LayoutSpec& spec) {
  const Mesh& mesh = problem.mesh;
  const std::size_t nodes = mesh.points.size();
  const Element element = problem.discretisation.element;
  const Basis moving = displacement_basis(element), flowing = velocity_basis(element);
  spec.has_displacement.assign(nodes, false);
  spec.has_velocity.assign(nodes, false);
  spec.on_wall.assign(nodes, false);
  spec.has_pressure.assign(nodes, false);
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    const bool wall = mesh.cells[cell].part == Part::wall;
    for (int k = 0; k < shape_count(mesh.shape, moving); ++k) {
      const int node = mesh.node(cell, moving, k);
      spec.has_displacement[node] = spec.has_velocity[node] = true;
      if (wall) spec.on_wall[node] = true;
    }
    if (wall) continue;
    for (int k = 0; k < shape_count(mesh.shape, flowing); ++k)
      spec.has_velocity[mesh.node(cell, flowing, k)] = true;
    for (int k = 0; k < shape_count(mesh.shape, Basis::linear); ++k)
      spec.has_pressure[mesh.node(cell, Basis::linear, k)] = true;
  }
  // A rigid pipe has no wall cells, but its surface is a wall all the same.
  for (const Face& face : mesh.faces)
    if (face.boundary == Boundary::interface)
      for (const int k : element::solid::face_nodes(mesh.shape, moving, face.face))
        spec.on_wall[mesh.node(face.cell, moving, k)] = true;
}

}  // namespace

Basis displacement_basis(Element element) {
  return element == Element::quadratic ? Basis::quadratic : Basis::linear;
}
Basis velocity_basis(Element element) {
  return element == Element::bubble ? Basis::linear_bubble : displacement_basis(element);
}

Layout layout_of(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  coupled::LayoutSpec spec;
  spec.components = 3;
  spec.mesh_follows = problem.discretisation.lagged_mesh;
  spec.mesh_couples = static_cast<bool>(problem.sections);
  mark_nodes(problem, spec);
  if (mesh.has(Part::blood)) coupled::add_openings(problem, spec);
  const Basis moving = displacement_basis(problem.discretisation.element);
  for (const Face& face : mesh.faces) {
    const Prescribed& fixed = problem.on(face.boundary);
    for (const int k : element::solid::face_nodes(mesh.shape, moving, face.face)) {
      const int node = mesh.node(face.cell, moving, k);
      for (int c = 0; c < 3; ++c) {
        if (fixed.displacement[c]) spec.fixed.push_back({node, c, false});
        if (fixed.velocity[c]) spec.fixed.push_back({node, c, true});
      }
    }
  }
  spec.order.resize(mesh.points.size());
  std::iota(spec.order.begin(), spec.order.end(), 0);
  return Layout(spec);
}

int rows_of(const Problem& problem, const Layout& layout) {
  if (problem.discretisation.element != Element::bubble) return layout.unknowns();
  const auto& cells = problem.mesh.cells;
  const auto bubbles =
      std::count_if(cells.begin(), cells.end(), [](const Cell& c) { return c.part == Part::blood; });
  return layout.unknowns() - 3 * static_cast<int>(bubbles);
}

}  // namespace tunica::full3d
