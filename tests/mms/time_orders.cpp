// SPDX-License-Identifier: GPL-3.0-or-later
// Orders of convergence in time of the coupled equations, wall, blood, mesh and scalars together, by a
// manufactured solution that the elements hold without error.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "tests/mms/errors.hpp"
#include "tests/support/march.hpp"

namespace tunica::axisym::mms {
namespace {

enum Field {
  wall_displacement,
  wall_velocity,
  mesh_displacement,
  velocity,
  pressure,
  inlet_pressure,
  outlet_pressure,
  stored_pressure,
  fields
};
constexpr std::array<const char*, fields> names{"wall displacement", "wall velocity",  "mesh displacement",
                                                "velocity",          "pressure",       "inlet pressure",
                                                "outlet pressure",   "stored pressure"};
using Greatest = std::array<double, fields>;  ///< errors

/// Lengths of `count` steps that add up to 1.
using Steps = std::vector<double> (*)(int count);
std::vector<double> scaled(std::vector<double> steps) {
  double sum = 0;
  for (const double step : steps) sum += step;
  for (double& step : steps) step /= sum;
  return steps;
}
std::vector<double> equal(int count) {
  return std::vector<double>(count, 1.0 / count);
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
    TubeSpec spec;
    spec.radius = vessel.radius;
    spec.layers = {vessel.thickness};
    spec.length = vessel.length;
    spec.blood_cells = spec.axial_cells = 2;
    spec.wall_cells = 1;
    problem.mesh = structured_tube(spec);
    problem.blood = {1.1, 0.6};
    // So heavy and soft that its fastest wave takes several steps through the wall: what is faster than the
    // steps hides the order until it is resolved.
    problem.laws = {wall::SplitLaw<double, wall::NeoHookean>{{5}, {3}, {}}};
    problem.wall_density = 10;
    problem.tether = {3};
    problem.inlet.kind = InletKind::flow;
    problem.outlet.kind = OutletKind::windkessel;
    problem.outlet.resistance = 0.7;
    problem.outlet.proximal_resistance = 0.3;
    problem.outlet.compliance = 0.5;
    set_loads(vessel, problem);
  }

  /// Greatest errors at the nodes in the second half of the time from 0 to 1.
  Greatest run(time::Method method, const std::vector<double>& steps) const {
    const Assembler assembler(problem);
    const Layout& layout = assembler.layout();
    time::Scheme scheme(method);
    scheme.start(0, nodal(problem, layout, vessel, 0), nodal(problem, layout, vessel, 0, true));
    Greatest greatest{};
    test_support::march(assembler, scheme, steps, 1e-9, [&] {
      if (scheme.time() < 0.5) return;
      const std::vector<double> exact = nodal(problem, layout, vessel, scheme.time());
      const auto compare = [&](Field field, std::size_t entry) {
        greatest[field] = std::max(greatest[field], std::abs(scheme.value()[entry] - exact[entry]));
      };
      for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
        const int node = static_cast<int>(n);
        for (int c = 0; c < 2; ++c) {
          compare(layout.on_wall(node) ? wall_displacement : mesh_displacement, layout.displacement(node, c));
          compare(layout.on_wall(node) ? wall_velocity : velocity, layout.velocity(node, c));
        }
        if (layout.has_pressure(node)) compare(pressure, layout.pressure(node));
      }
      compare(inlet_pressure, *layout.inlet_pressure);
      compare(outlet_pressure, *layout.outlet_pressure);
      compare(stored_pressure, *layout.windkessel_pressure);
    });
    return greatest;
  }

  void expect_order(time::Method method, Steps steps, double order, double least_pressure_order) {
    const Greatest coarse = run(method, steps(40)), middle = run(method, steps(80)),
                   fine = run(method, steps(160));
    for (int f = 0; f < fields; ++f) {
      const double before = std::log2(coarse[f] / middle[f]), last = std::log2(middle[f] / fine[f]);
      RecordProperty(names[f], std::to_string(before) + " " + std::to_string(last) + ", error " +
                                   std::to_string(fine[f]));
      const bool is_pressure = f == pressure || f == inlet_pressure;
      EXPECT_GT(last, (is_pressure ? least_pressure_order : order) - 0.15)
          << names[f] << ", coarser pair: " << before;
      EXPECT_LT(last, order + 0.15) << names[f] << ", coarser pair: " << before;
    }
  }

  Vessel<PolynomialMotion> vessel;
  Problem problem;
};

// What the orders below rest on: at one instant, with exact rates, the exact state solves the equations.
TEST_F(TimeOrders, AreWithoutErrorsInSpace) {
  const Assembler assembler(problem);
  const double time = 0.3, coefficient = 5;
  const std::vector<double> exact = nodal(problem, assembler.layout(), vessel, time);
  std::vector<double> history = nodal(problem, assembler.layout(), vessel, time, true), y = exact;
  for (std::size_t e = 0; e < y.size(); ++e) history[e] -= coefficient * y[e];
  coupled::Newton newton(assembler);
  ASSERT_TRUE(newton.solve({time, coefficient, history}, y, {1e-13, 20}).converged);
  for (std::size_t e = 0; e < y.size(); ++e) EXPECT_NEAR(y[e], exact[e], 1e-13);
}

TEST_F(TimeOrders, OfBdf2WithEqualSteps) {
  expect_order(time::Method::bdf2, equal, 2, 2);
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
  expect_order(time::Method::backward_euler, equal, 1, 1);
}

TEST_F(TimeOrders, OfGeneralizedAlpha) {
  expect_order(time::Method::generalized_alpha, equal, 2, 2);
}

}  // namespace
}  // namespace tunica::axisym::mms
