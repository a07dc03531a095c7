// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/locate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"
#include "core/quadrature.hpp"

namespace tunica::axisym {

namespace {

using element::Local;

constexpr double tolerance = 1e-9;  // of a cell's size

struct Box {
  Local low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};

  void include(double r, double z) {
    low = {std::min(low[0], r), std::min(low[1], z)};
    high = {std::max(high[0], r), std::max(high[1], z)};
  }
  double size() const { return std::max(high[0] - low[0], high[1] - low[1]); }
  bool contains(const Local& point) const {
    const double slack = tolerance * size();
    return point[0] >= low[0] - slack && point[0] <= high[0] + slack && point[1] >= low[1] - slack &&
           point[1] <= high[1] + slack;
  }
};

/// A parabola lies within its Bezier polygon a, 2m - (a + b)/2, b, and a cell within its sides.
Box bounding_box(const Mesh& mesh, int cell) {
  Box box;
  for (int side = 0; side < mesh.sides(); ++side) {
    const auto nodes = mesh.side_nodes(cell, side);
    const auto &a = mesh.points[nodes[0]], &b = mesh.points[nodes[1]], &m = mesh.points[nodes[2]];
    box.include(a[0], a[1]);
    box.include(2 * m[0] - 0.5 * (a[0] + b[0]), 2 * m[1] - 0.5 * (a[1] + b[1]));
  }
  return box;
}

bool inside(CellShape shape, const Local& x, double slack) {
  if (shape == CellShape::quadrilateral) return std::abs(x[0]) <= 1 + slack && std::abs(x[1]) <= 1 + slack;
  return x[0] >= -slack && x[1] >= -slack && x[0] + x[1] <= 1 + slack;
}

Local clamped(CellShape shape, Local x) {
  const double least = shape == CellShape::quadrilateral ? -1 : 0;
  for (double& coordinate : x) coordinate = std::clamp(coordinate, least, 1.0);
  if (shape == CellShape::triangle && x[0] + x[1] > 1) {
    const double sum = x[0] + x[1];
    x = {x[0] / sum, 1 - x[0] / sum};
  }
  return x;
}

/// Newton's method from one start; nothing if it does not end inside the cell.
std::optional<Local> invert_from(const Mesh& mesh, int cell, const Box& box, const Local& point, Local x) {
  constexpr int most_iterations = 30;
  constexpr double converged = 1e-14;
  for (int k = 0; k < most_iterations; ++k) {
    const Image at = image(mesh, cell, x);
    const Local residual{point[0] - at.point[0], point[1] - at.point[1]};
    const Local step{(at.slope[1][1] * residual[0] - at.slope[0][1] * residual[1]) / at.determinant(),
                     (at.slope[0][0] * residual[1] - at.slope[1][0] * residual[0]) / at.determinant()};
    if (!std::isfinite(step[0]) || !std::isfinite(step[1])) return {};
    // The map may fold outside its cell, where no iterate needs to go.
    for (int i = 0; i < 2; ++i) x[i] = std::clamp(x[i] + step[i], -1.5, 1.5);
    if (std::max(std::abs(step[0]), std::abs(step[1])) < converged) break;
  }
  if (!inside(mesh.shape, x, tolerance)) return {};
  // What counts is where it ends: in needle-like cells rounding keeps the steps above `converged`.
  const Local end = image(mesh, cell, x).point;
  for (int i = 0; i < 2; ++i)
    if (std::abs(end[i] - point[i]) > tolerance * box.size()) return {};
  return clamped(mesh.shape, x);
}

std::optional<Local> invert(const Mesh& mesh, int cell, const Local& point) {
  const Box box = bounding_box(mesh, cell);
  if (!box.contains(point)) return {};
  for (int start = mesh.centre_node(); start >= 0; --start)
    if (const auto x = invert_from(mesh, cell, box, point, element::node_position(mesh.shape, start)))
      return x;
  return {};
}

/// Radii at which a side passes through the height z.
void cross(const Mesh& mesh, int cell, int side, double z, std::vector<double>& radii) {
  const auto nodes = mesh.side_nodes(cell, side);
  const auto &a = mesh.points[nodes[0]], &b = mesh.points[nodes[1]], &m = mesh.points[nodes[2]];
  // Along s in [0, 1] a coordinate is c0 + c1 s + c2 s^2.
  const auto linear = [&](int i) { return 4 * m[i] - 3 * a[i] - b[i]; };
  const auto square = [&](int i) { return 2 * (a[i] + b[i]) - 4 * m[i]; };
  const double c0 = a[1] - z, c1 = linear(1), c2 = square(1);
  const double size = std::max(std::abs(b[1] - a[1]), std::abs(m[1] - a[1]));
  if (std::min({a[1], b[1], 2 * m[1] - 0.5 * (a[1] + b[1])}) > z + tolerance * size ||
      std::max({a[1], b[1], 2 * m[1] - 0.5 * (a[1] + b[1])}) < z - tolerance * size)
    return;
  const auto add = [&](double s) {
    if (!(s >= -tolerance && s <= 1 + tolerance)) return;
    s = std::clamp(s, 0.0, 1.0);
    radii.push_back(a[0] + s * (linear(0) + s * square(0)));
  };
  const double discriminant = c1 * c1 - 4 * c0 * c2;
  const double q = -0.5 * (c1 + std::copysign(std::sqrt(std::max(discriminant, 0.0)), c1));
  if (q == 0 && c2 == 0) {  // the side lies in the plane
    add(0);
    add(1);
    return;
  }
  if (q != 0) add(c0 / q);
  if (c2 != 0) add(q / c2);
}

/// `low`, those in between that are more than `apart` from each other, `high`.
std::vector<double> between(double low, double high, std::vector<double> radii, double apart) {
  std::sort(radii.begin(), radii.end());
  std::vector<double> kept{low};
  for (const double radius : radii)
    if (radius > kept.back() + apart && radius < high - apart) kept.push_back(radius);
  kept.push_back(high);
  return kept;
}

}  // namespace

