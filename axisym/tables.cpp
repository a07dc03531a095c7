// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "core/coupled/wall_strain.hpp"
#include "core/error.hpp"
#include "core/quadrature.hpp"

namespace tunica::axisym {

namespace {

using element::Basis;
using element::Shapes;

/// Gauss-Legendre points across a wall cell through which a front of recruitment may move.
constexpr int front_points = 6;

Basis geometry_basis(Element element) {
  return element == Element::quadratic ? Basis::quadratic : Basis::linear;
}
Basis velocity_basis(Element element) {
  return element == Element::bubble ? Basis::linear_bubble : geometry_basis(element);
}

/// The map from local coordinates to (r, z) at a point.
struct Map {
  Point place{};
  double jacobian[2][2] = {};  ///< d(place i)/d(local j)
  double determinant = 0;

  Map(const Mesh& mesh, const Cell& cell, const Shapes& shapes) {
    for (int k = 0; k < shapes.count; ++k) {
      const auto& x = mesh.points[cell.nodes[k]];
      for (int i = 0; i < 2; ++i) {
        place[i] += shapes.value[k] * x[i];
        for (int j = 0; j < 2; ++j) jacobian[i][j] += shapes.slope[k][j] * x[i];
      }
    }
    determinant = jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0];
  }

  /// Derivatives by (r, z) from those by the local coordinates.
  std::array<double, 2> slope(const element::Local& local) const {
    return {(jacobian[1][1] * local[0] - jacobian[1][0] * local[1]) / determinant,
            (jacobian[0][0] * local[1] - jacobian[0][1] * local[0]) / determinant};
  }
};

kernel::Lifted<Frame, cell_width> lift_shapes(const Shapes& shapes, const Map& map) {
  kernel::Lifted<Frame, cell_width> lifted;
  for (int k = 0; k < shapes.count; ++k) {
    const auto all = Frame::lift(shapes.value[k], map.slope(shapes.slope[k]), map.place);
    for (int a = 0; a < Frame::lifts; ++a) lifted.lift[a][k] = all[a];
  }
  return lifted;
}

void require_positive(const Map& map, int cell) {
  if (map.determinant > 0) return;
  throw InvalidInput(fmt::format(
      "mesh: cell {} is inverted or degenerate at r = {:.6g}, z = {:.6g} cm; repair it in the mesh generator",
      cell, map.place[0], map.place[1]));
}

BloodTable blood_table(const Problem& problem, int index) {
  const Mesh& mesh = problem.mesh;
  const Cell& cell = mesh.cells[index];
  const Element element = problem.discretisation.element;
  const auto rule = element::cell_rule(mesh.shape, velocity_basis(element));
  BloodTable table{index, 0, {}};
  double area = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const Shapes geometry = element::shapes_at(mesh.shape, geometry_basis(element), rule.points[q]);
    const Map map(mesh, cell, geometry);
    require_positive(map, index);
    BloodPoint point;
    point.weight = rule.weights[q] * map.determinant * Frame::measure(map.place);
    point.place = map.place;
    point.displacement = lift_shapes(geometry, map);
    point.velocity =
        lift_shapes(element::shapes_at(mesh.shape, velocity_basis(element), rule.points[q]), map);
    point.pressure = lift_shapes(element::shapes_at(mesh.shape, Basis::linear, rule.points[q]), map);
    area += rule.weights[q] * map.determinant;
    table.points.push_back(point);
  }
  table.size = std::sqrt(4 * area / std::numbers::pi);
  return table;
}

/// Some fibres are recruited after a stretch: the stress then has a kink at a place that moves through the
/// wall.
bool has_front(const wall::Law<double>& law) {
  const auto& families = wall::families(law);
  return std::any_of(families.begin(), families.end(),
                     [](const auto& family) { return family.activation_squared > 1; });
}

