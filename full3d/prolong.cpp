// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/prolong.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "full3d/probes.hpp"

namespace tunica::full3d {

namespace {

/// The place of a point or, where it lies beside the mesh, of the nearest of some points between it and the
/// centre of the part's nearest cell.
std::optional<Place> place_near(const Mesh& mesh, const Locator& locator, const Point& point, Part part) {
  if (auto place = locator.find(point, part)) return place;
  int nearest = -1;
  double least = 0;
  Point centre{};
  const element::solid::Local middle = mesh.shape == Shape::hexahedron
                                           ? element::solid::Local{0, 0, 0}
                                           : element::solid::Local{0.25, 0.25, 0.25};
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (mesh.cells[cell].part != part) continue;
    const Point x = image(mesh, cell, middle).point;
    double square = 0;
    for (int i = 0; i < 3; ++i) square += (x[i] - point[i]) * (x[i] - point[i]);
    if (nearest >= 0 && square >= least) continue;
    nearest = cell;
    least = square;
    centre = x;
  }
  // A curved boundary and its image by quadratic cells of an eighth of the circle are 0.2 % of the radius
  // apart, by flat ones 8 %.
  for (double share = 1e-4; share < 0.5; share *= 2) {
    Point moved;
    for (int i = 0; i < 3; ++i) moved[i] = point[i] + share * (centre[i] - point[i]);
    if (auto place = locator.find(moved, part)) return place;
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

std::vector<Place> places_of(const Problem& from, const Problem& to, const std::vector<int>& nodes,
                             Part part) {
  const Locator locator(from.mesh);
  std::vector<Place> places;
  for (const int node : nodes) {
    const auto place = place_near(from.mesh, locator, to.mesh.points[node], part);
    if (!place) throw std::logic_error("prolong: the meshes are not of the same vessel");
    places.push_back(*place);
  }
  return places;
}

}  // namespace

std::vector<double> prolong(const Problem& from, const Layout& from_layout, std::span<const double> y,
                            const Problem& to, const Layout& to_layout) {
  std::vector<double> state(to_layout.size(), 0.0);
  // On the interface both parts have the same values.
  if (to.mesh.has(Part::wall)) {
    const auto nodes = nodes_of(to, Part::wall);
    const auto strains =
        wall_probe(from, from_layout, places_of(from, to, nodes, Part::wall), false)->strains(y);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (int c = 0; c < 3; ++c) state[to_layout.displacement(nodes[k], c)] = strains[k].displacement[c];
  }
  if (to.mesh.has(Part::blood)) {
    const auto nodes = nodes_of(to, Part::blood);
    const auto samples = blood_probe(from, from_layout, places_of(from, to, nodes, Part::blood))->samples(y);
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
