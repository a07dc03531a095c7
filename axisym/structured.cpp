// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/structured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/element/grading.hpp"
#include "core/error.hpp"

namespace tunica::axisym {

namespace {

constexpr double most_nodes = 1e7;

void check_spec(const TubeSpec& spec) {
  if (!spec.blood && !spec.wall)
    throw InvalidInput("a mesh without blood and without wall; ask for one of them");
  element::check_length("geometry.radius", spec.radius);
  element::check_length("geometry.length", spec.length);
  element::check_axial_cells(spec.axial_cells);
  element::check_grading("end grading", spec.end_grading);
  double columns = 0;
  if (spec.blood) {
    element::check_cells("mesh.blood_cells", spec.blood_cells);
    element::check_grading("interface grading", spec.interface_grading);
    columns += spec.blood_cells;
  }
  if (spec.wall) {
    element::check_cells("mesh.wall_cells", spec.wall_cells);
    element::check_grading("wall grading", spec.wall_grading);
    if (spec.layers.empty()) throw InvalidInput("the wall has no layer to mesh; give it a thickness");
    for (const double thickness : spec.layers) element::check_length("geometry.thickness", thickness);
    columns += std::max<double>(spec.wall_cells, static_cast<double>(spec.layers.size()));
  }
  const double nodes = (2 * columns + 1) * (2.0 * spec.axial_cells + 1);
  if (nodes > most_nodes)
    throw InvalidInput(
        fmt::format("the mesh would have {:.3g} nodes; at most {:g} are allowed: lower mesh.axial_cells, "
                    "mesh.blood_cells or mesh.wall_cells",
                    nodes, most_nodes));
}

/// Cell lines from radius to radius, and the layer of each column.
struct Columns {
  std::vector<double> lines;
  std::vector<Part> parts;
  std::vector<int> layers;
};

void add_blood(const TubeSpec& spec, Columns& columns) {
  for (const double line : element::shrinking_lines(spec.blood_cells, spec.interface_grading))
    columns.lines.push_back(spec.radius * line);
  columns.parts.assign(spec.blood_cells, Part::blood);
  columns.layers.assign(spec.blood_cells, 0);
}

void add_wall(const TubeSpec& spec, Columns& columns) {
  const auto wall = element::wall_lines(spec.radius, spec.layers, spec.wall_cells, spec.wall_grading);
  if (!columns.lines.empty()) columns.lines.pop_back();  // the interface
  columns.lines.insert(columns.lines.end(), wall.lines.begin(), wall.lines.end());
  columns.layers.insert(columns.layers.end(), wall.layers.begin(), wall.layers.end());
  columns.parts.resize(columns.layers.size(), Part::wall);
}

Columns radial_columns(const TubeSpec& spec) {
  Columns columns;
  if (spec.blood) add_blood(spec, columns);
  if (spec.wall) add_wall(spec, columns);
  return columns;
}

/// Makes the cells of the rectangle in column i and row j. Its corners a, b, c, d and sides ab (bottom), bc
/// (right), cd (top), da (left) run counter-clockwise from the lower left.
class Builder {
 public:
  Builder(const Columns& columns, const std::vector<double>& rows, CellShape shape, int interface_column)
      : columns_(columns),
        rows_(rows),
        interface_column_(interface_column),
        stride_(2 * static_cast<int>(columns.lines.size()) - 1) {
    mesh_.shape = shape;
    const std::vector<double> r = element::with_midpoints(columns.lines), z = element::with_midpoints(rows);
    mesh_.points.reserve(r.size() * z.size());
    for (const double height : z)
      for (const double radius : r) mesh_.points.push_back({radius, height});
  }

  Mesh build() {
    const int width = static_cast<int>(columns_.parts.size()), height = static_cast<int>(rows_.size()) - 1;
    for (int j = 0; j < height; ++j) {
      for (int i = 0; i < width; ++i) {
        const int first = static_cast<int>(mesh_.cells.size());
        const bool rising = (i - interface_column_ + j) % 2 == 0;
        add_cells(i, j, rising);
        const bool blood = columns_.parts[i] == Part::blood;
        const auto mark = [&](int side, Boundary boundary) { add_edge(first, rising, side, boundary); };
        if (j == 0) mark(0, blood ? Boundary::inlet : Boundary::wall_inlet);
        if (i + 1 == width || (blood && i + 1 == interface_column_))
          mark(1, blood ? Boundary::interface : Boundary::outer);
        if (j + 1 == height) mark(2, blood ? Boundary::outlet : Boundary::wall_outlet);
        if (i == 0 || i == interface_column_) mark(3, blood ? Boundary::axis : Boundary::interface);
      }
    }
    return std::move(mesh_);
  }

 private:
  void add_cells(int i, int j, bool rising) {
    const int a = 2 * j * stride_ + 2 * i, b = a + 2, d = a + 2 * stride_, c = d + 2;
    const int ab = a + 1, da = a + stride_, centre = da + 1, bc = da + 2, cd = d + 1;
    const Part part = columns_.parts[i];
    const int layer = columns_.layers[i];
    if (mesh_.shape == CellShape::quadrilateral) {
      mesh_.cells.push_back({{a, b, c, d, ab, bc, cd, da, centre}, part, layer});
      return;
    }
    const auto triangle = [&](int p, int q, int s, int pq, int qs, int sp) {
      const auto &x = mesh_.points[p], &y = mesh_.points[q], &w = mesh_.points[s];
      const std::array<double, 2> middle{(x[0] + y[0] + w[0]) / 3, (x[1] + y[1] + w[1]) / 3};
      mesh_.cells.push_back(
          {{p, q, s, pq, qs, sp, static_cast<int>(mesh_.points.size()), -1, -1}, part, layer});
      mesh_.points.push_back(middle);
    };
    if (rising) {
      triangle(a, b, c, ab, bc, centre);
      triangle(a, c, d, centre, cd, da);
    } else {
      triangle(a, b, d, ab, centre, da);
      triangle(b, c, d, bc, cd, centre);
    }
  }

  /// Side of a rectangle as the side of the cell made of it.
  void add_edge(int first, bool rising, int side, Boundary boundary) {
    struct Half {
      int cell, side;
    };
    constexpr Half halves[2][4] = {{{0, 0}, {1, 0}, {1, 1}, {0, 2}}, {{0, 0}, {0, 1}, {1, 1}, {1, 2}}};
    const Half half = mesh_.shape == CellShape::quadrilateral ? Half{0, side} : halves[rising ? 1 : 0][side];
    mesh_.edges.push_back({first + half.cell, half.side, boundary});
  }

  const Columns& columns_;
  const std::vector<double>& rows_;
  int interface_column_;  ///< the first of the wall, or the number of columns
  int stride_;            ///< nodes in a row
  Mesh mesh_;
};

}  // namespace

Mesh structured_tube(const TubeSpec& spec) {
  check_spec(spec);
  const Columns columns = radial_columns(spec);
  const std::vector<double> rows = element::lines_along(spec.length, spec.axial_cells, spec.end_grading);
  element::check_widths(columns.lines);
  element::check_widths(rows);
  return Builder(columns, rows, spec.shape, spec.blood ? spec.blood_cells : 0).build();
}

}  // namespace tunica::axisym
