// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/o_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/element/grading.hpp"
#include "core/error.hpp"
#include "full3d/mesh_check.hpp"
#include "full3d/split.hpp"

namespace tunica::full3d {

namespace {

constexpr double most_nodes = 5e6;
constexpr double most_turn = std::numbers::pi / 4;  ///< of a bent cell

double degrees(double angle) {
  return angle * 180 / std::numbers::pi;
}

void check_bend(const VesselSpec& spec) {
  if (!(spec.bend_angle >= 0 && spec.bend_angle < 2 * std::numbers::pi))
    throw InvalidInput(
        fmt::format("geometry.bend_angle = {:g} deg; allowed is 0 (straight) to less than a full turn",
                    degrees(spec.bend_angle)));
  if (spec.bend_angle == 0) return;
  if (spec.sector == Sector::quarter)
    throw InvalidInput(
        fmt::format("a quarter of a bent vessel (geometry.bend_angle = {:g} deg) does not stand for all of "
                    "it; mesh half of it",
                    degrees(spec.bend_angle)));
  double outer = spec.radius;
  if (spec.wall) outer = std::accumulate(spec.layers.begin(), spec.layers.end(), outer);
  if (!(spec.length / spec.bend_angle > outer))
    throw InvalidInput(
        fmt::format("geometry.bend_angle = {:g} deg bends a vessel of geometry.length = {:g} cm about a "
                    "radius of {:.4g} cm; it must exceed the outer radius of {:g} cm: lower the angle or "
                    "raise the length",
                    degrees(spec.bend_angle), spec.length, spec.length / spec.bend_angle, outer));
}

void check_size(const VesselSpec& spec) {
  const double nodes = expected_nodes(spec);
  if (nodes > most_nodes)
    throw InvalidInput(
        fmt::format("the mesh would have {:.3g} nodes; at most {:g} are allowed: lower mesh.axial_cells, "
                    "mesh.around_cells, mesh.blood_cells or mesh.wall_cells",
                    nodes, most_nodes));
}

void check_spec(const VesselSpec& spec) {
  if (!spec.blood && !spec.wall)
    throw InvalidInput("a mesh without blood and without wall; ask for one of them");
  element::check_length("geometry.radius", spec.radius);
  element::check_length("geometry.length", spec.length);
  element::check_axial_cells(spec.axial_cells);
  element::check_grading("end grading", spec.end_grading);
  element::check_cells("mesh.around_cells", spec.around_cells);
  if (spec.around_cells % 8 != 0)
    throw InvalidInput(
        fmt::format("mesh.around_cells = {}; the core of the mesh needs a multiple of 8: take {:g}",
                    spec.around_cells, 8 * std::ceil(spec.around_cells / 8.0)));
  if (spec.blood) {
    element::check_cells("mesh.blood_cells", spec.ring_cells);
    element::check_grading("interface grading", spec.interface_grading);
  }
  if (spec.wall) {
    element::check_cells("mesh.wall_cells", spec.wall_cells);
    element::check_grading("wall grading", spec.wall_grading);
    if (spec.layers.empty()) throw InvalidInput("the wall has no layer to mesh; give it a thickness");
    for (const double thickness : spec.layers) element::check_length("geometry.thickness", thickness);
  }
  check_bend(spec);
  check_size(spec);
}

Section section_of(const VesselSpec& spec) {
  element::WallLines wall;
  if (spec.wall) {
    wall = element::wall_lines(spec.radius, spec.layers, spec.wall_cells, spec.wall_grading);
    element::check_widths(wall.lines);
  }
  if (spec.blood) element::check_widths(element::shrinking_lines(spec.ring_cells, spec.interface_grading));
  return o_grid_section({spec.radius, spec.around_cells, spec.blood ? spec.ring_cells : 0,
                         spec.interface_grading, std::move(wall.lines), std::move(wall.layers), spec.sector,
                         spec.quadratic});
}

std::vector<double> slices_of(const VesselSpec& spec) {
  auto lines = element::lines_along(spec.length, spec.axial_cells, spec.end_grading);
  element::check_widths(lines);
  const double turn =
      spec.bend_angle / spec.length * (lines[spec.axial_cells / 2] - lines[spec.axial_cells / 2 - 1]);
  if (turn > most_turn * (1 + 1e-12))
    throw InvalidInput(
        fmt::format("with mesh.axial_cells = {} a cell turns by {:.3g} degrees of geometry.bend_angle "
                    "= {:g} deg; at most 45 are allowed: raise mesh.axial_cells",
                    spec.axial_cells, degrees(turn), degrees(spec.bend_angle)));
  return spec.quadratic ? element::with_midpoints(lines) : lines;
}

Point position(const VesselSpec& spec, const std::array<double, 2>& x, double s) {
  if (spec.bend_angle == 0) return {x[0], x[1], s};
  const double bend_radius = spec.length / spec.bend_angle, angle = s / bend_radius,
               half = std::sin(0.5 * angle);
  // Rb (cos phi - 1) without its cancellation, so that the inlet's points are the section's own.
  return {x[0] * std::cos(angle) - 2 * bend_radius * half * half, x[1],
          (bend_radius + x[0]) * std::sin(angle)};
}

class Builder {
 public:
  Builder(const VesselSpec& spec, const Section& section, const std::vector<double>& slices)
      : spec_(spec), section_(section), slices_(slices), steps_(spec.quadratic ? 2 : 1) {
    mesh_.shape = spec.shape;
    mesh_.quadratic = spec.quadratic;
  }

