// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace tunica::axisym {

std::array<int, 3> Mesh::side_nodes(int cell, int side) const {
  std::array<int, 3> nodes = element::side_nodes(shape, side);
  for (int& node : nodes) node = cells[cell].nodes[node];
  return nodes;
}

bool Mesh::has(Part part) const {
  return std::any_of(cells.begin(), cells.end(), [part](const Cell& cell) { return cell.part == part; });
}

int Mesh::layers() const {
  int count = 0;
  for (const Cell& cell : cells)
    if (cell.part == Part::wall) count = std::max(count, cell.layer + 1);
  return count;
}

Image image(const Mesh& mesh, int cell, const element::Local& local) {
  const element::Shapes shapes = element::shapes_at(mesh.shape, element::Basis::quadratic, local);
  Image at;
  for (int n = 0; n < shapes.count; ++n) {
    const auto& node = mesh.points[mesh.cells[cell].nodes[n]];
    for (int i = 0; i < 2; ++i) {
      at.point[i] += shapes.value[n] * node[i];
      for (int c = 0; c < 2; ++c) at.slope[i][c] += shapes.slope[n][c] * node[i];
    }
  }
  return at;
}

namespace {

/// Half way between the lowest and the highest node of a boundary; NaN without sides.
double middle_height(const Mesh& mesh, Boundary boundary) {
  double low = INFINITY, high = -INFINITY;
  for (const Edge& edge : mesh.edges) {
    if (edge.boundary != boundary) continue;
    for (const int node : mesh.side_nodes(edge.cell, edge.side)) {
      low = std::min(low, mesh.points[node][1]);
      high = std::max(high, mesh.points[node][1]);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

Extent extent(const Mesh& mesh) {
  if (mesh.has(Part::blood))
    return {middle_height(mesh, Boundary::inlet), middle_height(mesh, Boundary::outlet)};
  return {middle_height(mesh, Boundary::wall_inlet), middle_height(mesh, Boundary::wall_outlet)};
}

double inlet_radius(const Mesh& mesh) {
  const bool blood = mesh.has(Part::blood);
  double radius = blood ? 0 : INFINITY;
  for (const Edge& edge : mesh.edges) {
    if (edge.boundary != (blood ? Boundary::inlet : Boundary::wall_inlet)) continue;
    for (const int node : mesh.side_nodes(edge.cell, edge.side)) {
      const double r = mesh.points[node][0];
      radius = blood ? std::max(radius, r) : std::min(radius, r);
    }
  }
  return radius;
}

std::vector<int> neighbours(const Mesh& mesh) {
  struct Side {
    int low, high, index;
  };
  const int sides = mesh.sides();
  std::vector<Side> all;
  all.reserve(mesh.cells.size() * sides);
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    for (int side = 0; side < sides; ++side) {
      const auto nodes = mesh.side_nodes(cell, side);
      all.push_back({std::min(nodes[0], nodes[1]), std::max(nodes[0], nodes[1]), cell * sides + side});
    }
  }
  std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.index) < std::tie(b.low, b.high, b.index);
  });
  const auto same = [&](std::size_t i, std::size_t k) {
    return k < all.size() && all[i].low == all[k].low && all[i].high == all[k].high;
  };
  std::vector<int> across(all.size(), -1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!same(i, i + 1)) continue;
    if (same(i, i + 2)) throw std::logic_error("neighbours: more than two cells share a side");
    across[all[i].index] = all[i + 1].index / sides;
    across[all[i + 1].index] = all[i].index / sides;
    ++i;
  }
  return across;
}

}  // namespace tunica::axisym
