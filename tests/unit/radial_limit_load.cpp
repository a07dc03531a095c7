// SPDX-License-Identifier: GPL-3.0-or-later
// What a wall is said to carry at most.
#include <gtest/gtest.h>

#include <cmath>

#include "core/radial/limit_load.hpp"
#include "core/radial/wall_curve.hpp"
#include "tests/support/ring_cases.hpp"

namespace tunica {
namespace {

using radial::limit_load;
using test_support::model_with;

constexpr double greatest_stretch = radial::WallCurve::greatest_stretch;

/// Pressure of an incompressible neo-Hookean tube without tether, mu [ln(s/l) - 1/(2 s^2) + 1/(2 l^2)] with
/// the stretch l of its outer surface.
double tube_pressure(double stretch, double ratio) {
  const double outer = std::sqrt(1 + (stretch * stretch - 1) * ratio * ratio);
  return 76350 * (std::log(stretch / outer) - 1 / (2 * stretch * stretch) + 1 / (2 * outer * outer));
}

// Neo-Hookean tissue that gives in volume, too, has a maximum: pressure falls on either side of it.
TEST(LimitLoad, OfATubeThatGivesWayIsItsMaximum) {
  const auto model = model_with({"wall.law=neo-Hookean", "tether.stiffness=0"});
  const auto limit = limit_load(*model, greatest_stretch);
  ASSERT_TRUE(limit);
  const auto pressure = [&](double stretch) { return model->respond(stretch, {}, false).pressure; };
  EXPECT_NEAR(pressure(limit->stretch), limit->pressure, 1e-9 * limit->pressure);
  for (const double away : {0.01, 0.1, 0.3}) {
    EXPECT_LT(pressure(limit->stretch - away), limit->pressure);
    EXPECT_LT(pressure(limit->stretch + away), limit->pressure);
  }
  EXPECT_LT(limit->stretch, 3.7);
}

// Incompressible tissue levels off: its pressure rises to mu ln(R_o/R_i), and what it has come to at the
// greatest stretch is what it is said to carry.
TEST(LimitLoad, OfATubeThatLevelsOffIsWhatItHasComeTo) {
  const auto limit =
      limit_load(*model_with({"wall.law=neo-Hookean", "wall.incompressible=true", "tether.stiffness=0"}),
                 greatest_stretch);
  ASSERT_TRUE(limit);
  EXPECT_EQ(limit->stretch, greatest_stretch);
  EXPECT_NEAR(limit->pressure / tube_pressure(greatest_stretch, 33.0 / 43), 1, 1e-9);
  EXPECT_NEAR(limit->pressure / (76350 * std::log(43.0 / 33)), 1, 0.05);
}

// Walls that stiffen, or that a tether holds, carry what they are asked to.
TEST(LimitLoad, NoneOfWallsWhosePressureRisesOn) {
  for (const std::vector<std::string>& overrides : {std::vector<std::string>{},
                                                    {"geometry.thickness=0.1"},
                                                    {"wall.fiber_stiffening=10"},
                                                    {"wall.fiber_angle=88"},
                                                    {"wall.law=EXP1", "tether.stiffness=0"},
                                                    {"wall.law=neo-Hookean"},
                                                    {"wall.law=EXP1", "wall.bulk_modulus=1e12"}})
    EXPECT_FALSE(limit_load(*model_with(overrides), greatest_stretch))
        << (overrides.empty() ? "" : overrides[0]);
}

}  // namespace
}  // namespace tunica
