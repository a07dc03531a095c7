// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/coupled/newton.hpp"
#include "tests/mms/errors.hpp"
#include "tests/support/march.hpp"

/// Errors in time of the coupled equations, wall, blood, mesh and scalars together, by a manufactured
/// solution that the elements hold without error.
namespace tunica::mms {

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
inline constexpr std::array<const char*, fields> field_names{
    "wall displacement", "wall velocity",  "mesh displacement", "velocity",
    "pressure",          "inlet pressure", "outlet pressure",   "stored pressure"};
using Greatest = std::array<double, fields>;  ///< errors

/// Lengths of `count` steps that add up to 1.
using Steps = std::vector<double> (*)(int count);
inline std::vector<double> equal_steps(int count) {
  return std::vector<double>(count, 1.0 / count);
}

/// Inlet and outlet of all kinds of scalars, and a wall so heavy and soft that its fastest wave takes several
/// steps through it: what is faster than the steps hides the order until it is resolved.
template <class Motion>
void set_march(const Vessel<Motion>& vessel, Conditions<Motion::dimension>& problem) {
  problem.blood = {1.1, 0.6};
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

/// What orders in time rest on: at one instant, with exact rates, the exact state solves the equations.
template <class Cells, class Motion>
void expect_no_error_in_space(const coupled::Equations& equations, const typename Cells::Problem& problem,
                              const Vessel<Motion>& vessel) {
  const double time = 0.3, coefficient = 5;
  const std::vector<double> exact = nodal<Cells>(problem, equations.layout(), vessel, time);
  std::vector<double> history = nodal<Cells>(problem, equations.layout(), vessel, time, true), y = exact;
  for (std::size_t e = 0; e < y.size(); ++e) history[e] -= coefficient * y[e];
  coupled::Newton newton(equations);
  ASSERT_TRUE(newton.solve({time, coefficient, history}, y, {1e-13, 20}).converged);
  for (std::size_t e = 0; e < y.size(); ++e) EXPECT_NEAR(y[e], exact[e], 1e-13);
}

/// Greatest errors at the nodes in the second half of the time from 0 to 1.
template <class Cells, class Motion>
Greatest march_errors(const coupled::Equations& equations, const typename Cells::Problem& problem,
                      const Vessel<Motion>& vessel, time::Method method, const std::vector<double>& steps) {
  const Layout& layout = equations.layout();
  time::Scheme scheme(method);
  scheme.start(0, nodal<Cells>(problem, layout, vessel, 0), nodal<Cells>(problem, layout, vessel, 0, true));
  Greatest greatest{};
  test_support::march(equations, scheme, steps, 1e-9, [&] {
    if (scheme.time() < 0.5) return;
    const std::vector<double> exact = nodal<Cells>(problem, layout, vessel, scheme.time());
    const auto compare = [&](Field field, std::size_t entry) {
      greatest[field] = std::max(greatest[field], std::abs(scheme.value()[entry] - exact[entry]));
    };
    for (int node = 0; node < layout.nodes(); ++node) {
      for (int c = 0; c < Motion::dimension; ++c) {
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

/// `run` gives the errors with so many steps; `counts` double from one to the next. The order of the last two
/// counts.
inline void expect_time_order(const std::function<Greatest(int count)>& run, const std::vector<int>& counts,
                              double order, double least_pressure_order) {
  std::vector<Greatest> errors;
  for (const int count : counts) errors.push_back(run(count));
  for (int f = 0; f < fields; ++f) {
    std::string orders;
    double last = 0;
    for (std::size_t k = 1; k < errors.size(); ++k) {
      last = std::log2(errors[k - 1][f] / errors[k][f]);
      orders += std::to_string(last) + " ";
    }
    testing::Test::RecordProperty(field_names[f], orders + ", error " + std::to_string(errors.back()[f]));
    const bool is_pressure = f == pressure || f == inlet_pressure;
    EXPECT_GT(last, (is_pressure ? least_pressure_order : order) - 0.15)
        << field_names[f] << ", orders from coarse to fine: " << orders;
    EXPECT_LT(last, order + 0.15) << field_names[f] << ", orders from coarse to fine: " << orders;
  }
}

}  // namespace tunica::mms