std::optional<Place> locate(const Mesh& mesh, std::array<double, 2> point, Part part) {
  for (int k = 0; k < static_cast<int>(mesh.cells.size()); ++k) {
    if (mesh.cells[k].part != part) continue;
    if (const auto x = invert(mesh, k, point)) return Place{k, *x};
  }
  return {};
}

Section section_at(const Mesh& mesh, double z) {
  std::vector<double> interface, surfaces;
  for (const Edge& edge : mesh.edges) {
    if (edge.boundary == Boundary::interface) cross(mesh, edge.cell, edge.side, z, interface);
    if (edge.boundary == Boundary::outer) cross(mesh, edge.cell, edge.side, z, surfaces);
  }
  if (interface.empty()) {
    const Extent ends = extent(mesh);
    throw InvalidInput(
        fmt::format("the plane z = {:g} cm does not cut the vessel; choose a height from {:g} to {:g} cm", z,
                    ends.inlet, ends.outlet));
  }
  Section section{z, *std::min_element(interface.begin(), interface.end()), 0, {}, {}};
  const double apart = tolerance * section.inner;
  section.outer = section.inner;
  if (mesh.has(Part::wall)) {
    // Where a bulge hangs over, the plane may meet the lumen again before it leaves the vessel.
    surfaces.insert(surfaces.end(), interface.begin(), interface.end());
    section.outer = INFINITY;
    for (const double radius : surfaces)
      if (radius > section.inner + apart) section.outer = std::min(section.outer, radius);
  }
  std::vector<double> blood, wall;
  for (int k = 0; k < static_cast<int>(mesh.cells.size()); ++k)
    for (int side = 0; side < mesh.sides(); ++side)
      cross(mesh, k, side, z, mesh.cells[k].part == Part::blood ? blood : wall);
  if (mesh.has(Part::blood)) section.blood = between(0, section.inner, std::move(blood), apart);
  if (mesh.has(Part::wall)) section.wall = between(section.inner, section.outer, std::move(wall), apart);
  return section;
}

std::vector<SectionPoint> section_rule(const Mesh& mesh, const Section& section, Part part, int points) {
  const std::vector<double>& radii = part == Part::blood ? section.blood : section.wall;
  const auto rule = gauss_legendre(points);
  std::vector<SectionPoint> all;
  for (std::size_t i = 1; i < radii.size(); ++i) {
    const double half = 0.5 * (radii[i] - radii[i - 1]);
    for (const auto& [position, weight] : rule) {
      const double radius = radii[i - 1] + half * (1 + position);
      const auto place = locate(mesh, {radius, section.height}, part);
      if (!place) throw std::logic_error("section_rule: the section belongs to another mesh");
      all.push_back({radius, half * weight, *place});
    }
  }
  return all;
}

}  // namespace tunica::axisym
