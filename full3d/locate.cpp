// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/locate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tunica::full3d {

using element::solid::Basis;
using element::solid::Local;

namespace {

constexpr double tolerance = 1e-9;    // of a cell's size
constexpr double on_boundary = 1e-7;  // of local coordinates
constexpr double most_bins = 4e6;

Basis map_basis(const Mesh& mesh) {
  return mesh.quadratic ? Basis::quadratic : Basis::linear;
}

int corners(const Mesh& mesh) {
  return element::solid::shape_count(mesh.shape, Basis::linear);
}

/// A quadratic map lies within the hull of its Bezier points, which a cell's nodes are turned into.
std::vector<Point> bezier_points(const Mesh& mesh, int cell) {
  std::vector<Point> points;
  for (int k = 0; k < element::solid::shape_count(mesh.shape, map_basis(mesh)); ++k)
    points.push_back(mesh.points[mesh.node(cell, map_basis(mesh), k)]);
  if (!mesh.quadratic) return points;
  const auto turn = [&](int a, int m, int b) {
    for (int i = 0; i < 3; ++i) points[m][i] = 2 * points[m][i] - 0.5 * (points[a][i] + points[b][i]);
  };
  if (mesh.shape == Shape::tetrahedron) {
    constexpr std::array<std::array<int, 2>, 6> edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
    for (int e = 0; e < 6; ++e) turn(edges[e][0], 4 + e, edges[e][1]);
    return points;
  }
  for (const int stride : {1, 3, 9})
    for (int k = 0; k < 27; ++k)
      if (k / stride % 3 == 1) turn(k - stride, k, k + stride);
  return points;
}

bool inside(Shape shape, const Local& x) {
  if (shape == Shape::hexahedron)
    return std::all_of(x.begin(), x.end(), [](double c) { return std::abs(c) <= 1 + tolerance; });
  return *std::min_element(x.begin(), x.end()) >= -tolerance && x[0] + x[1] + x[2] <= 1 + tolerance;
}

Local clamped(Shape shape, Local x) {
  const double least = shape == Shape::hexahedron ? -1 : 0;
  for (double& coordinate : x) coordinate = std::clamp(coordinate, least, 1.0);
  const double sum = x[0] + x[1] + x[2];
  if (shape == Shape::tetrahedron && sum > 1) {
    for (double& coordinate : x) coordinate /= sum;
    // Rounding may leave the sum above 1 still.
    const auto largest = std::max_element(x.begin(), x.end());
    *largest = std::min(*largest, 1 - (x[0] + x[1] + x[2] - *largest));
  }
  return x;
}

/// The place moved onto what it lies on of the cell's boundary.
Local snapped(Shape shape, Local x) {
  const double least = shape == Shape::hexahedron ? -1 : 0;
  for (double& coordinate : x) {
    if (std::abs(coordinate - least) < on_boundary) coordinate = least;
    if (std::abs(coordinate - 1) < on_boundary) coordinate = 1;
  }
  return x;
}

/// Solves slope step = residual.
Local solve(const Image& at, const Local& residual) {
  const auto& s = at.slope;
  Local step{};
  for (int c = 0; c < 3; ++c) {
    const int d = (c + 1) % 3, e = (c + 2) % 3;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      step[c] += (s[j][d] * s[k][e] - s[j][e] * s[k][d]) * residual[i];
    }
    step[c] /= at.determinant();
  }
  return step;
}

/// Turns counts, one beyond each entry's place, into the places where the entries begin.
void sum_up(std::vector<int>& counts) {
  std::partial_sum(counts.begin(), counts.end(), counts.begin());
}

}  // namespace

