// SPDX-License-Identifier: GPL-3.0-or-later
// Reference cells in space: what defines a Lagrange basis, and integrals known in closed form.
#include "core/element/solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace tunica::element::solid {
namespace {

struct Case {
  const char* name;
  Shape shape;
  Basis basis;
  int degree;  ///< of polynomials that the basis reproduces: in each coordinate on cubes, in all on
               ///< tetrahedra
};
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

class SolidBasis : public testing::TestWithParam<Case> {
 protected:
  const Shape shape = GetParam().shape;
  const Basis basis = GetParam().basis;
  const int count = shape_count(shape, basis);
  const bool has_bubble = basis == Basis::linear_bubble;
  /// No node, and in both cells.
  static constexpr Local inside{0.17, 0.23, 0.31};

  bool reproduces(int i, int j, int k) const {
    const int n = GetParam().degree;
    return shape == Shape::hexahedron ? std::max({i, j, k}) <= n : i + j + k <= n;
  }
};
INSTANTIATE_TEST_SUITE_P(
    , SolidBasis,
    testing::Values(Case{"linear_cube", Shape::hexahedron, Basis::linear, 1},
                    Case{"quadratic_cube", Shape::hexahedron, Basis::quadratic, 2},
                    Case{"linear_tetrahedron", Shape::tetrahedron, Basis::linear, 1},
                    Case{"bubble_tetrahedron", Shape::tetrahedron, Basis::linear_bubble, 1},
                    Case{"quadratic_tetrahedron", Shape::tetrahedron, Basis::quadratic, 2}),
    [](const auto& instance) { return instance.param.name; });

TEST_P(SolidBasis, IsOneAtItsNodeAndZeroAtTheOthers) {
  for (int node = 0; node < count; ++node) {
    const Shapes s = shapes_at(shape, basis, node_position(shape, basis, node));
    ASSERT_EQ(s.count, count);
    for (int k = 0; k < count; ++k) {
      // The bubble is a coefficient of its own beside the linear functions, which are 1/4 at its centre.
      const bool at_bubble = has_bubble && node == 4;
      EXPECT_NEAR(s.value[k], k == node ? 1 : at_bubble ? 0.25 : 0, 1e-15) << node << ' ' << k;
    }
  }
}

TEST_P(SolidBasis, ReproducesPolynomialsAndTheirGradients) {
  const Shapes s = shapes_at(shape, basis, inside);
  const int lagrange = has_bubble ? 4 : count;
  const auto power = [](double x, int n) { return std::pow(x, n); };
  const auto slope = [](double x, int n) { return n == 0 ? 0.0 : n * std::pow(x, n - 1); };
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 2; ++j)
      for (int k = 0; k <= 2; ++k) {
        if (!reproduces(i, j, k)) continue;
        double value = 0;
        Local gradient{};
        for (int node = 0; node < lagrange; ++node) {
          const Local at = node_position(shape, basis, node);
          const double nodal = power(at[0], i) * power(at[1], j) * power(at[2], k);
          value += nodal * s.value[node];
          for (int c = 0; c < 3; ++c) gradient[c] += nodal * s.slope[node][c];
        }
        const auto [x, y, z] = inside;
        EXPECT_NEAR(value, power(x, i) * power(y, j) * power(z, k), 1e-14);
        EXPECT_NEAR(gradient[0], slope(x, i) * power(y, j) * power(z, k), 1e-13);
        EXPECT_NEAR(gradient[1], power(x, i) * slope(y, j) * power(z, k), 1e-13);
        EXPECT_NEAR(gradient[2], power(x, i) * power(y, j) * slope(z, k), 1e-13);
      }
}

// Central differences of step h have an error of h^2 times a third derivative of at most 256.
TEST_P(SolidBasis, HasTheSlopesOfItsValues) {
  constexpr double h = 1e-5;
  const Shapes s = shapes_at(shape, basis, inside);
  for (int c = 0; c < 3; ++c) {
    Local above = inside, below = inside;
    above[c] += h;
    below[c] -= h;
    const Shapes up = shapes_at(shape, basis, above), down = shapes_at(shape, basis, below);
    for (int k = 0; k < count; ++k)
      EXPECT_NEAR(s.slope[k][c], (up.value[k] - down.value[k]) / (2 * h), 1e-7) << k << ' ' << c;
  }
}

