// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/bent_tube.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/units.hpp"

namespace tunica::test_support {

namespace {

using namespace observables;
using Point = std::array<double, 3>;

constexpr double period = 0.8;

/// A point by its place in the section and along the tube.
struct Local {
  double x, y, s;
  int layer;
};

struct Grid {
  std::vector<Local> points;
  std::vector<int> cells;
  std::vector<int> layers;
};

/// Points of a square, side by side, on a disc.
std::array<double, 2> on_disc(double u, double v) {
  return {tube_inner * u * std::sqrt(1 - v * v / 2), tube_inner * v * std::sqrt(1 - u * u / 2)};
}

class Builder {
 public:
  explicit Builder(const BentTube& wanted) : wanted_(wanted) {}

  Grid blood() {
    const int n = wanted_.per_side;
    for (int k = 0; k < wanted_.along; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          add_cell(0, [&](int a, int b, int c) { return blood_point(i + a, j + b, k + c); });
    return std::move(grid_);
  }

  Grid wall() {
    for (int k = 0; k < wanted_.along; ++k)
      for (int j = 0; j < 4 * wanted_.per_side; ++j)
        for (int i = 0; i < wanted_.through; ++i) {
          const int layer = 2 * i >= wanted_.through;
          add_cell(layer, [&](int a, int b, int c) { return wall_point(i + a, j + b, k + c, layer); });
        }
    return std::move(grid_);
  }

 private:
  Local blood_point(int i, int j, int k) const {
    const double n = wanted_.per_side;
    const auto [x, y] = on_disc(2 * i / n - 1, 2 * j / n - 1);
    return {x, y, wanted_.length * k / wanted_.along, 0};
  }

  Local wall_point(int i, int j, int k, int layer) const {
    const int n = wanted_.per_side;
    const int side = j / n % 4;
    const double t = 2.0 * (j % n) / n - 1;
    const double u = side == 0 ? 1 : side == 1 ? -t : side == 2 ? -1 : t;
    const double v = side == 0 ? t : side == 1 ? 1 : side == 2 ? -t : -1;
    const auto [x, y] = on_disc(u, v);
    const double scale = 1 + (tube_outer / tube_inner - 1) * i / wanted_.through;
    return {scale * x, scale * y, wanted_.length * k / wanted_.along, layer};
  }

  template <class PointAt>
  void add_cell(int layer, const PointAt& point_at) {
    static constexpr int corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                          {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    static constexpr int tetrahedra[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                             {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    double x = 0, y = 0;
    for (const auto& [a, b, c] : corners) {
      const Local corner = point_at(a, b, c);
      x += corner.x;
      y += corner.y;
    }
    if ((wanted_.is_quarter && x < 0) || ((wanted_.is_quarter || wanted_.is_half) && y < 0)) return;
    std::array<int, 8> points;
    for (int k = 0; k < 8; ++k) points[k] = index(point_at(corners[k][0], corners[k][1], corners[k][2]));
    if (wanted_.of_tetrahedra) {
      for (const auto& tetrahedron : tetrahedra) {
        for (const int corner : tetrahedron) grid_.cells.push_back(points[corner]);
        grid_.layers.push_back(layer);
      }
      return;
    }
    grid_.cells.insert(grid_.cells.end(), points.begin(), points.end());
    grid_.layers.push_back(layer);
  }

  int index(const Local& point) {
    const auto rounded = [](double value) { return std::lround(1e9 * value); };
    const auto [entry, is_new] =
        index_.try_emplace({rounded(point.x), rounded(point.y), rounded(point.s), point.layer},
                           static_cast<int>(grid_.points.size()));
    if (is_new) grid_.points.push_back(point);
    return entry->second;
  }

  const BentTube& wanted_;
  Grid grid_;
  std::map<std::array<long, 4>, int> index_;
};

/// A vector of the section and along the tube, at a distance along it, in space.
Point turned(const BentTube& wanted, double s, double across, double y, double along) {
  const double angle = wanted.bend * s / wanted.length;
  return {across * std::cos(angle) - along * std::sin(angle), y,
          across * std::sin(angle) + along * std::cos(angle)};
}

Point position(const BentTube& wanted, const Local& point) {
  if (wanted.bend == 0) return {point.x, point.y, point.s};
  const double radius = wanted.length / wanted.bend;
  Point found = turned(wanted, point.s, radius + point.x, point.y, 0);
  found[0] -= radius;
  return found;
}

FieldSeries series(const char* name, const BentTube& wanted, const Grid& grid) {
  FieldSeries made;
  made.name = name;
  made.mesh.shape = wanted.of_tetrahedra ? CellShape::tetrahedron : CellShape::hexahedron;
  for (const Local& point : grid.points) made.mesh.points.push_back(position(wanted, point));
  made.mesh.cells = grid.cells;
  made.mesh.mirrored = {wanted.is_quarter, wanted.is_quarter || wanted.is_half};
  made.cell_fields = {{"layer", "1", grid.layers}};
  return made;
}

}  // namespace

double swelling(double time) {
  const double sine = std::sin(std::numbers::pi * time / period);
  return sine * sine;
}

std::vector<FieldSeries> bent_tube(const BentTube& wanted) {
  const Grid grids[] = {Builder(wanted).blood(), Builder(wanted).wall()};
  std::vector<FieldSeries> all{series("blood", wanted, grids[0]), series("wall", wanted, grids[1])};
  all[0].point_fields = {{"displacement", "cm", 3}, {"velocity", "cm/s", 3}, {"pressure", "dyn/cm2", 1}};
  all[1].point_fields = {
      {"displacement", "cm", 3}, {"von_mises", "dyn/cm2", 1}, {"circumferential_stress", "dyn/cm2", 1},
      {"recruitment", "1", 1},   {"fiber_stretch", "1", 1},   {"fiber_direction", "1", 3}};
  for (int frame = 0; frame < wanted.frames; ++frame) {
    const double time = period * frame / std::max(1, wanted.frames - 1), s = swelling(time);
    for (std::size_t part = 0; part < 2; ++part) {
      std::vector<std::vector<float>> values(all[part].point_fields.size());
      const auto put = [&](std::size_t field, double value) {
        values[field].push_back(static_cast<float>(value));
      };
      const auto put_vector = [&](std::size_t field, const Point& vector) {
        for (const double component : vector) put(field, component);
      };
      for (const Local& point : grids[part].points) {
        const double radius = std::hypot(point.x, point.y), inside = std::min(1.0, radius / tube_inner);
        const double outward = wanted.displacement * s *
                               std::sin(std::numbers::pi * point.s / wanted.length) *
                               (part == 0 ? inside : tube_inner / radius);
        const double x = radius > 0 ? point.x / radius : 0, y = radius > 0 ? point.y / radius : 0;
        put_vector(0, turned(wanted, point.s, outward * x, outward * y, 0));
        if (part == 0) {
          put_vector(1, turned(wanted, point.s, 0, 0, (20 + 40 * s) * (1 - inside * inside)));
          put(2, mmhg * (80 + 40 * s));
          continue;
        }
        const double depth = (radius - tube_inner) / (tube_outer - tube_inner);
        const double stress = 8e5 * (0.3 + 0.7 * s) * (1 - 0.5 * depth) * (1 - 0.3 * x);
        put(1, stress);
        put(2, 0.9 * stress);
        put(3, point.layer == 1 ? std::numeric_limits<double>::quiet_NaN()
                                : 0.5 + 0.5 * std::tanh(20 * (s - 0.3 - 0.5 * depth - 0.2 * x)));
        put(4, 1 + 0.3 * s * (1 - 0.3 * depth));
        put_vector(5, turned(wanted, point.s, -0.7 * y, 0.7 * x, std::sqrt(0.51)));
      }
      all[part].frames.push_back({time, std::move(values)});
    }
  }
  return all;
}

}  // namespace tunica::test_support
