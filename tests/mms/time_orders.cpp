// SPDX-License-Identifier: GPL-3.0-or-later
// Orders of convergence in time of the coupled equations, wall, blood, mesh and scalars together, by a
// manufactured solution that the elements hold without error.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "tests/mms/half_plane_cells.hpp"
#include "tests/mms/half_plane_motions.hpp"
#include "tests/mms/march_errors.hpp"

namespace tunica::mms {
namespace {

std::vector<double> scaled(std::vector<double> steps) {
  double sum = 0;
  for (const double step : steps) sum += step;
  for (double& step : steps) step /= sum;
  return steps;
}
/// Between a half and one and a half times the mean, slowly up and down.
std::vector<double> smooth(int count) {
  std::vector<double> steps;
  for (int k = 0; k < count; ++k)
    steps.push_back(1 + 0.5 * std::sin(2 * std::numbers::pi * (k + 0.5) / count));
  return scaled(steps);
}
/// Ratios of a step to the one before from 0.47 to 1.7.
std::vector<double> irregular(int count) {
  constexpr std::array<double, 5> pattern{1, 1.5, 0.7, 1.2, 0.6};
  std::vector<double> steps;
  for (int k = 0; k < count; ++k) steps.push_back(pattern[k % pattern.size()]);
  return scaled(steps);
}

class TimeOrders : public testing::Test {
 protected:
  TimeOrders() {
    axisym::TubeSpec spec;
    spec.radius = vessel.radius;
    spec.layers = {vessel.thickness};
    spec.length = vessel.length;
    spec.blood_cells = spec.axial_cells = 2;
    spec.wall_cells = 1;
    problem.mesh = axisym::structured_tube(spec);
    set_march(vessel, problem);
  }

  void expect_order(time::Method method, Steps steps, double order, double least_pressure_order) {
    const axisym::Assembler assembler(problem);
    const auto run = [&](int count) {
      return march_errors<HalfPlaneCells>(assembler, problem, vessel, method, steps(count));
    };
    expect_time_order(run, {40, 80, 160}, order, least_pressure_order);
  }

  Vessel<half_plane::PolynomialMotion> vessel;
  axisym::Problem problem;
};

// What the orders below rest on: at one instant, with exact rates, the exact state solves the equations.
TEST_F(TimeOrders, AreWithoutErrorsInSpace) {
  expect_no_error_in_space<HalfPlaneCells>(axisym::Assembler(problem), problem, vessel);
}

TEST_F(TimeOrders, OfBdf2WithEqualSteps) {
  expect_order(time::Method::bdf2, equal_steps, 2, 2);
}

TEST_F(TimeOrders, OfBdf2WithStepsThatVary) {
  expect_order(time::Method::bdf2, smooth, 2, 2);
}

// Where the ends of the wall are moved as prescribed, their accelerations are second differences of what is
// prescribed, to first order only where steps change at once; the pressure beside them follows.
TEST_F(TimeOrders, OfBdf2WithStepsThatChangeAtOnce) {
  expect_order(time::Method::bdf2, irregular, 2, 1);
}

TEST_F(TimeOrders, OfBackwardEuler) {
  expect_order(time::Method::backward_euler, equal_steps, 1, 1);
}

TEST_F(TimeOrders, OfGeneralizedAlpha) {
  expect_order(time::Method::generalized_alpha, equal_steps, 2, 2);
}

// With a mesh that lags: where it is and how fast it moves are extrapolated to second order each.
class LaggedTimeOrders : public TimeOrders {
 protected:
  LaggedTimeOrders() { problem.discretisation.lagged_mesh = true; }
};

TEST_F(LaggedTimeOrders, OfBdf2WithEqualSteps) {
  expect_order(time::Method::bdf2, equal_steps, 2, 2);
}

TEST_F(LaggedTimeOrders, OfBdf2WithStepsThatVary) {
  expect_order(time::Method::bdf2, smooth, 2, 2);
}

TEST_F(LaggedTimeOrders, OfBackwardEuler) {
  expect_order(time::Method::backward_euler, equal_steps, 1, 1);
}

TEST_F(LaggedTimeOrders, OfGeneralizedAlpha) {
  expect_order(time::Method::generalized_alpha, equal_steps, 2, 2);
}

}  // namespace
}  // namespace tunica::mms
