// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "core/observables/table.hpp"

namespace tunica::full3d {

namespace {

using element::solid::node_position;
using element::solid::shape_count;
using observables::FieldSeries;

double volume(const std::vector<int>& corners) {
  const auto at = [&](int k) { return node_position(Shape::tetrahedron, Basis::quadratic, corners[k]); };
  const auto edge = [&](int k) {
    const auto a = at(0), b = at(k);
    return Vector<double>{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  };
  return dot(cross(edge(1), edge(2)), edge(3));
}

/// Corners of the cells that a cell is shown as, in the order of VTK, by the numbers of its nodes.
std::vector<std::vector<int>> shown_cells(Shape shape, bool quadratic) {
  std::vector<std::vector<int>> shown;
  if (shape == Shape::hexahedron) {
    const int parts = quadratic ? 2 : 1, nodes = parts + 1;
    const auto node = [&](int i, int j, int k) { return i + nodes * (j + nodes * k); };
    for (int k = 0; k < parts; ++k)
      for (int j = 0; j < parts; ++j)
        for (int i = 0; i < parts; ++i)
          shown.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                           node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                           node(i, j + 1, k + 1)});
    return shown;
  }
  if (!quadratic) return {{0, 1, 2, 3}};
  // Four at the corners, and the octahedron between them about the line from the middle of 02 to that of 13.
  shown = {{0, 4, 5, 6}, {4, 1, 7, 8}, {5, 7, 2, 9}, {6, 8, 9, 3},
           {5, 8, 4, 6}, {5, 8, 6, 9}, {5, 8, 9, 7}, {5, 8, 7, 4}};
  for (auto& corners : shown)
    if (volume(corners) < 0) std::swap(corners[0], corners[1]);
  return shown;
}

void put(std::vector<float>& values, double value) {
  values.push_back(static_cast<float>(value));
}
void put(std::vector<float>& values, const Vector<double>& vector) {
  for (const double component : vector) put(values, component);
}

FieldSeries named(const char* name, Shape shape) {
  FieldSeries series;
  series.name = name;
  series.mesh.shape =
      shape == Shape::hexahedron ? observables::CellShape::hexahedron : observables::CellShape::tetrahedron;
  series.point_fields.push_back({"displacement", "cm", 3});
  return series;
}

}  // namespace

Fields::Fields(const Setup& setup, const Assembler& assembler, int threads)
    : setup_(setup),
      layout_(assembler.layout()),
      basis_(displacement_basis(setup.problem.discretisation.element)),
      shown_(shown_cells(setup.problem.mesh.shape, basis_ == Basis::quadratic)) {
  add_blood();
  add_wall(threads);
  // See Sector: the planes of symmetry are x = 0 of a quarter, and y = 0.
  for (FieldSeries* series : {&blood_, &wall_})
    series->mesh.mirrored = {setup.sector == Sector::quarter, setup.sector != Sector::full};
}

void Fields::show(int cell, std::span<const int> points, FieldSeries& series) const {
  for (const auto& corners : shown_) {
    for (const int corner : corners) series.mesh.cells.push_back(points[corner]);
    for (auto& field : series.cell_fields) field.values.push_back(setup_.problem.mesh.cells[cell].layer);
  }
}

void Fields::add_blood() {
  const Mesh& mesh = setup_.problem.mesh;
  blood_ = named("blood", mesh.shape);
  blood_.point_fields.push_back({"velocity", "cm/s", 3});
  blood_.point_fields.push_back({"pressure", "dyn/cm2", 1});
  std::vector<int> index(mesh.points.size(), -1);
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (mesh.cells[cell].part != Part::blood) continue;
    std::vector<int> points;
    for (int k = 0; k < shape_count(mesh.shape, basis_); ++k) {
      const int node = mesh.node(cell, basis_, k);
      int& point = index[node];
      if (point < 0) {
        point = static_cast<int>(blood_points_.size());
        BloodPoint made{node, {}};
        // The pressure is linear: at a middle it is the mean over the corners around it.
        const auto linear =
            element::solid::shapes_at(mesh.shape, Basis::linear, node_position(mesh.shape, basis_, k));
        for (int c = 0; c < linear.count; ++c)
          if (linear.value[c] > 1e-6) made.corners.push_back(mesh.node(cell, Basis::linear, c));
        blood_points_.push_back(std::move(made));
        blood_.mesh.points.push_back(mesh.points[node]);
      }
      points.push_back(point);
    }
    show(cell, points, blood_);
  }
}

