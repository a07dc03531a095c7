// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/prolong.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "full3d/probes.hpp"

namespace tunica::full3d {

namespace {

/// The place of a point or, where it lies beside the mesh, of the nearest of some points between it and the
/// middle of the wall or the centreline.
std::optional<Place> place_near(const VesselShape& shape, const Locator& locator, const Point& point,
                                Part part) {
  if (auto place = locator.find(point, part)) return place;
  const VesselShape::Local at = shape.local(point);
  const double radius = std::hypot(at.x, at.y);
  const double target = part == Part::wall ? shape.radius + 0.5 * shape.thickness : 0;
  // A circle and its image by quadratic cells of an eighth of it are 0.2 % of the radius apart, by flat ones
  // 8 %; long cells in a bend leave out as much.
  for (double share = 1e-4; share < 1; share *= 1.5) {
    const double scale = 1 + share * (target / radius - 1);
    if (auto place = locator.find(shape.place({scale * at.x, scale * at.y, at.s}), part)) return place;
  }
  return {};
}

/// Nodes of a part that have a displacement.
std::vector<int> nodes_of(const Problem& problem, Part part) {
  const Mesh& mesh = problem.mesh;
  const Basis basis = displacement_basis(problem.discretisation.element);
  std::vector<bool> taken(mesh.points.size(), false);
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    if (mesh.cells[cell].part == part)
      for (int k = 0; k < element::solid::shape_count(mesh.shape, basis); ++k)
        taken[mesh.node(cell, basis, k)] = true;
  std::vector<int> nodes;
  for (int node = 0; node < static_cast<int>(taken.size()); ++node)
    if (taken[node]) nodes.push_back(node);
  return nodes;
}

std::vector<Place> places_of(const VesselShape& shape, const Problem& from, const Problem& to,
                             const std::vector<int>& nodes, Part part) {
  const Locator locator(from.mesh);
  std::vector<Place> places;
  for (const int node : nodes) {
    const auto place = place_near(shape, locator, to.mesh.points[node], part);
    if (!place) throw std::logic_error("prolong: the meshes are not of the same vessel");
    places.push_back(*place);
  }
  return places;
}

}  // namespace

std::vector<double> prolong(const VesselShape& shape, const Problem& from, const Layout& from_layout,
                            std::span<const double> y, const Problem& to, const Layout& to_layout) {
  std::vector<double> state(to_layout.size(), 0.0);
  // On the interface both parts have the same values.
  if (to.mesh.has(Part::wall)) {
    const auto nodes = nodes_of(to, Part::wall);
    const auto strains =
        wall_probe(from, from_layout, places_of(shape, from, to, nodes, Part::wall), false)->strains(y);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (int c = 0; c < 3; ++c) state[to_layout.displacement(nodes[k], c)] = strains[k].displacement[c];
  }
  if (to.mesh.has(Part::blood)) {
    const auto nodes = nodes_of(to, Part::blood);
    const auto samples =
        blood_probe(from, from_layout, places_of(shape, from, to, nodes, Part::blood))->samples(y);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (int c = 0; c < 3; ++c) {
        state[to_layout.displacement(nodes[k], c)] = samples[k].displacement[c];
        state[to_layout.velocity(nodes[k], c)] = samples[k].velocity[c];
      }
      if (to_layout.has_pressure(nodes[k])) state[to_layout.pressure(nodes[k])] = samples[k].pressure;
    }
  }
  std::copy(y.begin() + static_cast<std::ptrdiff_t>(from_layout.scalar_begin()), y.end(),
            state.begin() + static_cast<std::ptrdiff_t>(to_layout.scalar_begin()));
  return state;
}

}  // namespace tunica::full3d
