// SPDX-License-Identifier: GPL-3.0-or-later
// Pressures at which collagen is recruited in the paper's cylinder (EXP1+EXP2-FS).
#include <gtest/gtest.h>

#include <array>

#include "core/radial/wall_curve.hpp"
#include "core/units.hpp"
#include "tests/support/ring_cases.hpp"

namespace tunica {
namespace {

std::array<double, 4> recruitment_pressures(const std::vector<std::string>& overrides) {
  const radial::WallCurve curve(test_support::model_with(overrides), {0.0, 1.0 / 3, 2.0 / 3, 1.0});
  std::array<double, 4> pressures{};
  for (const auto& threshold : curve.thresholds())
    pressures[threshold.place] = curve.pressure(threshold.stretch) / mmhg;
  return pressures;
}

// Worked out apart from this program for exactly incompressible tissue and the tether as printed:
// 84, 96.5, 111.5 and 128.7 mmHg, given to these digits.
TEST(RadialThresholds, OfIncompressibleTissueWithTheTetherAsPrinted) {
  const auto pressures = recruitment_pressures({"tether.traction=reference", "wall.incompressible=true"});
  EXPECT_NEAR(pressures[0], 84.0, 0.05);
  EXPECT_NEAR(pressures[1], 96.5, 0.05);
  EXPECT_NEAR(pressures[2], 111.5, 0.05);
  EXPECT_NEAR(pressures[3], 128.7, 0.05);
}

// Compressible tissue gives way by J - 1 of about -p/kappa, here 1 to 2 %, so that the same lumen
// pressure recruits it earlier by about that share; twice kappa halves the shift.
TEST(RadialThresholds, MoveWithOneOverTheBulkModulus) {
  const auto limit = recruitment_pressures({"tether.traction=reference", "wall.incompressible=true"});
  const auto soft = recruitment_pressures({"tether.traction=reference", "wall.bulk_modulus=9e6"});
  const auto stiff = recruitment_pressures({"tether.traction=reference", "wall.bulk_modulus=18e6"});
  for (int k = 0; k < 4; ++k) {
    EXPECT_GT(limit[k] - soft[k], 0.005 * limit[k]);
    EXPECT_LT(limit[k] - soft[k], 0.02 * limit[k]);
    EXPECT_NEAR((limit[k] - soft[k]) / (limit[k] - stiff[k]), 2, 0.1);
  }
}

// Fibres that far below their threshold leave the elastin alone, at rest and under load.
TEST(RadialThresholds, BeyondReachLeaveTheMatrix) {
  for (const char* stretch : {"wall.activation_stretch=4", "wall.activation_stretch=5"}) {
    const auto model = test_support::model_with({stretch, "tether.stiffness=0"});
    EXPECT_NEAR(model->respond(1.0, {}, false).pressure, 0, 1e-3 * mmhg) << stretch;
    const auto elastin = test_support::model_with(
        {"wall.law=EXP1", "wall.stiffness=3.5270e4", "wall.stiffening=0.3424", "tether.stiffness=0"});
    EXPECT_NEAR(model->respond(1.4, {}, false).pressure / elastin->respond(1.4, {}, false).pressure, 1, 1e-4)
        << stretch;
  }
}

}  // namespace
}  // namespace tunica