  Mesh build() {
    add_slice(0);
    for (int row = 0; row < spec_.axial_cells; ++row) add_row(row);
    return std::move(mesh_);
  }

 private:
  void add_slice(int slice) {
    first_nodes_.push_back(static_cast<int>(mesh_.points.size()));
    for (const auto& x : section_.points) mesh_.points.push_back(position(spec_, x, slices_[slice]));
  }

  /// Nodes up to the row's upper end; the centres of tetrahedra come before those of its last slice.
  void add_row(int row) {
    const bool tetrahedra = spec_.shape == Shape::tetrahedron;
    const int first_cell = static_cast<int>(mesh_.cells.size());
    if (spec_.quadratic) add_slice(steps_ * row + 1);
    const int centres = static_cast<int>(mesh_.points.size());
    const int per_quad = tetrahedra ? 6 : 1;
    if (tetrahedra) mesh_.points.resize(mesh_.points.size() + section_.quads.size() * per_quad);
    add_slice(steps_ * (row + 1));

    std::size_t side = 0;
    for (int q = 0; q < static_cast<int>(section_.quads.size()); ++q) {
      const Section::Quad& quad = section_.quads[q];
      const bool blood = quad.part == Part::blood;
      marks_.clear();
      for (; side < section_.sides.size() && section_.sides[side].quad == q; ++side)
        marks_.push_back({section_.sides[side].side, section_.sides[side].boundary});
      if (row == 0) marks_.push_back({4, blood ? Boundary::inlet : Boundary::wall_inlet});
      if (row + 1 == spec_.axial_cells)
        marks_.push_back({5, blood ? Boundary::outlet : Boundary::wall_outlet});
      if (tetrahedra)
        add_tetrahedra(row, quad, centres + per_quad * q);
      else
        add_hexahedron(row, quad);
    }
    if (!tetrahedra) return;
    for (int cell = first_cell; cell < static_cast<int>(mesh_.cells.size()); ++cell)
      mesh_.points[mesh_.cells[cell].nodes[10]] = image(mesh_, cell, {0.25, 0.25, 0.25}).point;
  }

  /// Nodes of a hexahedron in the triquadratic lattice, -1 for middles that linear cells have not.
  std::array<int, 27> lattice(int row, const Section::Quad& quad) const {
    std::array<int, 27> nodes{};
    for (int k = 0; k < 3; ++k)
      for (int m = 0; m < 9; ++m) {
        const bool is_there = quad.nodes[m] >= 0 && (spec_.quadratic || k != 1);
        nodes[9 * k + m] = is_there ? first_nodes_[steps_ * row + steps_ * k / 2] + quad.nodes[m] : -1;
      }
    return nodes;
  }