/// Quadrature in a wall cell. A front of recruitment moves across the wall: the error that it makes falls
/// with the square of the number of points, which are cheaper than cells, and so does the jump of the
/// derivative when it reaches one, which Newton's method and the steps in time meet.
element::CellRule wall_rule(const Problem& problem, int index) {
  const Mesh& mesh = problem.mesh;
  const Cell& cell = mesh.cells[index];
  const Basis basis = geometry_basis(problem.discretisation.element);
  if (mesh.shape == CellShape::triangle || !has_front(problem.laws[cell.layer]))
    return element::cell_rule(mesh.shape, basis);
  const Map centre(mesh, cell, element::shapes_at(mesh.shape, basis, {0, 0}));
  const auto radial = [&](int j) {
    return std::abs(centre.jacobian[0][j]) / std::hypot(centre.jacobian[0][j], centre.jacobian[1][j]);
  };
  const int across = radial(0) >= radial(1) ? 0 : 1;
  element::CellRule rule;
  for (const auto& a : gauss_legendre(front_points))
    for (const auto& b : gauss_legendre(basis == Basis::linear ? 2 : 3)) {
      element::Local point{a.position, b.position};
      if (across == 1) std::swap(point[0], point[1]);
      rule.points.push_back(point);
      rule.weights.push_back(a.weight * b.weight);
    }
  return rule;
}

/// By cell: it has a side whose displacement is prescribed, or touches such a cell of the wall at an end of
/// that surface. On fine meshes the strain at a corner between a held and a free surface reaches beyond one
/// cell.
std::vector<bool> held_cells(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  std::vector<bool> held(mesh.cells.size());
  std::vector<int> sides_at(mesh.points.size());  // of the wall, that are held
  const auto has_end = [&](const Edge& edge) {
    const auto nodes = mesh.side_nodes(edge.cell, edge.side);
    return sides_at[nodes[0]] == 1 || sides_at[nodes[1]] == 1;
  };
  std::vector<Edge> of_wall;
  for (const Edge& edge : mesh.edges) {
    const auto& prescribed = problem.on(edge.boundary).displacement;
    if (!prescribed[0] || !prescribed[1]) continue;
    held[edge.cell] = true;
    if (mesh.cells[edge.cell].part != Part::wall) continue;
    const auto nodes = mesh.side_nodes(edge.cell, edge.side);
    for (int k = 0; k < 2; ++k) ++sides_at[nodes[k]];
    of_wall.push_back(edge);
  }
  const auto corners = [&](std::size_t cell) {
    return std::span(mesh.cells[cell].nodes).first(static_cast<std::size_t>(mesh.corners()));
  };
  // Of triangles, and of a wall with few cells across, so many touch a corner that nearly incompressible
  // tissue would lock.
  constexpr std::size_t fewest_across = 5;
  const auto ends = static_cast<std::size_t>(std::ranges::count(sides_at, 1));
  if (mesh.shape != CellShape::quadrilateral || 2 * of_wall.size() < fewest_across * ends) return held;
  std::vector<bool> touched(mesh.points.size());
  for (const Edge& edge : of_wall)
    if (has_end(edge))
      for (const int node : corners(static_cast<std::size_t>(edge.cell))) touched[node] = true;
  for (std::size_t cell = 0; cell < held.size(); ++cell)
    held[cell] = held[cell] || std::ranges::any_of(corners(cell), [&](int node) { return touched[node]; });
  return held;
}

WallTable wall_table(const Problem& problem, int index, bool held) {
  const Mesh& mesh = problem.mesh;
  const Cell& cell = mesh.cells[index];
  const Element element = problem.discretisation.element;
  const auto rule = wall_rule(problem, index);
  WallTable table{index, cell.layer, 0, {}};
  // Strain is singular where held sides end. Quadratic cells there would buckle within themselves, their
  // volume being bounded in the mean, and need no help against locking.
  const bool mixed = coupled::mixes(problem.discretisation, problem.laws[cell.layer]) &&
                     !(held && element == Element::quadratic);
  if (mixed) table.pressure_terms = element == Element::quadratic ? kernel::max_pressure_terms<Frame> : 1;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const Shapes shapes = element::shapes_at(mesh.shape, geometry_basis(element), rule.points[q]);
    const Map map(mesh, cell, shapes);
    require_positive(map, index);
    WallPoint point;
    point.weight = rule.weights[q] * map.determinant * Frame::measure(map.place);
    point.place = map.place;
    point.displacement = lift_shapes(shapes, map);
    point.pressure[0] = 1;
    point.pressure[1] = rule.points[q][0];
    point.pressure[2] = rule.points[q][1];
    table.points.push_back(point);
  }
  return table;
}

