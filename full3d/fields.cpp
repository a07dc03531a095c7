// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "core/observables/table.hpp"
#include "full3d/wall_axes.hpp"

namespace tunica::full3d {

namespace {

using element::solid::node_position;
using element::solid::shape_count;
using observables::FieldSeries;

using element::solid::Local;

/// How a cell is shown: points in it, and the corners of the picture's cells among them in the order of VTK.
struct Pattern {
  std::vector<Local> points;
  std::vector<std::vector<int>> cells;
};

Pattern hexahedra(int across, int along) {
  Pattern pattern;
  const int n = across + 1;
  const auto node = [&](int i, int j, int k) { return i + n * (j + n * k); };
  for (int k = 0; k <= along; ++k)
    for (int j = 0; j <= across; ++j)
      for (int i = 0; i <= across; ++i)
        pattern.points.push_back({2.0 * i / across - 1, 2.0 * j / across - 1, 2.0 * k / along - 1});
  for (int k = 0; k < along; ++k)
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i)
        pattern.cells.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                                 node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                                 node(i, j + 1, k + 1)});
  return pattern;
}

Pattern tetrahedra(bool quadratic) {
  Pattern pattern;
  const Basis basis = quadratic ? Basis::quadratic : Basis::linear;
  for (int k = 0; k < shape_count(Shape::tetrahedron, basis); ++k)
    pattern.points.push_back(node_position(Shape::tetrahedron, basis, k));
  pattern.cells = {{0, 1, 2, 3}};
  // Four at the corners, and the octahedron between them about the line from the middle of 02 to that of 13.
  if (quadratic)
    pattern.cells = {{0, 4, 5, 6}, {4, 1, 7, 8}, {5, 7, 2, 9}, {6, 8, 9, 3},
                     {5, 8, 4, 6}, {5, 8, 6, 9}, {5, 8, 9, 7}, {5, 8, 7, 4}};
  for (auto& corners : pattern.cells) {
    const auto edge = [&](int k) {
      const Local &a = pattern.points[corners[0]], &b = pattern.points[corners[k]];
      return Vector<double>{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    };
    if (dot(cross(edge(1), edge(2)), edge(3)) < 0) std::swap(corners[0], corners[1]);
  }
  return pattern;
}

Pattern pattern_of(const Problem& problem) {
  const bool quadratic = problem.discretisation.element == Element::quadratic;
  if (problem.mesh.shape == Shape::tetrahedron) return tetrahedra(quadratic);
  return quadratic ? hexahedra(2, 4) : hexahedra(1, 1);
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

Fields::Fields(const Setup& setup, const Assembler& assembler, int threads) : setup_(setup) {
  const Problem& problem = setup.problem;
  const std::array<bool, 2> mirrored{setup.sector == Sector::quarter, setup.sector != Sector::full};
  blood_ = named("blood", problem.mesh.shape);
  blood_.mesh.mirrored = mirrored;
  blood_.point_fields.push_back({"velocity", "cm/s", 3});
  blood_.point_fields.push_back({"pressure", "dyn/cm2", 1});
  wall_ = named("wall", problem.mesh.shape);
  wall_.mesh.mirrored = mirrored;
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
  blood_points_ = points_of(Part::blood, blood_);
  wall_points_ = points_of(Part::wall, wall_);
  std::vector<std::vector<Place>> meeting(wall_points_.layers.size());
  for (std::size_t k = 0; k < wall_points_.places.size(); ++k)
    meeting[wall_points_.point_of_place[k]].push_back(wall_points_.places[k]);
  for (std::size_t i = 0; i < meeting.size(); ++i) {
    const Directions directions = mean_directions(problem, meeting[i], wall_.mesh.points[i]);
    axes_.push_back({directions.circumferential, directions.axial});
  }
  blood_probe_ = blood_probe(problem, assembler.layout(), blood_points_.places);
  wall_probe_ = wall_probe(problem, assembler.layout(), wall_points_.places, false, threads);
}

Fields::Points Fields::points_of(Part part, FieldSeries& series) const {
  const Mesh& mesh = setup_.problem.mesh;
  const Pattern pattern = pattern_of(setup_.problem);
  // Points that cells share coincide but for rounding.
  const double grid = 1e-6 * setup_.shape.thickness;
  std::map<std::array<long, 4>, int> index;
  std::vector<int> places_at;
  Points points;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (mesh.cells[cell].part != part) continue;
    const int layer = mesh.cells[cell].layer;
    std::vector<int> of_cell;
    for (const Local& local : pattern.points) {
      const Point x = image(mesh, cell, local).point;
      const std::array<long, 4> key{std::lround(x[0] / grid), std::lround(x[1] / grid),
                                    std::lround(x[2] / grid), layer};
      const auto [entry, is_new] = index.try_emplace(key, static_cast<int>(points.layers.size()));
      if (is_new) {
        points.layers.push_back(layer);
        places_at.push_back(0);
        series.mesh.points.push_back(x);
      }
      ++places_at[entry->second];
      points.point_of_place.push_back(entry->second);
      points.places.push_back({cell, local});
      of_cell.push_back(entry->second);
    }
    for (const auto& corners : pattern.cells) {
      for (const int corner : corners) series.mesh.cells.push_back(of_cell[corner]);
      for (auto& field : series.cell_fields) field.values.push_back(layer);
    }
  }
  for (const int point : points.point_of_place) points.share_of_place.push_back(1.0 / places_at[point]);
  return points;
}

std::vector<FieldSeries> Fields::empty_series() const {
  std::vector<FieldSeries> all;
  if (!blood_points_.layers.empty()) all.push_back(blood_);
  if (!wall_points_.layers.empty()) all.push_back(wall_);
  return all;
}

std::vector<std::vector<float>> Fields::blood_values(std::span<const double> y) const {
  // What is continuous is the same in all cells that meet at a point.
  std::vector<BloodSample> at_points(blood_points_.layers.size());
  const auto read = blood_probe_->samples(y);
  for (std::size_t k = 0; k < read.size(); ++k) at_points[blood_points_.point_of_place[k]] = read[k];
  std::vector<float> displacement, velocity, pressure;
  for (const BloodSample& sample : at_points) {
    put(displacement, sample.displacement);
    put(velocity, sample.velocity);
    put(pressure, sample.pressure);
  }
  return {std::move(displacement), std::move(velocity), std::move(pressure)};
}

std::vector<std::vector<float>> Fields::wall_values(std::span<const double> y) const {
  const Problem& problem = setup_.problem;
  std::vector<WallStrain> strains(wall_points_.layers.size());
  const auto read = wall_probe_->strains(y);
  for (std::size_t k = 0; k < read.size(); ++k)
    strains[wall_points_.point_of_place[k]].add(wall_points_.share_of_place[k], read[k]);
  std::vector<std::vector<float>> values(wall_.point_fields.size());
  for (std::size_t i = 0; i < strains.size(); ++i) {
    const auto& law = problem.laws[wall_points_.layers[i]];
    const auto& axes = axes_[i];
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
