// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/structured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>

#include "core/error.hpp"

namespace tunica::axisym {

namespace {

constexpr double most_nodes = 1e7;

void need_positive(const char* key, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw InvalidInput(fmt::format("{} = {:g} cm; a mesh needs a positive length", key, value));
}

void need_cells(const char* key, int value) {
  if (value < 1) throw InvalidInput(fmt::format("{} = {}; a mesh needs at least 1", key, value));
}

void need_grading(const char* name, double value) {
  if (!(value >= 1 && value <= steepest_grading))
    throw InvalidInput(
        fmt::format("the mesh's {} = {:g}; allowed is 1 (uniform) to {:g}", name, value, steepest_grading));
}

void check_spec(const TubeSpec& spec) {
  if (!spec.blood && !spec.wall)
    throw InvalidInput("a mesh without blood and without wall; ask for one of them");
  need_positive("geometry.radius", spec.radius);
  need_positive("geometry.length", spec.length);
  need_cells("mesh.axial_cells", spec.axial_cells);
  if (spec.axial_cells % 2 != 0)
    throw InvalidInput(fmt::format("mesh.axial_cells = {} is odd; take {}, so that mid-length is a cell line",
                                   spec.axial_cells, spec.axial_cells + 1.0));
  need_grading("end grading", spec.end_grading);
  double columns = 0;
  if (spec.blood) {
    need_cells("mesh.blood_cells", spec.blood_cells);
    need_grading("interface grading", spec.interface_grading);
    columns += spec.blood_cells;
  }
  if (spec.wall) {
    need_cells("mesh.wall_cells", spec.wall_cells);
    need_grading("wall grading", spec.wall_grading);
    if (spec.layers.empty()) throw InvalidInput("the wall has no layer to mesh; give it a thickness");
    for (const double thickness : spec.layers) need_positive("geometry.thickness", thickness);
    columns += std::max<double>(spec.wall_cells, static_cast<double>(spec.layers.size()));
  }
  const double nodes = (2 * columns + 1) * (2.0 * spec.axial_cells + 1);
  if (nodes > most_nodes)
    throw InvalidInput(
        fmt::format("the mesh would have {:.3g} nodes; at most {:g} are allowed: lower "
                    "mesh.axial_cells, mesh.blood_cells or mesh.wall_cells",
                    nodes, most_nodes));
}

/// [0, 1] onto itself with lengths of cells in geometric progression: x'(1)/x'(0) = exp(log_ratio).
double geometric(double s, double log_ratio) {
  return log_ratio == 0 ? s : std::expm1(log_ratio * s) / std::expm1(log_ratio);
}
double inverse_geometric(double x, double log_ratio) {
  return log_ratio == 0 ? x : std::log1p(x * std::expm1(log_ratio)) / log_ratio;
}

std::vector<double> axial_lines(const TubeSpec& spec) {
  const int n = spec.axial_cells;
  const double steepness = std::acosh(std::sqrt(spec.end_grading));
  std::vector<double> lines(n + 1);
  // The upper half mirrors the lower one, whatever is rounded.
  for (int j = 0; j <= n / 2; ++j) {
    const double x = 2.0 * j / n - 1;
    const double stretched = steepness == 0 ? x : std::tanh(steepness * x) / std::tanh(steepness);
    lines[j] = 0.5 * spec.length * (1 + stretched);
    lines[n - j] = spec.length - lines[j];
  }
  return lines;
}

/// Cell lines from radius to radius, and the layer of each column.
struct Columns {
  std::vector<double> lines;
  std::vector<Part> parts;
  std::vector<int> layers;
};

void add_blood(const TubeSpec& spec, Columns& columns) {
  const double log_ratio = -std::log(spec.interface_grading);
  for (int i = 0; i < spec.blood_cells; ++i) {
    columns.lines.push_back(spec.radius * geometric(static_cast<double>(i) / spec.blood_cells, log_ratio));
    columns.parts.push_back(Part::blood);
    columns.layers.push_back(0);
  }
}

void add_wall(const TubeSpec& spec, Columns& columns) {
  const double thickness = std::accumulate(spec.layers.begin(), spec.layers.end(), 0.0);
  const double log_ratio = std::log(spec.wall_grading);
  // In the coordinate s cells are alike; each further cell goes to the layer where they are widest.
  std::vector<double> ends{0};
  double depth = 0;
  for (const double layer : spec.layers)
    ends.push_back(inverse_geometric((depth += layer) / thickness, log_ratio));
  std::vector<int> counts(spec.layers.size(), 1);
  const auto width = [&](std::size_t k) { return (ends[k + 1] - ends[k]) / counts[k]; };
  for (int cells = static_cast<int>(counts.size()); cells < spec.wall_cells; ++cells) {
    std::size_t widest = 0;
    for (std::size_t k = 1; k < counts.size(); ++k)
      // Layers that are as wide but for rounding count as equal: the inner one comes first.
      if (width(k) > width(widest) * (1 + 1e-9)) widest = k;
    ++counts[widest];
  }
  double inner = spec.radius;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    for (int i = 0; i < counts[k]; ++i) {
      const double s = ends[k] + i * width(k);
      columns.lines.push_back(i == 0 ? inner : spec.radius + thickness * geometric(s, log_ratio));
      columns.parts.push_back(Part::wall);
      columns.layers.push_back(static_cast<int>(k));
    }
    inner += spec.layers[k];
  }
  columns.lines.push_back(inner);
}

Columns radial_columns(const TubeSpec& spec) {
  Columns columns;
  if (spec.blood) add_blood(spec, columns);
  if (spec.wall)
    add_wall(spec, columns);
  else
    columns.lines.push_back(spec.radius);
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
    const std::vector<double> r = with_midpoints(columns.lines), z = with_midpoints(rows);
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
  static std::vector<double> with_midpoints(const std::vector<double>& lines) {
    std::vector<double> all{lines.front()};
    for (std::size_t i = 1; i < lines.size(); ++i) {
      all.push_back(0.5 * (lines[i - 1] + lines[i]));
      all.push_back(lines[i]);
    }
    return all;
  }

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
  const std::vector<double> rows = axial_lines(spec);
  const auto strictly_rising = [](const std::vector<double>& lines) {
    return std::adjacent_find(lines.begin(), lines.end(), std::greater_equal<>()) == lines.end();
  };
  if (!strictly_rising(columns.lines) || !strictly_rising(rows))
    throw InvalidInput("cells of the mesh would have no width; use fewer cells or a milder grading");
  return Builder(columns, rows, spec.shape, spec.blood ? spec.blood_cells : 0).build();
}

double bending_layer_grading(double radius, double thickness, double length) {
  // A quarter of the cells (x from -1 to -1/2) reaches to the layer's width: with t = tanh(d/2),
  // (1 - tanh(d/2)/tanh d)/2 = (1 - t^2)/4.
  const double layer = 3 * std::sqrt(radius * thickness) / length;
  if (!(layer < 0.25)) return 1;
  const double steepness = 2 * std::atanh(std::sqrt(1 - 4 * layer));
  return std::pow(std::cosh(steepness), 2);
}

}  // namespace tunica::axisym
