// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dual.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

namespace tunica {
namespace {

using D = Dual<double, 1>;
using DD = Dual<D, 1>;

/// x with d/dx twice over.
DD twice(double x) {
  return seed(D::variable(x));
}

/// Value, first and second derivative against their formulae. Each is a handful of operations, so that the
/// tolerance is some ulps of the largest term.
template <class F, class F0, class F1, class F2>
void expect_derivatives(const char* name, const F& f, const F0& value, const F1& first, const F2& second,
                        std::initializer_list<double> points) {
  for (const double x : points) {
    SCOPED_TRACE(std::string(name) + " at " + std::to_string(x));
    const double scale = 4e-16 * (1 + std::abs(value(x)) + std::abs(first(x)) + std::abs(second(x)));
    const D once = f(D::variable(x));
    EXPECT_NEAR(once.value, value(x), scale);
    EXPECT_NEAR(once.derivative[0], first(x), scale);
    const DD nested = f(twice(x));
    EXPECT_NEAR(nested.value.value, value(x), scale);
    EXPECT_NEAR(nested.value.derivative[0], first(x), scale);
    EXPECT_NEAR(nested.derivative[0].value, first(x), scale);
    EXPECT_NEAR(nested.derivative[0].derivative[0], second(x), 4 * scale);
    EXPECT_EQ(plain(nested), nested.value.value);
  }
}

TEST(Dual, FunctionsHaveTheirFirstAndSecondDerivatives) {
  const auto e = [](double x) { return std::exp(x); };
  expect_derivatives("exp", [](const auto& x) { return exp(x); }, e, e, e, {-2.0, 0.0, 1.3});
  expect_derivatives(
      "expm1", [](const auto& x) { return expm1(x); }, [](double x) { return std::expm1(x); }, e, e,
      {-0.7, 1e-13, 1.3});
  expect_derivatives(
      "log", [](const auto& x) { return log(x); }, [](double x) { return std::log(x); },
      [](double x) { return 1 / x; }, [](double x) { return -1 / (x * x); }, {0.3, 1.0, 7.0});
  expect_derivatives(
      "log1p", [](const auto& x) { return log1p(x); }, [](double x) { return std::log1p(x); },
      [](double x) { return 1 / (1 + x); }, [](double x) { return -1 / ((1 + x) * (1 + x)); },
      {-0.5, 1e-13, 2.0});
  expect_derivatives(
      "sqrt", [](const auto& x) { return sqrt(x); }, [](double x) { return std::sqrt(x); },
      [](double x) { return 0.5 / std::sqrt(x); }, [](double x) { return -0.25 / (x * std::sqrt(x)); },
      {0.25, 1.0, 9.5});
  const auto s = [](double x) { return std::sin(x); };
  const auto c = [](double x) { return std::cos(x); };
  const auto minus_s = [](double x) { return -std::sin(x); };
  const auto minus_c = [](double x) { return -std::cos(x); };
  expect_derivatives("sin", [](const auto& x) { return sin(x); }, s, c, minus_s, {-1.0, 0.0, 2.5});
  expect_derivatives("cos", [](const auto& x) { return cos(x); }, c, minus_s, minus_c, {-1.0, 0.0, 2.5});
  expect_derivatives(
      "atan", [](const auto& x) { return atan(x); }, [](double x) { return std::atan(x); },
      [](double x) { return 1 / (1 + x * x); }, [](double x) { return -2 * x / ((1 + x * x) * (1 + x * x)); },
      {-3.0, 0.0, 0.4});
  const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
  expect_derivatives(
      "abs", [](const auto& x) { return abs(x); }, [](double x) { return std::abs(x); }, sign,
      [](double) { return 0.0; }, {-2.0, 3.0});
}

TEST(Dual, SmallArgumentsKeepTheirRelativeAccuracy) {
  EXPECT_EQ(expm1(D::variable(1e-15)).value, std::expm1(1e-15));
  EXPECT_EQ(log1p(D::variable(1e-15)).value, std::log1p(1e-15));
}

TEST(Dual, ArithmeticFollowsTheRulesOfDifferentiation) {
  // f = (x^2 - 3 x) / (2 + x): f' = (x^2 + 4 x - 6)/(2 + x)^2, f'' = 20/(2 + x)^3
  expect_derivatives(
      "rational", [](const auto& x) { return (x * x - 3.0 * x) / (2.0 + x); },
      [](double x) { return (x * x - 3 * x) / (2 + x); },
      [](double x) { return (x * x + 4 * x - 6) / ((2 + x) * (2 + x)); },
      [](double x) { return 20 / ((2 + x) * (2 + x) * (2 + x)); }, {-1.0, 0.5, 4.0});
  // The same with every operator that assigns.
  expect_derivatives(
      "assigned",
      [](auto x) {
        const auto given = x;
        auto below = given;
        below += 2.0;
        x *= given;
        x -= 3.0 * given;
        x /= below;
        return x;
      },
      [](double x) { return (x * x - 3 * x) / (2 + x); },
      [](double x) { return (x * x + 4 * x - 6) / ((2 + x) * (2 + x)); },
      [](double x) { return 20 / ((2 + x) * (2 + x) * (2 + x)); }, {-1.0, 0.5, 4.0});
}

TEST(Dual, ConstantsMixFromEitherSideAtEveryDepth) {
  // Each is 0.5 x^2 - x + 2/x in another order of numbers and duals: f' = x - 1 - 2/x^2, f'' = 1 + 4/x^3.
  const auto value = [](double x) { return 0.5 * x * x - x + 2 / x; };
  const auto first = [](double x) { return x - 1 - 2 / (x * x); };
  const auto second = [](double x) { return 1 + 4 / (x * x * x); };
  const auto check = [&](const char* name, const auto& f) {
    expect_derivatives(name, f, value, first, second, {0.5, 2.0});
  };
  check("left", [](const auto& x) { return 0.5 * x * x - x + 2.0 / x; });
  check("right", [](const auto& x) { return x * x * 0.5 - x + 1.0 / (x / 2.0); });
  check("shifted", [](const auto& x) { return (x - 1.0) * (x - 1.0) / 2.0 - 0.5 + 2.0 / x; });
  check("turned", [](const auto& x) { return -(x - 0.5 * x * x) - (0.0 - 2.0 / x); });
  check("whole numbers", [](const auto& x) { return x * x / 2 - x + 2 / x; });
}

TEST(Dual, AConstantOfTheInnerTypeHasNoOuterDerivative) {
  // d/dy of (p y + p) at p = 3, y = 2, where p is itself a variable: p, and d/dp of that is 1.
  const D p = D::variable(3.0);
  const DD y = seed(D(2.0));
  const DD f = p * y + p;
  EXPECT_EQ(f.value.value, 9.0);
  EXPECT_EQ(f.value.derivative[0], 3.0);  // d/dp = y + 1
  EXPECT_EQ(f.derivative[0].value, 3.0);
  EXPECT_EQ(f.derivative[0].derivative[0], 1.0);
  const DD g = (p - y) / p;  // 1 - y/p
  EXPECT_DOUBLE_EQ(g.derivative[0].value, -1.0 / 3);
  EXPECT_DOUBLE_EQ(g.derivative[0].derivative[0], 1.0 / 9);
}

TEST(Dual, EachDirectionIsItsOwn) {
  using Gradient = Dual<double, 3>;
  const auto x = Gradient::variable(1.5, 0), y = Gradient::variable(-0.4, 1), z = Gradient::variable(0.9, 2);
  const Gradient f = x * exp(y) + sin(z) / x;
  EXPECT_NEAR(f.derivative[0], std::exp(-0.4) - std::sin(0.9) / 2.25, 1e-15);
  EXPECT_NEAR(f.derivative[1], 1.5 * std::exp(-0.4), 1e-15);
  EXPECT_NEAR(f.derivative[2], std::cos(0.9) / 1.5, 1e-15);
}

TEST(Dual, AtanOfTwoArgumentsIsRegularOnTheAxesAndRightInEveryQuadrant) {
  using Gradient = Dual<double, 2>;
  for (const double angle : {0.0, 0.4, std::numbers::pi / 2, 2.0, -std::numbers::pi / 2, -2.8}) {
    const double r = 1.7, x0 = r * std::cos(angle), y0 = r * std::sin(angle);
    const auto a = atan2(Gradient::variable(y0, 1), Gradient::variable(x0, 0));
    EXPECT_NEAR(a.value, angle, 1e-15);
    EXPECT_NEAR(a.derivative[0], -std::sin(angle) / r, 1e-15);
    EXPECT_NEAR(a.derivative[1], std::cos(angle) / r, 1e-15);
  }
  // Second derivative along the line y = t, x = 1: atan(t).
  const DD t = twice(0.4);
  const DD a = atan2(t, DD(1.0));
  EXPECT_NEAR(a.derivative[0].derivative[0], -0.8 / (1.16 * 1.16), 1e-15);
}

TEST(Dual, AConstantHasNoDerivative) {
  const D c = 4.0;
  EXPECT_EQ(c.derivative[0], 0.0);
  EXPECT_EQ(sqrt(c).derivative[0], 0.0);
  const DD nested = 4.0;
  EXPECT_EQ(plain(nested), 4.0);
  EXPECT_EQ(nested.derivative[0].value, 0.0);
}

}  // namespace
}  // namespace tunica
