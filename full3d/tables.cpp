// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/quadrature.hpp"

namespace tunica::full3d {

using element::solid::Local;
using element::solid::Rule;
using element::solid::Shapes;
using element::solid::shapes_at;

namespace {

/// Gauss-Legendre points across a wall cell through which a front of recruitment may move. The error
/// that it makes falls with the square of their number; they are cheaper than cells.
constexpr int front_points = 6;

Rule front_rule(Basis basis, int across) {
  Rule rule;
  const auto along = gauss_legendre(basis == Basis::linear ? 2 : 3);
  for (const auto& a : gauss_legendre(front_points))
    for (const auto& b : along)
      for (const auto& c : along) {
        Local point{};
        point[across] = a.position;
        point[(across + 1) % 3] = b.position;
        point[(across + 2) % 3] = c.position;
        rule.points.push_back(point);
        rule.weights.push_back(a.weight * b.weight * c.weight);
      }
  return rule;
}

template <int Width>
void lift_shapes(const Shapes& shapes, const PlacedShapes& at, kernel::Lifted<Frame, Width>& lifted) {
  for (int k = 0; k < shapes.count; ++k) {
    const auto all = Frame::lift(shapes.value[k], at.slope(shapes.slope[k]), at.place);
    for (int a = 0; a < Frame::lifts; ++a) lifted.lift[a][k] = all[a];
  }
}

void require_positive(const PlacedShapes& at, int cell) {
  if (at.determinant > 0) return;
  throw InvalidInput(fmt::format(
      "mesh: cell {} is inverted or degenerate at x = {:.6g}, y = {:.6g}, z = {:.6g} cm; repair it in the "
      "mesh generator",
      cell, at.place[0], at.place[1], at.place[2]));
}

}  // namespace

Point PlacedShapes::slope(const Local& local) const {
  Point slope;
  for (int i = 0; i < 3; ++i)
    slope[i] = local[0] * inverse[0][i] + local[1] * inverse[1][i] + local[2] * inverse[2][i];
  return slope;
}

PlacedShapes placed(const Mesh& mesh, int cell, const Shapes& geometry) {
  PlacedShapes at;
  double j[3][3] = {};
  const Basis basis = geometry.count == element::solid::shape_count(mesh.shape, Basis::quadratic)
                          ? Basis::quadratic
                          : Basis::linear;
  for (int k = 0; k < geometry.count; ++k) {
    const Point& x = mesh.points[mesh.node(cell, basis, k)];
    for (int i = 0; i < 3; ++i) {
      at.place[i] += geometry.value[k] * x[i];
      for (int c = 0; c < 3; ++c) j[i][c] += geometry.slope[k][c] * x[i];
    }
  }
  double minors[3][3];
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
      minors[i][c] = j[i1][c1] * j[i2][c2] - j[i1][c2] * j[i2][c1];
    }
  at.determinant = j[0][0] * minors[0][0] + j[0][1] * minors[0][1] + j[0][2] * minors[0][2];
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 3; ++i) at.inverse[c][i] = minors[i][c] / at.determinant;
  return at;
}

bool has_front(const wall::Law<double>& law) {
  const auto& families = wall::families(law);
  return std::any_of(families.begin(), families.end(),
                     [](const auto& family) { return family.activation_squared > 1; });
}

template <int Width, int SideWidth>
auto Tables<Width, SideWidth>::reference(const Rule& rule) const -> std::vector<Reference> {
  const Shape shape = problem_.mesh.shape;
  const Element element = problem_.discretisation.element;
  std::vector<Reference> all;
  for (std::size_t q = 0; q < rule.points.size(); ++q)
    all.push_back({shapes_at(shape, displacement_basis(element), rule.points[q]),
                   shapes_at(shape, velocity_basis(element), rule.points[q]),
                   shapes_at(shape, Basis::linear, rule.points[q]), rule.points[q], rule.weights[q]});
  return all;
}

