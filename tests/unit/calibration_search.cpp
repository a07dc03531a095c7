// SPDX-License-Identifier: GPL-3.0-or-later
// The bounded least squares behind calibrations, against minima and covariances in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "verification/calibration/least_squares.hpp"

using namespace tunica::verification::calibration;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Rosenbrock's function over x = 4 u0 - 2, y = 4 u1 - 2: r = (1 - x, 10 (y - x^2)), least at (1, 1).
std::optional<Residuals> rosenbrock(const VectorXd& u, bool) {
  const double x = 4 * u[0] - 2, y = 4 * u[1] - 2;
  Residuals at{VectorXd(2), MatrixXd(2, 2)};
  at.values << 1 - x, 10 * (y - x * x);
  at.jacobian << -4, 0, -80 * x, 40;
  return at;
}

/// Residuals r = X b - y that are linear in b = u.
Evaluate linear(const MatrixXd& X, const VectorXd& y) {
  return [X, y](const VectorXd& u, bool) { return Residuals{X * u - y, X}; };
}

}  // namespace

TEST(CalibrationSearch, ComesThroughRosenbrocksValley) {
  const auto found = least_squares(rosenbrock, VectorXd{{0.2, 0.8}});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->converged) << found->reason;
  EXPECT_NEAR(found->u[0], 0.75, 1e-5);
  EXPECT_NEAR(found->u[1], 0.75, 1e-5);
}

TEST(CalibrationSearch, StopsAtTheBoundThatHoldsTheMinimum) {
  // With x <= 1/2 (u0 stretched to it) the least is at x = 1/2, y = 1/4, where r = (1/2, 0).
  const auto held = [](const VectorXd& u, bool) {
    VectorXd inner = u;
    inner[0] = 0.625 * u[0];
    auto at = *rosenbrock(inner, true);
    at.jacobian.col(0) *= 0.625;
    return std::optional(at);
  };
  const auto found = least_squares(held, VectorXd{{0.1, 0.9}});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->converged) << found->reason;
  EXPECT_EQ(found->u[0], 1);
  EXPECT_NEAR(found->u[1], (0.25 + 2) / 4, 1e-6);
  EXPECT_NEAR(found->misfit(), 0.25, 1e-9);
}

TEST(CalibrationSearch, ComesToTheMinimumWhereResidualsStayLarge) {
  // r = (x^2 - 4 x + 54, 30 - x), x = 5 u: the slope of |r|^2 / 2 is
  // (2 x - 4)(x^2 - 4 x + 54) + x - 30, whose root is found by bisection. J^T J alone leaves out
  // (x^2 - 4 x + 54) * 2, a hundred times itself at x = 2.
  const auto slope = [](double x) { return (2 * x - 4) * (x * x - 4 * x + 54) + x - 30; };
  double low = 0, high = 5;
  while (high - low > 1e-12) (slope(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
  int evaluations = 0;
  const auto large = [&](const VectorXd& u, bool) {
    ++evaluations;
    const double x = 5 * u[0];
    return std::optional(
        Residuals{VectorXd{{x * x - 4 * x + 54, 30 - x}}, MatrixXd{{5 * (2 * x - 4)}, {-5}}});
  };
  const auto found = least_squares(large, VectorXd{{0.9}});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->converged) << found->reason;
  EXPECT_NEAR(5 * found->u[0], low, 1e-3);
  EXPECT_LE(evaluations, 30);
}

TEST(CalibrationSearch, GoesAroundPointsWithoutAnAnswer) {
  const auto holed = [](const VectorXd& u, bool with_jacobian) {
    return u[0] > 0.3 && u[0] < 0.33 ? std::nullopt : rosenbrock(u, with_jacobian);
  };
  const auto found = least_squares(holed, VectorXd{{0.2, 0.8}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->u[0], 0.75, 1e-5);
  EXPECT_FALSE(
      least_squares([](const VectorXd&, bool) { return std::optional<Residuals>(); }, VectorXd{{0.5}}));
}

TEST(CalibrationSearch, SolvesLinearLeastSquaresAndKnowsTheirCovariance) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const MatrixXd X = MatrixXd::NullaryExpr(6, 3, [&] { return normal(random); });
  const VectorXd b{{0.3, 0.6, 0.5}};
  const auto found = least_squares(linear(X, X * b), VectorXd::Constant(3, 0.1));
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->converged);
  EXPECT_LT((found->u - b).norm(), 1e-3);
  const Certainty certain = certainty(X);
  // (X^T X)^-1 X^T X = 1, whatever the scales of the columns.
  EXPECT_LT((certain.covariance * (X.transpose() * X) - MatrixXd::Identity(3, 3)).norm(), 1e-6);
  EXPECT_TRUE(certain.determined[0] && certain.determined[1] && certain.determined[2]);
}

TEST(CalibrationSearch, SaysWhatResidualsDoNotSee) {
  // The first two unknowns are seen as their sum only, the fourth not at all.
  const MatrixXd J{{1, 1, 0, 0}, {2, 2, 1, 0}, {0, 0, 3, 0}};
  const Certainty certain = certainty(J);
  EXPECT_EQ(certain.determined, (std::vector<bool>{false, false, true, false}));
  EXPECT_EQ(certain.without_influence, (std::vector<bool>{false, false, false, true}));
}
