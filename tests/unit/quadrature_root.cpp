// SPDX-License-Identifier: GPL-3.0-or-later
#include <gsl/gsl_errno.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/gsl.hpp"
#include "core/quadrature.hpp"
#include "core/root.hpp"

namespace tunica {
namespace {

double integral_of_power(const std::vector<QuadraturePoint>& rule, int power) {
  double sum = 0;
  for (const auto& point : rule) sum += point.weight * std::pow(point.position, power);
  return sum;
}

TEST(GaussLegendre, IsExactForDegreesUpToTwiceThePointsMinusOne) {
  for (int points = 1; points <= 16; ++points) {
    const auto rule = gauss_legendre(points);
    ASSERT_EQ(rule.size(), static_cast<std::size_t>(points));
    for (int power = 0; power < 2 * points; ++power)
      EXPECT_NEAR(integral_of_power(rule, power), power % 2 == 0 ? 2.0 / (power + 1) : 0.0, 2e-15)
          << points << " points, power " << power;
  }
}

TEST(GaussLegendre, ErrsForTheNextPowerByItsKnownError) {
  // 2^(2n+1) (n!)^4 / ((2n+1) ((2n)!)^2), e.g. Davis and Rabinowitz, Methods of Numerical Integration, 2.7.
  for (int n = 1; n <= 8; ++n) {
    const double ratio = std::tgamma(n + 1) * std::tgamma(n + 1) / std::tgamma(2 * n + 1);
    const double error = std::ldexp(ratio * ratio, 2 * n + 1) / (2 * n + 1);
    EXPECT_NEAR(2.0 / (2 * n + 1) - integral_of_power(gauss_legendre(n), 2 * n), error, 1e-15 + 1e-12 * error)
        << n;
  }
}

TEST(GaussLegendre, WeightsArePositiveAndPointsAscendInsideTheInterval) {
  for (const int points : {1, 2, 7, 10, 12, 64}) {
    double before = -1;
    for (const auto& [position, weight] : gauss_legendre(points)) {
      EXPECT_GT(weight, 0.0);
      EXPECT_GT(position, before);
      EXPECT_LT(position, 1.0);
      before = position;
    }
  }
}

TEST(GaussLegendre, RefusesARuleWithoutPoints) {
  EXPECT_THROW(gauss_legendre(0), std::invalid_argument);
}

TEST(CheckGsl, NamesTheCallAndTheReason) {
  check_gsl(GSL_SUCCESS, "gsl_call");
  try {
    check_gsl(GSL_EDOM, "gsl_call");
    FAIL() << "an error of GSL went by";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "gsl_call: input domain error");
  }
}

TEST(FindRoot, ReachesTheToleranceOnSmoothSteepAndFlatFunctions) {
  // The fixed point of the cosine, to all digits.
  constexpr double dottie = 0.73908513321516064166;
  for (const double tolerance : {1e-3, 1e-8, 1e-14})
    EXPECT_NEAR(find_root([](double x) { return std::cos(x) - x; }, 0, 1, tolerance), dottie, tolerance);
  EXPECT_NEAR(find_root([](double x) { return x - std::cos(x); }, 0, 1, 1e-12), dottie, 1e-12);
  EXPECT_NEAR(find_root([](double x) { return std::pow(x - 0.3, 3); }, -1, 1, 1e-6), 0.3, 1e-6);
  EXPECT_NEAR(find_root([](double x) { return std::exp(50 * x) - 2; }, -1, 1, 1e-13), std::log(2.0) / 50,
              1e-13);
  EXPECT_NEAR(find_root([](double x) { return std::atan(5e5 * (x - 0.1)); }, 0, 1, 1e-12), 0.1, 1e-12);
}

TEST(FindRoot, FindsAJump) {
  EXPECT_NEAR(find_root([](double x) { return x < 0.7 ? -1.0 : 2.0; }, 0, 1, 1e-10), 0.7, 1e-10);
}

TEST(FindRoot, TakesAnEndThatIsARoot) {
  EXPECT_EQ(find_root([](double x) { return x - 0.25; }, 0.25, 1, 1e-12), 0.25);
  EXPECT_EQ(find_root([](double x) { return x - 1; }, 0.25, 1, 1e-12), 1.0);
  // Also where the function is of one sign elsewhere.
  EXPECT_EQ(find_root([](double x) { return x * x; }, 0, 1, 1e-12), 0.0);
}

TEST(FindRoot, RefusesWhatItCannotSolve) {
  EXPECT_THROW(find_root([](double x) { return x * x + 1; }, -1, 1, 1e-12), std::logic_error);
  EXPECT_THROW(find_root([](double x) { return x > 0 ? 1.0 : -1.0; }, 0.5, 1, 1e-12), std::logic_error);
  const auto hole = [](double x) { return std::abs(x) < 0.9 ? std::numeric_limits<double>::quiet_NaN() : x; };
  EXPECT_THROW(find_root(hole, -1, 1, 1e-12), std::logic_error);
  const auto infinite = [](double x) { return x > 0.5 ? std::numeric_limits<double>::infinity() : -1.0; };
  EXPECT_THROW(find_root(infinite, 0, 1, 1e-12), std::logic_error);
}

TEST(FindRoot, AnExceptionOfTheFunctionComesThrough) {
  const auto failing = [](double x) -> double {
    if (std::abs(x) < 0.9) throw std::runtime_error("no equilibrium");
    return x;
  };
  EXPECT_THROW(find_root(failing, -1, 1, 1e-12), std::runtime_error);
}

}  // namespace
}  // namespace tunica