TEST_P(SolidBasis, IsKnownOnAFaceByTheNodesThere) {
  for (int face = 0; face < faces(shape); ++face) {
    const auto nodes = face_nodes(shape, basis, face);
    EXPECT_EQ(nodes.size(), shape == Shape::hexahedron  ? (basis == Basis::linear ? 4u : 9u)
                            : basis == Basis::quadratic ? 6u
                                                        : 3u);
    for (const Local& point : face_rule(shape, basis, face).points) {
      const Shapes s = shapes_at(shape, basis, point);
      double sum = 0;
      for (const int node : nodes) sum += s.value[node];
      EXPECT_NEAR(sum, 1, 1e-14);
      for (int k = 0; k < count; ++k)
        if (std::find(nodes.begin(), nodes.end(), k) == nodes.end()) {
          EXPECT_NEAR(s.value[k], 0, 1e-14);
        }
    }
  }
}

// The divergence theorem for (x^a y^b z^c, 0, 0) and its like: outward normals, areas and points at once.
TEST_P(SolidBasis, HasFacesThatEncloseTheCell) {
  const Rule volume = cell_rule(shape, basis);
  for (int component = 0; component < 3; ++component) {
    const auto field = [&](const Local& x) {
      return x[component] * x[component] * (1 + x[(component + 1) % 3]);
    };
    const auto divergence = [&](const Local& x) { return 2 * x[component] * (1 + x[(component + 1) % 3]); };
    double inside_sum = 0, surface = 0;
    for (std::size_t q = 0; q < volume.points.size(); ++q)
      inside_sum += volume.weights[q] * divergence(volume.points[q]);
    for (int face = 0; face < faces(shape); ++face) {
      const FaceRule rule = face_rule(shape, basis, face);
      const auto& [a, b] = rule.directions;
      const int next = (component + 1) % 3, last = (component + 2) % 3;
      const double normal = a[next] * b[last] - a[last] * b[next];
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        surface += rule.weights[q] * normal * field(rule.points[q]);
    }
    EXPECT_NEAR(surface, inside_sum, 1e-13) << component;
  }
}

double factorial(int n) {
  return std::tgamma(n + 1);
}

TEST(SolidRule, IntegratesWhatItPromises) {
  for (const Basis basis : {Basis::linear, Basis::quadratic}) {
    const Rule cube = cell_rule(Shape::hexahedron, basis);
    const int degree = basis == Basis::linear ? 3 : 5;
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; j <= degree; ++j)
        for (int k = 0; k <= degree; ++k) {
          double sum = 0;
          for (std::size_t q = 0; q < cube.points.size(); ++q) {
            const auto& [x, y, z] = cube.points[q];
            sum += cube.weights[q] * std::pow(x, i) * std::pow(y, j) * std::pow(z, k);
          }
          const auto line = [](int n) { return n % 2 == 0 ? 2.0 / (n + 1) : 0.0; };
          EXPECT_NEAR(sum, line(i) * line(j) * line(k), 1e-14);
        }
  }
  // int x^i y^j z^k = i! j! k! / (i+j+k+3)!
  for (const auto& [basis, degree] :
       {std::pair{Basis::linear, 2}, {Basis::linear_bubble, 6}, {Basis::quadratic, 6}}) {
    const Rule tetrahedron = cell_rule(Shape::tetrahedron, basis);
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j)
        for (int k = 0; i + j + k <= degree; ++k) {
          double sum = 0;
          for (std::size_t q = 0; q < tetrahedron.points.size(); ++q) {
            const auto& [x, y, z] = tetrahedron.points[q];
            sum += tetrahedron.weights[q] * std::pow(x, i) * std::pow(y, j) * std::pow(z, k);
          }
          EXPECT_NEAR(sum, factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3), 1e-15);
        }
  }
}

TEST(SolidBubble, IsNotACubes) {
  EXPECT_THROW(shapes_at(Shape::hexahedron, Basis::linear_bubble, {0, 0, 0}), std::logic_error);
}

}  // namespace
}  // namespace tunica::element::solid
