// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/observables/table.hpp"

namespace tunica::axisym {

namespace {

using observables::FieldSeries;

/// Cells of the picture that a cell is shown as, by its nodes.
std::vector<std::vector<int>> shown_cells(CellShape shape, bool quadratic) {
  if (shape == CellShape::quadrilateral) {
    if (!quadratic) return {{0, 1, 2, 3}};
    return {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}};
  }
  if (!quadratic) return {{0, 1, 2}};
  return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
}

struct Stress {
  const char* name;
  int row, column;
};
constexpr Stress stresses[] = {{"circumferential_stress", 1, 1},
                               {"radial_stress", 0, 0},
                               {"axial_stress", 2, 2},
                               {"shear_stress", 0, 2}};

void put(std::vector<float>& values, double value) {
  values.push_back(static_cast<float>(value));
}

void put(std::vector<float>& values, const Vector<double>& vector) {
  for (const double component : vector) put(values, component);
}

Vector<double> unit(const Vector<double>& v) {
  const double length = std::sqrt(dot(v, v));
  return {v[0] / length, v[1] / length, v[2] / length};
}

FieldSeries named(const char* name, CellShape shape) {
  FieldSeries series;
  series.name = name;
  series.mesh.shape = shape == CellShape::quadrilateral ? observables::CellShape::quadrilateral
                                                        : observables::CellShape::triangle;
  series.point_fields.push_back({"displacement", "cm", 3});
  return series;
}

}  // namespace

Fields::Fields(const Assembler& assembler) : assembler_(assembler), reader_(assembler) {
  const Mesh& mesh = assembler.problem().mesh;
  // Triangles are divided along the lines between the middles of their sides.
  const bool has_centre = mesh.shape == CellShape::quadrilateral;
  shown_nodes_ = assembler.problem().discretisation.element != Element::quadratic ? mesh.corners()
                 : has_centre                                                     ? mesh.nodes_per_cell()
                                                                                  : 2 * mesh.corners();
  add_blood();
  add_wall();
}

void Fields::show(int cell, std::span<const int> points, FieldSeries& series) const {
  const Problem& problem = assembler_.problem();
  const bool quadratic = problem.discretisation.element == Element::quadratic;
  for (const auto& corners : shown_cells(problem.mesh.shape, quadratic)) {
    for (const int corner : corners) series.mesh.cells.push_back(points[corner]);
    for (auto& field : series.cell_fields) field.values.push_back(problem.mesh.cells[cell].layer);
  }
}

void Fields::add_blood() {
  const Mesh& mesh = assembler_.problem().mesh;
  blood_ = named("blood", mesh.shape);
  blood_.point_fields.push_back({"velocity", "cm/s", 3});
  blood_.point_fields.push_back({"pressure", "dyn/cm2", 1});
  const int corners = mesh.corners();
  std::vector<int> index(mesh.points.size(), -1);
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    const auto& nodes = mesh.cells[cell].nodes;
    if (mesh.cells[cell].part != Part::blood) continue;
    std::vector<int> points;
    for (int k = 0; k < shown_nodes_; ++k) {
      int& point = index[nodes[k]];
      if (point < 0) {
        point = static_cast<int>(blood_points_.size());
        BloodPoint made{nodes[k], {nodes[k]}};
        if (k == mesh.centre_node())
          made.corners.assign(nodes.begin(), nodes.begin() + corners);
        else if (k >= corners)
          made.corners = {nodes[k - corners], nodes[(k - corners + 1) % corners]};
        blood_points_.push_back(std::move(made));
        blood_.mesh.points.push_back({mesh.points[nodes[k]][0], 0, mesh.points[nodes[k]][1]});
      }
      points.push_back(point);
    }
    show(cell, points, blood_);
  }
}