template <int Width, int SideWidth>
Tables<Width, SideWidth>::Tables(const Problem& problem) : problem_(problem) {
  const Mesh& mesh = problem.mesh;
  const Element element = problem.discretisation.element;
  const Basis basis = displacement_basis(element);
  affine_ = mesh.shape == Shape::tetrahedron && basis == Basis::linear;
  blood_ = reference(element::solid::cell_rule(mesh.shape, velocity_basis(element)));
  wall_[0] = reference(element::solid::cell_rule(mesh.shape, basis));
  if (mesh.shape == Shape::hexahedron)
    for (int d = 0; d < 3; ++d) wall_[1 + d] = reference(front_rule(basis, d));
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    for (const Reference& r : mesh.cells[cell].part == Part::blood ? blood_ : wall_[0])
      require_positive(placed(mesh, cell, r.displacement), cell);
  held_.assign(mesh.cells.size(), false);
  for (const Face& face : mesh.faces) {
    const auto& fixed = problem.on(face.boundary).displacement;
    if (fixed[0] && fixed[1] && fixed[2]) held_[face.cell] = true;
  }
  wall_rules_.assign(mesh.cells.size(), 0);
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    if (mesh.cells[cell].part == Part::wall) wall_rules_[cell] = static_cast<signed char>(wall_rule(cell));
}

template <int Width, int SideWidth>
int Tables<Width, SideWidth>::wall_rule(int cell) const {
  const Mesh& mesh = problem_.mesh;
  if (mesh.shape == Shape::tetrahedron || !has_front(problem_.laws[mesh.cells[cell].layer])) return 0;
  const Image centre = image(mesh, cell, {0, 0, 0});
  const auto axes = problem_.directions(cell, {0, 0, 0}, centre.point);
  const Vector<double> across = cross(axes.circumferential, axes.axial);
  int best = 0;
  double greatest = -1;
  for (int d = 0; d < 3; ++d) {
    double along = 0, square = 0;
    for (int i = 0; i < 3; ++i) {
      along += across[i] * centre.slope[i][d];
      square += centre.slope[i][d] * centre.slope[i][d];
    }
    const double cosine = std::abs(along) / std::sqrt(square);
    if (cosine > greatest) {
      greatest = cosine;
      best = d;
    }
  }
  return 1 + best;
}

template <int Width, int SideWidth>
int Tables<Width, SideWidth>::pressure_terms(int cell) const {
  const Element element = problem_.discretisation.element;
  // Strain is singular where held faces end. Quadratic cells there would buckle within themselves, their
  // volume being bounded in the mean, and need no help against locking.
  const bool mixed =
      coupled::mixes(problem_.discretisation, problem_.laws[problem_.mesh.cells[cell].layer]) &&
      !(held_[cell] && element == Element::quadratic);
  if (!mixed) return 0;
  return element == Element::quadratic ? kernel::max_pressure_terms<Frame> : 1;
}

template <int Width, int SideWidth>
PlacedShapes Tables<Width, SideWidth>::placed_at(int cell, const Reference& reference, bool is_first,
                                                 const PlacedShapes& first) const {
  if (is_first || !affine_) return placed(problem_.mesh, cell, reference.displacement);
  PlacedShapes at = first;
  at.place = {};
  for (int k = 0; k < reference.displacement.count; ++k) {
    const Point& x = problem_.mesh.points[problem_.mesh.cells[cell].nodes[k]];
    for (int i = 0; i < 3; ++i) at.place[i] += reference.displacement.value[k] * x[i];
  }
  return at;
}

template <int Width, int SideWidth>
void Tables<Width, SideWidth>::blood(int cell, std::vector<BloodPoint>& points) const {
  points.assign(blood_.size(), {});
  const bool same = problem_.discretisation.element != Element::bubble;
  PlacedShapes at;
  for (std::size_t q = 0; q < blood_.size(); ++q) {
    const Reference& r = blood_[q];
    BloodPoint& point = points[q];
    at = placed_at(cell, r, q == 0, at);
    point.weight = r.weight * at.determinant;
    point.place = at.place;
    lift_shapes(r.displacement, at, point.displacement);
    if (same)
      point.velocity = point.displacement;
    else
      lift_shapes(r.velocity, at, point.velocity);
    lift_shapes(r.pressure, at, point.pressure);
  }
}