SideTable side_table(const Problem& problem, const Edge& edge) {
  const Mesh& mesh = problem.mesh;
  const bool quadratic = problem.discretisation.element == Element::quadratic;
  SideTable table{edge.boundary,
                  edge.cell,
                  mesh.cells[edge.cell].part == Part::wall,
                  quadratic ? 3 : 2,
                  mesh.side_nodes(edge.cell, edge.side),
                  {}};
  for (const auto& q : gauss_legendre(quadratic ? 3 : 2)) {
    const double s = q.position;
    std::array<double, 3> value, slope;
    if (quadratic) {
      value = {0.5 * s * (s - 1), 0.5 * s * (s + 1), 1 - s * s};
      slope = {s - 0.5, s + 0.5, -2 * s};
    } else {
      value = {0.5 * (1 - s), 0.5 * (1 + s), 0};
      slope = {-0.5, 0.5, 0};
    }
    SidePoint point;
    std::array<double, 2> along{};
    for (int k = 0; k < table.count; ++k)
      for (int i = 0; i < 2; ++i) {
        point.place[i] += value[k] * mesh.points[table.nodes[k]][i];
        along[i] += slope[k] * mesh.points[table.nodes[k]][i];
      }
    const double length = std::hypot(along[0], along[1]);
    point.weight = q.weight * length * Frame::measure(point.place);
    const std::array<double, 2> tangent{along[0] / length, along[1] / length};
    // Cells are counter-clockwise in (r, z), so that the outside lies to the right of the tangent.
    point.normal = {tangent[1], 0, -tangent[0]};
    for (int k = 0; k < table.count; ++k) {
      const double d = slope[k] / length;
      const auto all = Frame::lift(value[k], {d * tangent[0], d * tangent[1]}, point.place);
      for (int a = 0; a < Frame::lifts; ++a) point.shapes.lift[a][k] = all[a];
    }
    table.points.push_back(point);
  }
  return table;
}

}  // namespace

Counts counts(CellShape shape, Element element) {
  return {element::shape_count(shape, geometry_basis(element)),
          element::shape_count(shape, velocity_basis(element)), element::corners(shape)};
}

int velocity_node(const Mesh& mesh, Element element, const Cell& cell, int k) {
  return element == Element::bubble && k == mesh.corners() ? cell.nodes[mesh.centre_node()] : cell.nodes[k];
}

Tables tabulate(const Problem& problem) {
  Tables tables;
  const std::vector<bool> held = held_cells(problem);
  for (std::size_t k = 0; k < problem.mesh.cells.size(); ++k) {
    const int index = static_cast<int>(k);
    if (problem.mesh.cells[k].part == Part::blood)
      tables.blood.push_back(blood_table(problem, index));
    else
      tables.wall.push_back(wall_table(problem, index, held[k]));
  }
  tables.axes = WallAxes(problem, tables.wall);
  for (WallTable& table : tables.wall) {
    const auto rule = wall_rule(problem, table.cell);
    for (std::size_t q = 0; q < table.points.size(); ++q) {
      const auto axes = table.points[q].axes = tables.axes.at(table.cell, rule.points[q]);
      if (coupled::lacks_directions(problem.laws[table.layer], axes)) {
        const Point place = image(problem.mesh, table.cell, rule.points[q]).point;
        coupled::refuse_fibers(fmt::format("wall cell at r = {:.6g}, z = {:.6g} cm", place[0], place[1]),
                               problem.discretisation.element);
      }
    }
  }
  for (const Edge& edge : problem.mesh.edges)
    if (edge.boundary != Boundary::axis) tables.sides.push_back(side_table(problem, edge));
  return tables;
}

kernel::Lifted<Frame, cell_width> lifted_at(const Mesh& mesh, Element element, int cell,
                                            const std::array<double, 2>& local, Point* place) {
  const Shapes shapes = element::shapes_at(mesh.shape, geometry_basis(element), local);
  const Map map(mesh, mesh.cells[cell], shapes);
  if (place) *place = map.place;
  return lift_shapes(shapes, map);
}

}  // namespace tunica::axisym