void Fields::add_wall(int threads) {
  const Problem& problem = setup_.problem;
  const Mesh& mesh = problem.mesh;
  wall_ = named("wall", mesh.shape);
  wall_.cell_fields.push_back({"layer", "1", {}});
  for (const char* name : {"von_mises", "circumferential_stress", "radial_stress", "axial_stress"})
    wall_.point_fields.push_back({name, "dyn/cm2", 1});
  for (const auto& law : problem.laws)
    for (const int family : coupled::distinct_families(law)) families_.push_back(family);
  std::sort(families_.begin(), families_.end());
  families_.erase(std::unique(families_.begin(), families_.end()), families_.end());
  for (const int family : families_) {
    const std::string which = family == 0 ? "" : fmt::format(".{}", family + 1);
    wall_.point_fields.push_back({"recruitment" + which, "1", 1});
    wall_.point_fields.push_back({"fiber_stretch" + which, "1", 1});
    wall_.point_fields.push_back({"fiber_direction" + which, "1", 3});
  }

  std::map<std::pair<int, int>, int> index;  // by node and layer
  std::vector<Place> places;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (mesh.cells[cell].part != Part::wall) continue;
    const int layer = mesh.cells[cell].layer;
    std::vector<int> points;
    for (int k = 0; k < shape_count(mesh.shape, basis_); ++k) {
      const int node = mesh.node(cell, basis_, k);
      const auto [entry, is_new] = index.try_emplace({node, layer}, static_cast<int>(wall_points_.size()));
      if (is_new) {
        wall_points_.push_back({node, layer, 0});
        wall_.mesh.points.push_back(mesh.points[node]);
      }
      ++wall_points_[entry->second].places;
      point_of_place_.push_back(entry->second);
      places.push_back({cell, node_position(mesh.shape, basis_, k)});
      points.push_back(entry->second);
    }
    show(cell, points, wall_);
  }
  probe_ = wall_probe(problem, layout_, std::move(places), false, threads);
}

std::vector<FieldSeries> Fields::empty_series() const {
  std::vector<FieldSeries> all;
  if (!blood_points_.empty()) all.push_back(blood_);
  if (!wall_points_.empty()) all.push_back(wall_);
  return all;
}

std::vector<std::vector<float>> Fields::blood_values(std::span<const double> y) const {
  std::vector<float> displacement, velocity, pressure;
  for (const BloodPoint& point : blood_points_) {
    Vector<double> d, v;
    for (int c = 0; c < 3; ++c) {
      d[c] = y[layout_.displacement(point.node, c)];
      v[c] = y[layout_.velocity(point.node, c)];
    }
    put(displacement, d);
    put(velocity, v);
    double sum = 0;
    for (const int corner : point.corners) sum += y[layout_.pressure(corner)];
    put(pressure, sum / static_cast<double>(point.corners.size()));
  }
  return {std::move(displacement), std::move(velocity), std::move(pressure)};
}

std::vector<std::vector<float>> Fields::wall_values(std::span<const double> y) const {
  const Problem& problem = setup_.problem;
  std::vector<WallStrain> strains(wall_points_.size());
  const auto read = probe_->strains(y);
  for (std::size_t k = 0; k < read.size(); ++k) {
    const int point = point_of_place_[k];
    strains[point].add(1.0 / wall_points_[point].places, read[k]);
  }
  std::vector<std::vector<float>> values(wall_.point_fields.size());
  for (std::size_t i = 0; i < wall_points_.size(); ++i) {
    const auto& law = problem.laws[wall_points_[i].layer];
    const auto axes = problem.directions(problem.mesh.points[wall_points_[i].node]);
    const Vector<double> radial = cross(axes.circumferential, axes.axial);
    const Tensor<double> cauchy = coupled::cauchy(law, strains[i], axes);
    const auto normal = [&](const Vector<double>& n) { return dot(n, cauchy * n); };
    std::size_t field = 0;
    put(values[field++], strains[i].displacement);
    put(values[field++], von_mises_stress(cauchy));
    put(values[field++], normal(axes.circumferential));
    put(values[field++], normal(radial));
    put(values[field++], normal(axes.axial));
    const auto& families = wall::families(law);
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
      Vector<double> direction =
          (Tensor<double>::identity() + strains[i].gradient) * families[f].direction(axes);
      const double length = std::sqrt(dot(direction, direction));
      for (double& component : direction) component /= length;
      put(values[field++], direction);
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

}  // namespace tunica::full3d
