// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/element/line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/random_deformation.hpp"

namespace tunica::element {
namespace {

using test_support::RandomDeformation;

const int degrees[] = {1, 2, 3, 5, 8, 16};

/// Sum of coefficients[k] x^k and its derivative.
double polynomial(const std::vector<double>& coefficients, double x) {
  double sum = 0;
  for (std::size_t k = coefficients.size(); k-- > 0;) sum = sum * x + coefficients[k];
  return sum;
}
double polynomial_slope(const std::vector<double>& coefficients, double x) {
  double sum = 0;
  for (std::size_t k = coefficients.size(); k-- > 1;)
    sum = sum * x + static_cast<double>(k) * coefficients[k];
  return sum;
}

std::vector<double> shapes(const Line& line, double x) {
  std::vector<double> values(line.nodes());
  line.shapes_at(x, values.data());
  return values;
}
std::vector<double> slopes(const Line& line, double x) {
  std::vector<double> values(line.nodes());
  line.slopes_at(x, values.data());
  return values;
}

template <class F>
double combined(const Line& line, const std::vector<double>& weights, const F& nodal) {
  double sum = 0;
  for (int k = 0; k < line.nodes(); ++k) sum += weights[k] * nodal(line.node(k));
  return sum;
}

TEST(Line, NodesAreTheChebyshevLobattoPointsFromEndToEnd) {
  for (const int degree : degrees) {
    const Line line(degree, degree + 1);
    EXPECT_EQ(line.degree(), degree);
    EXPECT_EQ(line.nodes(), degree + 1);
    EXPECT_EQ(line.node(0), -1.0);
    EXPECT_EQ(line.node(degree), 1.0);
    // Extrema of T_degree: there |T| = 1.
    for (int k = 0; k <= degree; ++k)
      EXPECT_NEAR(std::abs(std::cos(degree * std::acos(line.node(k)))), 1.0, 1e-13);
  }
}

TEST(Line, ShapeFunctionsAreOneAtTheirNodeAndZeroAtTheOthers) {
  for (const int degree : degrees) {
    const Line line(degree, 3);
    for (int i = 0; i <= degree; ++i) {
      const auto at_node = shapes(line, line.node(i));
      for (int k = 0; k <= degree; ++k) EXPECT_EQ(at_node[k], i == k ? 1.0 : 0.0);
    }
  }
}

TEST(Line, InterpolatesAndDifferentiatesPolynomialsUpToItsDegree) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (const int degree : degrees) {
    const Line line(degree, 3);
    std::vector<double> coefficients(degree + 1);
    for (double& c : coefficients) c = random.uniform(-1, 1);
    const auto nodal = [&](double x) { return polynomial(coefficients, x); };
    // Interpolation adds a few ulps per node; differentiation amplifies them by up to degree^2.
    const double rounding = 1e-15 * (degree + 1);
    std::vector<double> positions{-1.0, 1.0, 0.0, line.node(degree / 2) + 1e-14};
    for (int sample = 0; sample < 20; ++sample) positions.push_back(random.uniform(-1, 1));
    for (const double x : positions) {
      SCOPED_TRACE(std::to_string(degree) + " at " + std::to_string(x));
      EXPECT_NEAR(combined(line, shapes(line, x), nodal), nodal(x), 4 * rounding);
      EXPECT_NEAR(combined(line, slopes(line, x), nodal), polynomial_slope(coefficients, x),
                  4 * rounding * degree * degree);
    }
  }
}

TEST(Line, DoesNotReproduceTheNextPolynomial) {
  // x^(degree+1) - its interpolant is the node polynomial, whose largest value is at least 2^-degree.
  for (const int degree : degrees) {
    const Line line(degree, 3);
    const auto power = [&](double x) { return std::pow(x, degree + 1); };
    double worst = 0;
    for (double x = -1; x <= 1; x += 1e-2)
      worst = std::max(worst, std::abs(combined(line, shapes(line, x), power) - power(x)));
    EXPECT_GE(worst, std::ldexp(1.0, -degree));
    EXPECT_LE(worst, 2.01 * std::ldexp(1.0, -degree));
  }
}

TEST(Line, ConvergesGeometricallyForAnAnalyticFunction) {
  // 1/(x - 2) has its pole at 2, on the Bernstein ellipse of parameter 2 + sqrt(3) (Trefethen, ATAP, ch. 8).
  const auto f = [](double x) { return 1 / (x - 2); };
  const auto worst = [&](int degree) {
    const Line line(degree, 3);
    double most = 0;
    for (double x = -1; x <= 1; x += 1e-2)
      most = std::max(most, std::abs(combined(line, shapes(line, x), f) - f(x)));
    return most;
  };
  // From degree 6 to 14: a factor of rho^8 to within the parity of the grid.
  const double rate = std::pow(worst(6) / worst(14), 1.0 / 8);
  EXPECT_NEAR(rate, 2 + std::sqrt(3.0), 0.1);
}

TEST(Line, IsTabulatedAtItsRule) {
  const Line line(5, 7);
  ASSERT_EQ(line.rule().size(), 7u);
  for (std::size_t q = 0; q < line.rule().size(); ++q) {
    const auto value = shapes(line, line.rule()[q].position), slope = slopes(line, line.rule()[q].position);
    double sum = 0, slope_sum = 0;
    for (int k = 0; k < line.nodes(); ++k) {
      EXPECT_EQ(line.shape(q, k), value[k]);
      EXPECT_EQ(line.slope(q, k), slope[k]);
      sum += line.shape(q, k);
      slope_sum += line.slope(q, k);
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
    EXPECT_NEAR(slope_sum, 0.0, 1e-13);
  }
}

TEST(Line, IntegratesItsStiffnessExactly) {
  // int (dp/dx)^2 over [-1, 1] of p = x^4 is 16 * 2/7.
  const Line line(4, 4);
  double integral = 0;
  for (std::size_t q = 0; q < line.rule().size(); ++q) {
    double slope = 0;
    for (int k = 0; k < line.nodes(); ++k) slope += line.slope(q, k) * std::pow(line.node(k), 4);
    integral += line.rule()[q].weight * slope * slope;
  }
  EXPECT_NEAR(integral, 32.0 / 7, 1e-13);
}

}  // namespace
}  // namespace tunica::element
