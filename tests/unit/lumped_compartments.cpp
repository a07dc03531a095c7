// SPDX-License-Identifier: GPL-3.0-or-later
// What a chain of compartments shows along the artery.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/lumped_runs.hpp"

namespace tunica {
namespace {

using test_support::column;
using test_support::run_lumped;

TEST(LumpedCompartments, MiddleAndEndAreThoseOfTheObservables) {
  const Result result = run_lumped({"lumped.compartments=5", "time.beats=1"});
  const auto& chain = result.compartments;
  ASSERT_EQ(chain.rows(), result.observables.rows());
  const auto& pressure = column(result.observables, "pressure");
  const auto& displacement = column(result.observables, "radial_displacement.P1");
  const auto& outflow = column(result.observables, "outflow");
  for (std::size_t row = 0; row < chain.rows(); row += 37) {
    // The same numbers reached by another path: round-off of the square root apart.
    EXPECT_NEAR(column(chain, "pressure.C3")[row], pressure[row], 1e-9 * std::abs(pressure[row]) + 1e-9);
    EXPECT_NEAR(column(chain, "lumen_radius.C3")[row], 0.033 + displacement[row], 1e-13);
    EXPECT_DOUBLE_EQ(column(chain, "outflow.C5")[row], outflow[row]);
  }
}

// Between neighbours Poiseuille's law holds at every moment, with half of the resistance from each.
TEST(LumpedCompartments, PressureFallsByPoiseuillesLaw) {
  const Result result = run_lumped({"lumped.compartments=4", "time.beats=1"});
  const auto& chain = result.compartments;
  const double length = 0.66 / 4, viscosity = 0.035;
  const auto resistance = [&](int i, std::size_t row) {
    const double radius = column(chain, fmt::format("lumen_radius.C{}", i))[row];
    return 8 * viscosity * length / (std::numbers::pi * std::pow(radius, 4));
  };
  for (std::size_t row = 100; row < chain.rows(); row += 50) {
    for (int i = 1; i < 4; ++i) {
      const double fall = column(chain, fmt::format("pressure.C{}", i))[row] -
                          column(chain, fmt::format("pressure.C{}", i + 1))[row];
      const double expected = 0.5 * (resistance(i, row) + resistance(i + 1, row)) *
                              column(chain, fmt::format("outflow.C{}", i))[row];
      // The fall is a thousandth of the pressures whose difference it is: 12 of 16 digits remain.
      EXPECT_NEAR(fall, expected, 1e-10 * column(chain, "pressure.C1")[row]);
    }
  }
}

TEST(LumpedCompartments, OneAloneHasNoTable) {
  EXPECT_TRUE(run_lumped({"time.beats=1"}).compartments.columns().empty());
}

}  // namespace
}  // namespace tunica