double Locator::Box::size() const {
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

void Locator::Box::include(const Point& point) {
  for (int i = 0; i < 3; ++i) {
    low[i] = std::min(low[i], point[i]);
    high[i] = std::max(high[i], point[i]);
  }
}

bool Locator::Box::contains(const Point& point) const {
  const double slack = tolerance * size();
  for (int i = 0; i < 3; ++i)
    if (!(point[i] >= low[i] - slack && point[i] <= high[i] + slack)) return false;
  return true;
}

Locator::Box Locator::bounding_box(int cell) const {
  const auto points = bezier_points(mesh_, cell);
  Box box{points.front(), points.front()};
  for (const Point& point : points) box.include(point);
  return box;
}

int Locator::bin(const Point& point, int direction) const {
  const double extent = whole_.high[direction] - whole_.low[direction];
  const double share = extent > 0 ? (point[direction] - whole_.low[direction]) / extent : 0;
  return static_cast<int>(std::clamp(share * bins_[direction], 0.0, bins_[direction] - 1.0));
}

Locator::Locator(const Mesh& mesh) : mesh_(mesh) {
  const int cells = static_cast<int>(mesh.cells.size());
  for (int cell = 0; cell < cells; ++cell) {
    boxes_.push_back(bounding_box(cell));
    if (cell == 0) whole_ = boxes_[0];
    whole_.include(boxes_[cell].low);
    whole_.include(boxes_[cell].high);
  }
  double volume = 1;
  for (int i = 0; i < 3; ++i) volume *= whole_.high[i] - whole_.low[i];
  const double width = std::cbrt(volume / std::clamp<double>(cells, 1, most_bins));
  for (int i = 0; i < 3; ++i)
    bins_[i] = width > 0 ? static_cast<int>(std::ceil((whole_.high[i] - whole_.low[i]) / width)) : 1;

  const auto each_bin_of = [&](int cell, const auto& visit) {
    Box box = boxes_[cell];
    const double slack = 2 * tolerance * box.size();
    for (int i = 0; i < 3; ++i) {
      box.low[i] -= slack;
      box.high[i] += slack;
    }
    for (int k = bin(box.low, 2); k <= bin(box.high, 2); ++k)
      for (int j = bin(box.low, 1); j <= bin(box.high, 1); ++j)
        for (int i = bin(box.low, 0); i <= bin(box.high, 0); ++i) visit(i + bins_[0] * (j + bins_[1] * k));
  };
  first_in_bin_.assign(static_cast<std::size_t>(bins_[0]) * bins_[1] * bins_[2] + 1, 0);
  for (int cell = 0; cell < cells; ++cell) each_bin_of(cell, [&](int b) { ++first_in_bin_[b + 1]; });
  sum_up(first_in_bin_);
  in_bin_.resize(first_in_bin_.back());
  std::vector<int> next(first_in_bin_);
  for (int cell = 0; cell < cells; ++cell) each_bin_of(cell, [&](int b) { in_bin_[next[b]++] = cell; });

  first_at_node_.assign(mesh.points.size() + 1, 0);
  for (int cell = 0; cell < cells; ++cell)
    for (int k = 0; k < corners(mesh); ++k) ++first_at_node_[mesh.node(cell, Basis::linear, k) + 1];
  sum_up(first_at_node_);
  at_node_.resize(first_at_node_.back());
  next = first_at_node_;
  for (int cell = 0; cell < cells; ++cell)
    for (int k = 0; k < corners(mesh); ++k) at_node_[next[mesh.node(cell, Basis::linear, k)]++] = cell;
}

std::optional<Local> Locator::invert(int cell, const Point& point, const Local& start) const {
  constexpr int most_iterations = 30;
  constexpr double converged = 1e-14;
  Local x = start;
  for (int k = 0; k < most_iterations; ++k) {
    const Image at = image(mesh_, cell, x);
    const Local step = solve(at, {point[0] - at.point[0], point[1] - at.point[1], point[2] - at.point[2]});
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
      if (!std::isfinite(step[i])) return {};
      // The map may fold outside its cell, where no iterate needs to go.
      x[i] = std::clamp(x[i] + step[i], -1.5, 1.5);
      longest = std::max(longest, std::abs(step[i]));
    }
    if (longest < converged) break;
  }
  if (!inside(mesh_.shape, x)) return {};
  // What counts is where it ends: in needle-like cells rounding keeps the steps above `converged`.
  const Point end = image(mesh_, cell, x).point;
  for (int i = 0; i < 3; ++i)
    if (std::abs(end[i] - point[i]) > tolerance * boxes_[cell].size()) return {};
  return clamped(mesh_.shape, x);
}

std::optional<Place> Locator::find(const Point& point, Part part) const {
  if (!whole_.contains(point)) return {};
  const int b = bin(point, 0) + bins_[0] * (bin(point, 1) + bins_[1] * bin(point, 2));
  std::vector<int> candidates;
  for (int k = first_in_bin_[b]; k < first_in_bin_[b + 1]; ++k)
    if (mesh_.cells[in_bin_[k]].part == part && boxes_[in_bin_[k]].contains(point))
      candidates.push_back(in_bin_[k]);
  // Almost all are found from the centre; further starts are tried when no cell has been.
  const Local centre = mesh_.shape == Shape::hexahedron ? Local{0, 0, 0} : Local{0.25, 0.25, 0.25};
  for (const int cell : candidates)
    if (const auto x = invert(cell, point, centre)) return Place{cell, *x};
  const Basis basis = map_basis(mesh_);
  for (const int cell : candidates)
    for (int start = 0; start < element::solid::shape_count(mesh_.shape, basis); ++start)
      if (const auto x = invert(cell, point, element::solid::node_position(mesh_.shape, basis, start)))
        return Place{cell, *x};
  return {};
}

std::vector<Place> Locator::meeting(const Place& place) const {
  // The corners of the face, edge or cell that the place lies within are those with a weight; where cells
  // meet, each has these corners, and the place has the same weights.
  auto weights =
      element::solid::shapes_at(mesh_.shape, Basis::linear, snapped(mesh_.shape, place.local)).value;
  if (mesh_.shape == Shape::tetrahedron && std::abs(weights[0]) < on_boundary) weights[0] = 0;
  std::vector<int> nodes;
  std::vector<double> shares;
  for (int k = 0; k < corners(mesh_); ++k) {
    if (weights[k] == 0) continue;
    nodes.push_back(mesh_.node(place.cell, Basis::linear, k));
    shares.push_back(weights[k]);
  }
  if (static_cast<int>(nodes.size()) == corners(mesh_)) return {place};
  const Part part = mesh_.cells[place.cell].part;
  std::vector<Place> places;
  for (int index = first_at_node_[nodes[0]]; index < first_at_node_[nodes[0] + 1]; ++index) {
    const int cell = at_node_[index];
    if (mesh_.cells[cell].part != part) continue;
    Local local{};
    std::size_t found = 0;
    for (int k = 0; k < corners(mesh_); ++k) {
      const auto at = std::find(nodes.begin(), nodes.end(), mesh_.node(cell, Basis::linear, k));
      if (at == nodes.end()) continue;
      ++found;
      const Local corner = element::solid::node_position(mesh_.shape, Basis::linear, k);
      for (int i = 0; i < 3; ++i) local[i] += shares[at - nodes.begin()] * corner[i];
    }
    if (found == nodes.size()) places.push_back({cell, clamped(mesh_.shape, local)});
  }
  return places;
}

}  // namespace tunica::full3d