template <int Width, int SideWidth>
void Tables<Width, SideWidth>::wall(int cell, std::vector<WallPoint>& points) const {
  const auto& rule = wall_[wall_rules_[cell]];
  points.assign(rule.size(), {});
  PlacedShapes at;
  for (std::size_t q = 0; q < rule.size(); ++q) {
    const Reference& r = rule[q];
    WallPoint& point = points[q];
    at = placed_at(cell, r, q == 0, at);
    point.weight = r.weight * at.determinant;
    point.place = at.place;
    lift_shapes(r.displacement, at, point.displacement);
    point.pressure[0] = 1;
    for (int d = 0; d < 3; ++d) point.pressure[1 + d] = r.local[d];
    point.axes = problem_.directions(cell, r.local, at.place);
  }
}

template <int Width, int SideWidth>
void Tables<Width, SideWidth>::side(const Face& face, std::vector<SidePoint>& points) const {
  const Mesh& mesh = problem_.mesh;
  const Basis basis = displacement_basis(problem_.discretisation.element);
  const auto rule = element::solid::face_rule(mesh.shape, basis, face.face);
  const auto nodes = element::solid::face_nodes(mesh.shape, basis, face.face);
  points.assign(rule.points.size(), {});
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const Shapes shapes = shapes_at(mesh.shape, basis, rule.points[q]);
    SidePoint& point = points[q];
    Vector<double> along[2] = {};
    std::vector<std::array<double, 2>> slopes(nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Point& x = mesh.points[mesh.node(face.cell, basis, nodes[k])];
      for (int s = 0; s < 2; ++s)
        for (int c = 0; c < 3; ++c) slopes[k][s] += shapes.slope[nodes[k]][c] * rule.directions[s][c];
      for (int i = 0; i < 3; ++i) {
        point.place[i] += shapes.value[nodes[k]] * x[i];
        for (int s = 0; s < 2; ++s) along[s][i] += slopes[k][s] * x[i];
      }
    }
    const Vector<double> area = cross(along[0], along[1]);
    const double size = std::sqrt(dot(area, area));
    point.weight = rule.weights[q] * size;
    for (int i = 0; i < 3; ++i) point.normal[i] = area[i] / size;
    // Vectors in the surface whose products with the tangents are 1 and 0.
    const Vector<double> dual[2] = {cross(along[1], point.normal), cross(point.normal, along[0])};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      Point slope{};
      for (int i = 0; i < 3; ++i) slope[i] = (slopes[k][0] * dual[0][i] + slopes[k][1] * dual[1][i]) / size;
      const auto all = Frame::lift(shapes.value[nodes[k]], slope, point.place);
      for (int a = 0; a < Frame::lifts; ++a) point.shapes.lift[a][k] = all[a];
    }
  }
}

template <int Width, int SideWidth>
double Tables<Width, SideWidth>::size(const std::vector<BloodPoint>& points) const {
  double volume = 0;
  for (const auto& point : points) volume += point.weight;
  return std::cbrt(6 * volume / std::numbers::pi);
}

template <int Width, int SideWidth>
kernel::Lifted<Frame, Width> Tables<Width, SideWidth>::displacement_at(int cell, const Local& local) const {
  const Shapes shapes =
      shapes_at(problem_.mesh.shape, displacement_basis(problem_.discretisation.element), local);
  kernel::Lifted<Frame, Width> lifted;
  lift_shapes(shapes, placed(problem_.mesh, cell, shapes), lifted);
  return lifted;
}

template class Tables<28, 12>;
template class Tables<12, 8>;
template class Tables<8, 4>;

}  // namespace tunica::full3d