  void add_hexahedron(int row, const Section::Quad& quad) {
    const int cell = static_cast<int>(mesh_.cells.size());
    mesh_.cells.push_back({lattice(row, quad), quad.part, quad.layer});
    for (const auto& [face, boundary] : marks_) mesh_.faces.push_back({cell, face, boundary});
  }

  void add_tetrahedra(int row, const Section::Quad& quad, int centre) {
    const auto nodes = lattice(row, quad);
    const auto rank = [&](int k) { return section_.ranks[quad.nodes[k]]; };
    const bool inwards = row < spec_.axial_cells / 2;
    for (const LatticeTetrahedron& corners :
         split_hexahedron({rank(0), rank(2), rank(6), rank(8)}, inwards)) {
      Cell cell{{}, quad.part, quad.layer};
      cell.nodes.fill(-1);
      for (int k = 0; k < 4; ++k) cell.nodes[k] = nodes[corners[k]];
      constexpr std::array<std::array<int, 2>, 6> edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
      if (spec_.quadratic)
        for (int e = 0; e < 6; ++e)
          cell.nodes[4 + e] = nodes[middle(corners[edges[e][0]], corners[edges[e][1]])];
      cell.nodes[10] = centre++;
      for (const auto& [face, boundary] : marks_) mark(corners, face, boundary);
      mesh_.cells.push_back(cell);
    }
  }

  /// Marks the next tetrahedron's face, if there is one, on a face of the hexahedron.
  void mark(const LatticeTetrahedron& corners, int hexahedron_face, Boundary boundary) {
    constexpr std::array<int, 3> strides{1, 3, 9};
    const int stride = strides[hexahedron_face / 2], level = hexahedron_face % 2 == 0 ? 0 : 2;
    const auto is_on = [&](int corner) { return corners[corner] / stride % 3 == level; };
    for (int face = 0; face < 4; ++face)
      if (is_on((face + 1) % 4) && is_on((face + 2) % 4) && is_on((face + 3) % 4))
        mesh_.faces.push_back({static_cast<int>(mesh_.cells.size()), face, boundary});
  }

  struct Mark {
    int face;
    Boundary boundary;
  };

  const VesselSpec& spec_;
  const Section& section_;
  const std::vector<double>& slices_;
  int steps_;                     ///< from one cell line to the next
  std::vector<int> first_nodes_;  ///< of each slice
  std::vector<Mark> marks_;       ///< of the hexahedron at hand
  Mesh mesh_;
};

}  // namespace

double expected_nodes(const VesselSpec& spec) {
  const double steps = spec.quadratic ? 2 : 1, axial = spec.axial_cells, n = spec.around_cells / 4;
  const double share = spec.sector == Sector::full ? 1 : spec.sector == Sector::half ? 0.5 : 0.25;
  const double wall =
      spec.wall ? std::max<double>(spec.wall_cells, static_cast<double>(spec.layers.size())) : 0;
  const double rings = (spec.blood ? spec.ring_cells : 0) + wall;
  const double rays = steps * spec.around_cells * share + (spec.sector == Sector::full ? 0 : 1);
  const double across = spec.sector == Sector::quarter ? n / 2 : n,
               up = spec.sector == Sector::full ? n : n / 2;
  const double core = spec.blood ? (steps * across + 1) * (steps * up + 1) : rays;
  double nodes = (core + steps * rings * rays) * (steps * axial + 1);
  if (spec.shape == Shape::tetrahedron)
    nodes += 6 * axial * ((spec.blood ? across * up : 0) + rings * spec.around_cells * share);
  return nodes;
}

Mesh o_grid_vessel(const VesselSpec& spec) {
  check_spec(spec);
  const Section section = section_of(spec);
  const std::vector<double> slices = slices_of(spec);
  Mesh mesh = Builder(spec, section, slices).build();
  check_cells(mesh);
  return mesh;
}

}  // namespace tunica::full3d
