// SPDX-License-Identifier: GPL-3.0-or-later
// Radau's collocation against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "lumped/collocation.hpp"

using namespace tunica;
using lumped::Collocation;
using lumped::Crossing;
using std::numbers::pi;

namespace {

lumped::System system_of(int unknowns) {
  lumped::System system;
  system.unknowns = unknowns;
  system.scales.assign(unknowns, 1.0);
  system.magnitudes = [unknowns](const double*, double* result) { std::fill_n(result, unknowns, 1.0); };
  return system;
}

/// y' = -lambda (y - cos t) - sin t, solved by cos t (Prothero and Robinson).
lumped::System prothero_robinson(double lambda) {
  lumped::System system = system_of(1);
  system.rate = [lambda](double t, const double* y, double* rate) {
    *rate = -lambda * (*y - std::cos(t)) - std::sin(t);
  };
  system.rate_derivative = [lambda](double, const double*, const double* dy, int, double* result) {
    *result = -lambda * *dy;
  };
  return system;
}

/// y' = y cos t and z' = -z^2: exp(sin t) and 1/(1 + t) from (1, 1).
lumped::System swing_and_decay() {
  lumped::System system = system_of(2);
  system.time_scale = 100;
  system.rate = [](double t, const double* y, double* rate) {
    rate[0] = y[0] * std::cos(t);
    rate[1] = -y[1] * y[1];
  };
  system.rate_derivative = [](double t, const double* y, const double* dy, int, double* result) {
    result[0] = dy[0] * std::cos(t);
    result[1] = -2 * y[1] * dy[1];
  };
  return system;
}

}  // namespace

// At any time between steps, for a rate that is slow, as fast as the solution, and far faster.
TEST(Collocation, KeepsItsToleranceWhateverTheStiffness) {
  for (const double lambda : {0.1, 10.0, 1e3, 1e6, 1e9})
    for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
      Collocation integrator(prothero_robinson(lambda), tolerance);
      integrator.start(0, 10, {1.0}, {});
      double worst = 0;
      for (int k = 1; k <= 500; ++k) {
        EXPECT_TRUE(integrator.advance(0.02 * k).empty());
        EXPECT_DOUBLE_EQ(integrator.time(), 0.02 * k);
        worst = std::max(worst, std::abs(*integrator.state() - std::cos(0.02 * k)));
      }
      // A step leaves less than the embedded error where the rate forgets nothing: a few of them add up.
      // Below is what lambda and cos t - y lose by cancellation.
      EXPECT_LT(worst, 3 * tolerance + 1e-15 * lambda) << lambda << ", " << tolerance;
      EXPECT_LT(integrator.statistics().steps, 4000) << lambda << ", " << tolerance;
    }
}

// The embedded formula of order 3 chooses the steps, whose own error goes with their number to the power -5.
// The largest over several ends, since errors of opposite sign meet at some. Tighter tolerances show what
// Newton's method leaves, a hundredth of them in each step.
TEST(Collocation, IsOfOrderFive) {
  double error[2] = {}, steps[2] = {};
  for (int k = 0; k < 2; ++k)
    for (const double end : {3.0, 5.0, 7.0, 9.0, 11.0}) {
      Collocation integrator(swing_and_decay(), k == 0 ? 1e-2 : 1e-4);
      integrator.start(0, end, {1.0, 1.0}, {});
      integrator.advance(end);
      error[k] = std::max({error[k], std::abs(integrator.state()[0] - std::exp(std::sin(end))),
                           std::abs(integrator.state()[1] - 1 / (1 + end))});
      steps[k] += static_cast<double>(integrator.statistics().steps);
    }
  const double order = std::log(error[0] / error[1]) / std::log(steps[1] / steps[0]);
  EXPECT_NEAR(order, 5, 0.5) << error[0] << " in " << steps[0] << " steps, " << error[1] << " in "
                             << steps[1];
  std::cout << "observed order " << order << "\n";
}

TEST(Collocation, MeetsCrossingsInTheirOrderAndOnce) {
  lumped::System system = prothero_robinson(50);
  system.events = 2;
  system.event_values = [](const double* y, double* values) {
    values[0] = *y;
    values[1] = *y - 0.5;
  };
  Collocation integrator(system, 1e-9);
  integrator.start(0, 2 * pi, {1.0}, {});
  struct Expected {
    double time;
    int event;
    bool rising;
  };
  for (const auto& [time, event, rising] :
       {Expected{pi / 3, 1, false}, {pi / 2, 0, false}, {1.5 * pi, 0, true}, {5 * pi / 3, 1, true}}) {
    const auto crossings = integrator.advance(2 * pi);
    ASSERT_EQ(crossings.size(), 1U);
    EXPECT_EQ(crossings[0].index, event);
    EXPECT_EQ(crossings[0].rising, rising);
    EXPECT_NEAR(integrator.time(), time, 3e-9);
  }
  EXPECT_TRUE(integrator.advance(2 * pi).empty());
  EXPECT_EQ(integrator.time(), 2 * pi);
}

// y' = y^2 is infinite at t = 1; what the right-hand side says is passed on.
TEST(Collocation, SaysWhereAndWhyThereIsNoFurther) {
  lumped::System system = system_of(1);
  system.rate = [](double, const double* y, double* rate) {
    if (*y > 1e3) throw SolverFailure("the lumen is open beyond all bounds");
    *rate = *y * *y;
  };
  system.rate_derivative = [](double, const double* y, const double* dy, int, double* result) {
    *result = 2 * *y * *dy;
  };
  Collocation integrator(system, 1e-6);
  integrator.start(0, 2, {1.0}, {});
  try {
    integrator.advance(2);
    FAIL() << "passed a pole";
  } catch (const SolverFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("beyond all bounds"), std::string::npos) << failure.what();
  }
  // y = 1000 at 1 - 1/1000.
  EXPECT_NEAR(integrator.time(), 0.999, 1e-5);
}
