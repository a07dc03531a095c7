// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/element/cell.hpp"

#include "core/quadrature.hpp"

namespace tunica::element {

namespace {

/// One-dimensional quadratic Lagrange functions on -1, 1, 0 (in this order) and their derivatives.
struct Quadratic {
  std::array<double, 3> value, slope;
  explicit Quadratic(double x)
      : value{0.5 * x * (x - 1), 0.5 * x * (x + 1), (1 - x) * (1 + x)}, slope{x - 0.5, x + 0.5, -2 * x} {}
};

/// Position of the biquadratic functions in the products of the one-dimensional ones.
constexpr std::array<std::array<int, 2>, 9> product{
    {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {1, 2}, {2, 1}, {0, 2}, {2, 2}}};

Shapes square_shapes(Basis basis, const Local& x) {
  Shapes s;
  if (basis == Basis::linear) {
    s.count = 4;
    constexpr std::array<Local, 4> sign{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (int k = 0; k < 4; ++k) {
      const double a = 1 + sign[k][0] * x[0], b = 1 + sign[k][1] * x[1];
      s.value[k] = 0.25 * a * b;
      s.slope[k] = {0.25 * sign[k][0] * b, 0.25 * a * sign[k][1]};
    }
    return s;
  }
  s.count = 9;
  const Quadratic a(x[0]), b(x[1]);
  for (int k = 0; k < 9; ++k) {
    const auto [i, j] = product[k];
    s.value[k] = a.value[i] * b.value[j];
    s.slope[k] = {a.slope[i] * b.value[j], a.value[i] * b.slope[j]};
  }
  return s;
}

Shapes triangle_shapes(Basis basis, const Local& x) {
  Shapes s;
  const std::array<double, 3> l{1 - x[0] - x[1], x[0], x[1]};
  constexpr std::array<Local, 3> d{{{-1, -1}, {1, 0}, {0, 1}}};
  for (int k = 0; k < 3; ++k) {
    s.value[k] = l[k];
    s.slope[k] = d[k];
  }
  s.count = 3;
  if (basis == Basis::linear) return s;
  // 27 l0 l1 l2: one at the centre.
  const double bubble = 27 * l[0] * l[1] * l[2];
  Local bubble_slope;
  for (int c = 0; c < 2; ++c)
    bubble_slope[c] = 27 * (d[0][c] * l[1] * l[2] + l[0] * d[1][c] * l[2] + l[0] * l[1] * d[2][c]);
  if (basis == Basis::linear_bubble) {
    s.count = 4;
    s.value[3] = bubble;
    s.slope[3] = bubble_slope;
    return s;
  }
  s.count = 7;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    // Quadratic functions take -1/9 (corners) and 4/9 (middles) at the centre, where only the bubble may
    // differ from zero.
    s.value[k] = l[k] * (2 * l[k] - 1) + bubble / 9;
    s.value[3 + k] = 4 * l[k] * l[next] - bubble * (4.0 / 9);
    for (int c = 0; c < 2; ++c) {
      s.slope[k][c] = (4 * l[k] - 1) * d[k][c] + bubble_slope[c] / 9;
      s.slope[3 + k][c] = 4 * (d[k][c] * l[next] + l[k] * d[next][c]) - bubble_slope[c] * (4.0 / 9);
    }
  }
  s.value[6] = bubble;
  s.slope[6] = bubble_slope;
  return s;
}

struct Orbit {
  double a, b, weight;  ///< barycentric coordinates (a, b, 1-a-b) and weight of each permutation
};
/// Rule of degree 6 with 12 points: Dunavant, Int. J. Numer. Methods Eng. 21:1129 (1985). Weights of the
/// unit area.
constexpr Orbit paired[] = {{0.24928674517091042, 0.24928674517091042, 0.11678627572637937},
                            {0.06308901449150223, 0.06308901449150223, 0.05084490637020682}};
constexpr Orbit unlike{0.053145049844816947, 0.31035245103378440, 0.08285107561837358};

CellRule triangle_rule() {
  CellRule rule;
  const auto add = [&](double x, double y, double weight) {
    rule.points.push_back({x, y});
    rule.weights.push_back(0.5 * weight);
  };
  for (const Orbit& o : paired) {
    const double c = 1 - o.a - o.b;
    add(o.a, o.b, o.weight);
    add(c, o.b, o.weight);
    add(o.a, c, o.weight);
  }
  const std::array<double, 3> l{unlike.a, unlike.b, 1 - unlike.a - unlike.b};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j) add(l[i], l[j], unlike.weight);
  return rule;
}

}  // namespace

Shapes shapes_at(CellShape shape, Basis basis, const Local& point) {
  return shape == CellShape::quadrilateral ? square_shapes(basis, point) : triangle_shapes(basis, point);
}

Local node_position(CellShape shape, int node) {
  if (shape == CellShape::quadrilateral) {
    constexpr std::array<double, 3> at{-1, 1, 0};
    const auto [i, j] = product[node];
    return {at[i], at[j]};
  }
  constexpr std::array<Local, 7> at{
      {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}, {1.0 / 3, 1.0 / 3}}};
  return at[node];
}

CellRule cell_rule(CellShape shape, Basis basis) {
  if (shape == CellShape::triangle) return triangle_rule();
  const auto line = gauss_legendre(basis == Basis::linear ? 2 : 3);
  CellRule rule;
  for (const auto& a : line)
    for (const auto& b : line) {
      rule.points.push_back({a.position, b.position});
      rule.weights.push_back(a.weight * b.weight);
    }
  return rule;
}

SideRule side_rule(CellShape shape, int side, int points) {
  const auto [first, second, middle] = side_nodes(shape, side);
  const Local a = node_position(shape, first), b = node_position(shape, second);
  SideRule rule;
  rule.direction = {0.5 * (b[0] - a[0]), 0.5 * (b[1] - a[1])};
  for (const auto& q : gauss_legendre(points)) {
    const double s = 0.5 * (1 + q.position);
    rule.points.push_back({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])});
    rule.weights.push_back(q.weight);
  }
  return rule;
}

std::array<int, 3> side_nodes(CellShape shape, int side) {
  const int n = corners(shape);
  return {side, (side + 1) % n, n + side};
}

}  // namespace tunica::element