void Fields::add_wall() {
  const Problem& problem = assembler_.problem();
  const Mesh& mesh = problem.mesh;
  wall_ = named("wall", mesh.shape);
  wall_.cell_fields.push_back({"layer", "1", {}});
  wall_.point_fields.push_back({"von_mises", "dyn/cm2", 1});
  for (const Stress& stress : stresses) wall_.point_fields.push_back({stress.name, "dyn/cm2", 1});
  for (const auto& law : problem.laws)
    for (const int family : distinct_families(law)) families_.push_back(family);
  std::sort(families_.begin(), families_.end());
  families_.erase(std::unique(families_.begin(), families_.end()), families_.end());
  for (const int family : families_) {
    const std::string which = family == 0 ? "" : fmt::format(".{}", family + 1);
    wall_.point_fields.push_back({"recruitment" + which, "1", 1});
    wall_.point_fields.push_back({"fiber_stretch" + which, "1", 1});
    wall_.point_fields.push_back({"fiber_direction" + which, "1", 3});
  }

  std::map<std::pair<int, int>, int> index;  // by node and layer
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    const auto& [nodes, part, layer] = mesh.cells[cell];
    if (part != Part::wall) continue;
    std::vector<int> points;
    for (int k = 0; k < shown_nodes_; ++k) {
      const int next = static_cast<int>(wall_points_.size());
      const auto [entry, is_new] = index.try_emplace({nodes[k], layer}, next);
      if (is_new) {
        wall_points_.push_back({nodes[k], layer, {}});
        wall_.mesh.points.push_back({mesh.points[nodes[k]][0], 0, mesh.points[nodes[k]][1]});
      }
      wall_points_[entry->second].places.push_back({cell, element::node_position(mesh.shape, k)});
      points.push_back(entry->second);
    }
    show(cell, points, wall_);
    wall_cells_.push_back({cell, std::move(points)});
  }
}

std::vector<FieldSeries> Fields::empty_series() const {
  std::vector<FieldSeries> all;
  if (!blood_points_.empty()) all.push_back(blood_);
  if (!wall_points_.empty()) all.push_back(wall_);
  return all;
}

std::vector<std::vector<float>> Fields::blood_values(std::span<const double> y) const {
  const Layout& layout = assembler_.layout();
  std::vector<float> displacement, velocity, pressure;
  for (const BloodPoint& point : blood_points_) {
    put(displacement, {y[layout.displacement(point.node, 0)], 0, y[layout.displacement(point.node, 1)]});
    put(velocity, {y[layout.velocity(point.node, 0)], 0, y[layout.velocity(point.node, 1)]});
    double sum = 0;
    for (const int corner : point.corners) sum += y[layout.pressure(corner)];
    put(pressure, sum / static_cast<double>(point.corners.size()));
  }
  return {std::move(displacement), std::move(velocity), std::move(pressure)};
}

std::vector<std::vector<float>> Fields::wall_values(std::span<const double> y) const {
  const Problem& problem = assembler_.problem();
  std::vector<WallStrain> strains(wall_points_.size());
  for (const WallCellPoints& shown : wall_cells_) {
    const WallCell cell = reader_.cell(shown.cell, y);
    for (int k = 0; k < shown_nodes_; ++k) {
      const int point = shown.points[k];
      strains[point].add(1.0 / static_cast<double>(wall_points_[point].places.size()),
                         cell.at(element::node_position(problem.mesh.shape, k)));
    }
  }
  std::vector<std::vector<float>> values(wall_.point_fields.size());
  for (std::size_t i = 0; i < wall_points_.size(); ++i) {
    const auto axes = reader_.axes(wall_points_[i].places);
    const Tensor<double> cauchy = reader_.cauchy(wall_points_[i].layer, strains[i], axes);
    std::size_t field = 0;
    put(values[field++], strains[i].displacement);
    put(values[field++], von_mises_stress(cauchy));
    for (const Stress& stress : stresses) put(values[field++], cauchy(stress.row, stress.column));
    const auto& families = wall::families(problem.laws[wall_points_[i].layer]);
    for (const int f : families_) {
      constexpr double none = observables::none;
      if (f >= static_cast<int>(families.size())) {
        put(values[field++], none);
        put(values[field++], none);
        put(values[field++], {none, none, none});
        continue;
      }
      const auto fiber = wall::fiber_state(families[f], strains[i].gradient, axes);
      put(values[field++], fiber.recruitment);
      put(values[field++], fiber.stretch);
      const auto deformation = Tensor<double>::identity() + strains[i].gradient;
      put(values[field++], unit(deformation * families[f].direction(axes)));
    }
  }
  return values;
}

void Fields::append(double time, std::span<const double> y, std::span<FieldSeries> series) const {
  for (FieldSeries& one : series) {
    if (one.name != blood_.name && one.name != wall_.name)
      throw std::logic_error("Fields::append: a series of something else");
    one.frames.push_back({time, one.name == blood_.name ? blood_values(y) : wall_values(y)});
  }
}

}  // namespace tunica::axisym
