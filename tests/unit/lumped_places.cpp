// SPDX-License-Identifier: GPL-3.0-or-later
// What tables show of stress and fibres against the law itself.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/observables/result.hpp"
#include "lumped/wall_tables.hpp"
#include "tests/support/lumped_runs.hpp"

using namespace tunica;

namespace {

class Places : public testing::TestWithParam<const char*> {};

}  // namespace

// To the accuracy of the wall's response, 2e-2 of the scene's, over the range that an artery works in: fibres
// are recruited from one surface to the other within it. H is as steep as its sharpness.
TEST_P(Places, TablesShowWhatTheLawSays) {
  for (const double tolerance : {1e-3, 1e-6}) {
    const Scene scene =
        test_support::scene_with({GetParam(), fmt::format("accuracy.tolerance={}", tolerance)});
    const auto wall = lumped::wall_table(scene, {});
    const double accuracy = 2e-2 * tolerance;
    for (int place = 0; place < observables::wall_points; ++place) {
      double greatest = 0, stress_gap = 0, fiber_gap = 0;
      for (int k = 1; k <= 400; ++k) {
        const double stretch = 1 + 0.8 * k / 401;
        const double exact = wall->places.computed_von_mises(stretch, place);
        greatest = std::max(greatest, exact);
        stress_gap = std::max(stress_gap, std::abs(wall->places.von_mises(stretch, place) - exact));
        const auto fiber = wall->places.fiber(stretch, place);
        const auto of_law = wall->places.computed_fiber(stretch, place);
        ASSERT_EQ(fiber.has_value(), of_law.has_value());
        if (!fiber) continue;
        fiber_gap = std::max(
            {fiber_gap, std::abs(fiber->angle - of_law->angle), std::abs(fiber->stretch - of_law->stretch)});
        if (std::abs(of_law->recruitment - 0.5) > 0.499) {
          EXPECT_NEAR(fiber->recruitment, of_law->recruitment, 1e-3) << stretch;
        }
      }
      EXPECT_LT(stress_gap, accuracy * greatest) << "P" << place + 1;
      EXPECT_LT(fiber_gap, accuracy) << "P" << place + 1;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Lumped, Places,
                         testing::Values("wall.law=EXP1", "wall.law=EXP1+EXP2-FS", "wall.law=EXP1+EXP2-ZS",
                                         "wall.law=neo-Hookean", "wall.sharpness=10",
                                         "wall.incompressible=true"));
