// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/meeting.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::axisym {

namespace {

using element::Local;

constexpr double tolerance = 1e-7;

/// How far along a side (0 to 1) a local point lies, and how far away from it.
struct AlongSide {
  double along, away;
};
AlongSide along_side(CellShape shape, int side, const Local& x) {
  const auto [first, second, middle] = element::side_nodes(shape, side);
  const Local a = element::node_position(shape, first), b = element::node_position(shape, second);
  const Local t{b[0] - a[0], b[1] - a[1]}, d{x[0] - a[0], x[1] - a[1]};
  const double square = t[0] * t[0] + t[1] * t[1];
  return {(t[0] * d[0] + t[1] * d[1]) / square, std::abs(t[0] * d[1] - t[1] * d[0]) / std::sqrt(square)};
}

std::vector<Place> around_corner(const Mesh& mesh, Part part, int node) {
  std::vector<Place> places;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (mesh.cells[cell].part != part) continue;
    for (int k = 0; k < mesh.corners(); ++k)
      if (mesh.cells[cell].nodes[k] == node) places.push_back({cell, element::node_position(mesh.shape, k)});
  }
  return places;
}

/// Cells along a side; the point divides it from its first to its second corner as `along` does.
std::vector<Place> beside(const Mesh& mesh, Part part, int first, int second, double along) {
  std::vector<Place> places;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (mesh.cells[cell].part != part) continue;
    for (int side = 0; side < mesh.sides(); ++side) {
      const auto nodes = mesh.side_nodes(cell, side);
      const bool same = nodes[0] == first && nodes[1] == second;
      if (!same && !(nodes[0] == second && nodes[1] == first)) continue;
      const auto local = element::side_nodes(mesh.shape, side);
      const Local a = element::node_position(mesh.shape, local[0]);
      const Local b = element::node_position(mesh.shape, local[1]);
      const double s = same ? along : 1 - along;
      places.push_back({cell, {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])}});
    }
  }
  return places;
}

}  // namespace

bool on_side(CellShape shape, int side, const Local& local) {
  const AlongSide at = along_side(shape, side, local);
  return at.away < tolerance && at.along > -tolerance && at.along < 1 + tolerance;
}

std::vector<Place> meeting_places(const Mesh& mesh, const Place& place) {
  const Part part = mesh.cells[place.cell].part;
  for (int side = 0; side < mesh.sides(); ++side) {
    if (!on_side(mesh.shape, side, place.local)) continue;
    const auto nodes = mesh.side_nodes(place.cell, side);
    const double along = along_side(mesh.shape, side, place.local).along;
    if (along < tolerance) return around_corner(mesh, part, nodes[0]);
    if (along > 1 - tolerance) return around_corner(mesh, part, nodes[1]);
    return beside(mesh, part, nodes[0], nodes[1], along);
  }
  return {place};
}

std::vector<Place> in_innermost_layer(const Mesh& mesh, std::vector<Place> places) {
  int innermost = mesh.cells[places.front().cell].layer;
  for (const Place& place : places) innermost = std::min(innermost, mesh.cells[place.cell].layer);
  std::erase_if(places, [&](const Place& place) { return mesh.cells[place.cell].layer != innermost; });
  return places;
}

}  // namespace tunica::axisym
