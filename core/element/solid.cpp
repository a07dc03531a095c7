// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/element/solid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/element/cell.hpp"
#include "core/quadrature.hpp"

namespace tunica::element::solid {

namespace {

/// One-dimensional Lagrange functions on equidistant nodes of [-1, 1] in their order, and their derivatives.
struct Lagrange {
  int count;
  std::array<double, 3> value, slope;

  Lagrange(Basis basis, double x) : count(basis == Basis::linear ? 2 : 3) {
    if (basis == Basis::linear) {
      value = {0.5 * (1 - x), 0.5 * (1 + x), 0};
      slope = {-0.5, 0.5, 0};
    } else {
      value = {0.5 * x * (x - 1), (1 - x) * (1 + x), 0.5 * x * (x + 1)};
      slope = {x - 0.5, -2 * x, x + 0.5};
    }
  }
};

Shapes cube_shapes(Basis basis, const Local& x) {
  if (basis == Basis::linear_bubble) throw std::logic_error("solid::shapes_at: a cube has no bubble");
  const Lagrange a(basis, x[0]), b(basis, x[1]), c(basis, x[2]);
  Shapes s;
  for (int k = 0; k < c.count; ++k)
    for (int j = 0; j < b.count; ++j)
      for (int i = 0; i < a.count; ++i) {
        s.value[s.count] = a.value[i] * b.value[j] * c.value[k];
        s.slope[s.count] = {a.slope[i] * b.value[j] * c.value[k], a.value[i] * b.slope[j] * c.value[k],
                            a.value[i] * b.value[j] * c.slope[k]};
        ++s.count;
      }
  return s;
}

constexpr std::array<std::array<int, 2>, 6> edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

Shapes tetrahedron_shapes(Basis basis, const Local& x) {
  const std::array<double, 4> l{1 - x[0] - x[1] - x[2], x[0], x[1], x[2]};
  constexpr std::array<Local, 4> d{{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Shapes s;
  s.count = shape_count(Shape::tetrahedron, basis);
  for (int k = 0; k < 4; ++k) {
    s.value[k] = l[k];
    s.slope[k] = d[k];
  }
  if (basis == Basis::linear_bubble) {
    s.value[4] = 256 * l[0] * l[1] * l[2] * l[3];
    for (int c = 0; c < 3; ++c)
      s.slope[4][c] = 256 * (d[0][c] * l[1] * l[2] * l[3] + l[0] * d[1][c] * l[2] * l[3] +
                             l[0] * l[1] * d[2][c] * l[3] + l[0] * l[1] * l[2] * d[3][c]);
  }
  if (basis != Basis::quadratic) return s;
  for (int k = 0; k < 4; ++k) {
    s.value[k] = l[k] * (2 * l[k] - 1);
    for (int c = 0; c < 3; ++c) s.slope[k][c] = (4 * l[k] - 1) * d[k][c];
  }
  for (int e = 0; e < 6; ++e) {
    const auto [i, j] = edges[e];
    s.value[4 + e] = 4 * l[i] * l[j];
    for (int c = 0; c < 3; ++c) s.slope[4 + e][c] = 4 * (d[i][c] * l[j] + l[i] * d[j][c]);
  }
  return s;
}

Local corner(int k) {
  Local at{};
  if (k > 0) at[k - 1] = 1;
  return at;
}

/// Rule of degree 6 with 24 points: Keast, Comput. Methods Appl. Mech. Eng. 55:339 (1986). Barycentric
/// coordinates (a, a, a, 1-3a), and (a, a, b, 1-2a-b) in every order.
struct FourPoints {
  double a, weight;
};
constexpr FourPoints four_points[] = {{0.2146028712591517, 0.006653791709694646},
                                      {0.04067395853461135, 0.001679535175886776},
                                      {0.3223378901422757, 0.009226196923942399}};
constexpr double twelve_a = 0.06366100187501752, twelve_b = 0.2696723314583159,
                 twelve_weight = 0.008035714285714285;

Rule tetrahedron_rule(Basis basis) {
  Rule rule;
  const auto add = [&](const std::array<double, 4>& l, double weight) {
    rule.points.push_back({l[1], l[2], l[3]});
    rule.weights.push_back(weight);
  };
  if (basis == Basis::linear) {
    constexpr double a = 0.13819660112501052, weight = 1.0 / 24;  // (5 - sqrt 5)/20
    for (int odd = 0; odd < 4; ++odd) {
      std::array<double, 4> l{a, a, a, a};
      l[odd] = 1 - 3 * a;
      add(l, weight);
    }
    return rule;
  }
  for (const auto& [a, weight] : four_points)
    for (int odd = 0; odd < 4; ++odd) {
      std::array<double, 4> l{a, a, a, a};
      l[odd] = 1 - 3 * a;
      add(l, weight);
    }
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      if (i == j) continue;
      std::array<double, 4> l{twelve_a, twelve_a, twelve_a, twelve_a};
      l[i] = twelve_b;
      l[j] = 1 - 2 * twelve_a - twelve_b;
      add(l, twelve_weight);
    }
  return rule;
}

int line_points(Basis basis) {
  return basis == Basis::linear ? 2 : 3;
}

/// Corners of the face opposite to each corner, turning so that the normal points outwards.
constexpr std::array<std::array<int, 3>, 4> triangles{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

}  // namespace

Shapes shapes_at(Shape shape, Basis basis, const Local& point) {
  return shape == Shape::hexahedron ? cube_shapes(basis, point) : tetrahedron_shapes(basis, point);
}

Local node_position(Shape shape, Basis basis, int node) {
  if (shape == Shape::hexahedron) {
    const int m = basis == Basis::linear ? 2 : 3;
    const double step = 2.0 / (m - 1);
    return {step * (node % m) - 1, step * (node / m % m) - 1, step * (node / (m * m)) - 1};
  }
  if (node < 4) return corner(node);
  if (basis == Basis::linear_bubble) return {0.25, 0.25, 0.25};
  const Local a = corner(edges[node - 4][0]), b = corner(edges[node - 4][1]);
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

Rule cell_rule(Shape shape, Basis basis) {
  if (shape == Shape::tetrahedron) return tetrahedron_rule(basis);
  const auto line = gauss_legendre(line_points(basis));
  Rule rule;
  for (const auto& c : line)
    for (const auto& b : line)
      for (const auto& a : line) {
        rule.points.push_back({a.position, b.position, c.position});
        rule.weights.push_back(a.weight * b.weight * c.weight);
      }
  return rule;
}

std::vector<int> face_nodes(Shape shape, Basis basis, int face) {
  std::vector<int> nodes;
  const int lagrange = basis == Basis::linear_bubble ? 4 : shape_count(shape, basis);
  for (int node = 0; node < lagrange; ++node) {
    const Local at = node_position(shape, basis, node);
    const double opposite = face == 0 ? 1 - at[0] - at[1] - at[2] : at[std::max(face - 1, 0)];
    const bool is_on = shape == Shape::hexahedron ? at[face / 2] == (face % 2 == 0 ? -1 : 1) : opposite == 0;
    if (is_on) nodes.push_back(node);
  }
  return nodes;
}

FaceRule face_rule(Shape shape, Basis basis, int face) {
  FaceRule rule;
  if (shape == Shape::tetrahedron) {
    const auto& [i, j, k] = triangles[face];
    const Local origin = corner(i), first = corner(j), second = corner(k);
    for (int c = 0; c < 3; ++c) {
      rule.directions[0][c] = first[c] - origin[c];
      rule.directions[1][c] = second[c] - origin[c];
    }
    const auto plane = element::cell_rule(CellShape::triangle, element::Basis::linear);
    rule.weights = plane.weights;
    for (const auto& [s, t] : plane.points) {
      Local at{};
      for (int c = 0; c < 3; ++c) at[c] = origin[c] + s * rule.directions[0][c] + t * rule.directions[1][c];
      rule.points.push_back(at);
    }
    return rule;
  }
  const int axis = face / 2;
  const bool upper = face % 2 == 1;
  // e_(axis+1) x e_(axis+2) = e_axis.
  const int one = (axis + (upper ? 1 : 2)) % 3, other = (axis + (upper ? 2 : 1)) % 3;
  rule.directions[0][one] = rule.directions[1][other] = 1;
  const auto line = gauss_legendre(line_points(basis));
  for (const auto& b : line)
    for (const auto& a : line) {
      Local at{};
      at[axis] = upper ? 1 : -1;
      at[one] = a.position;
      at[other] = b.position;
      rule.points.push_back(at);
      rule.weights.push_back(a.weight * b.weight);
    }
  return rule;
}

}  // namespace tunica::element::solid
