// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/coupled/newton.hpp"
#include "tests/mms/errors.hpp"

namespace tunica::mms {

/// What is the same in all studies of orders in space; laws are `bulk_modulus` stiff against changes of
/// volume.
template <class Motion>
void set_instant(const Vessel<Motion>& vessel, double bulk_modulus, radial::TetherTraction tether,
                 InletKind inlet, Conditions<Motion::dimension>& problem) {
  problem.blood = {1.1, 0.6};
  problem.laws = {wall::SplitLaw<double, wall::Exp1>{{bulk_modulus}, {40, 0.5}, {}}};
  problem.wall_density = 1.2;
  problem.tether = {3, tether};
  problem.inlet.kind = inlet;
  problem.outlet.resistance = 0.7;
  problem.outlet.backflow = 0.5;
  set_loads(vessel, problem);
}

/// The equations at one instant of the motion: rates are those of a time scheme of which all past values
/// are exact, so that everything is there but an error in time. Steady: all rates are zero.
template <class Cells, class Motion>
Errors solve_instant(const coupled::Equations& equations, const typename Cells::Problem& problem,
                     const Vessel<Motion>& vessel) {
  const Layout& layout = equations.layout();
  const double time = 0.2, coefficient = vessel.steady ? 0 : 2;
  std::vector<double> y = nodal<Cells>(problem, layout, vessel, time);
  std::vector<double> history = nodal<Cells>(problem, layout, vessel, time, true);
  for (std::size_t e = 0; e < y.size(); ++e) history[e] -= coefficient * y[e];
  coupled::Newton newton(equations);
  const auto report = newton.solve({time, coefficient, history}, y, {1e-10, 30});
  EXPECT_TRUE(report.converged) << report.failure;
  return errors<Cells>(problem, layout, y, vessel, time);
}

/// Errors with so many cells along a side.
struct Level {
  int cells;
  Errors errors;
};

struct TheoryOfOrders {
  double order, least_pressure_order, greatest_pressure_order;
};

/// The order between the last two of the levels is within 0.15 below and `slack_above` what theory says.
inline void expect_orders(const std::vector<Level>& levels, const TheoryOfOrders& theory, double slack_above,
                          bool has_inlet_pressure) {
  const auto expect = [&](const char* what, double Errors::*error, double least, double greatest) {
    std::string orders;
    double order = 0;
    for (std::size_t k = 1; k < levels.size(); ++k) {
      order = std::log(levels[k - 1].errors.*error / levels[k].errors.*error) /
              std::log(static_cast<double>(levels[k].cells) / levels[k - 1].cells);
      orders += std::to_string(order) + " ";
    }
    testing::Test::RecordProperty(what, orders + ", error " + std::to_string(levels.back().errors.*error));
    EXPECT_GT(order, least - 0.15) << what << ", orders from coarse to fine: " << orders;
    EXPECT_LT(order, greatest + slack_above) << what << ", orders from coarse to fine: " << orders;
  };
  expect("wall displacement", &Errors::wall_displacement, theory.order, theory.order);
  expect("blood displacement", &Errors::blood_displacement, theory.order, theory.order);
  expect("velocity", &Errors::velocity, theory.order, theory.order);
  expect("pressure", &Errors::pressure, theory.least_pressure_order, theory.greatest_pressure_order);
  // These follow from integrals over the openings, which may converge faster than fields.
  expect("outlet pressure", &Errors::outlet_pressure, theory.order, 10);
  if (has_inlet_pressure) expect("inlet pressure", &Errors::inlet_pressure, theory.order, 10);
}

}  // namespace tunica::mms
