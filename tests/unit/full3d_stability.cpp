// SPDX-License-Identifier: GPL-3.0-or-later
// The stability of static walls in space against that of the half plane on the same cells.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/full3d_runs.hpp"
#include "tests/support/strip_cases.hpp"

namespace tunica {
namespace {

using test_support::artery;
using test_support::joined;

/// Four thicknesses of a wall that slides at its ends, so that whole numbers of half waves fit in.
Scene wall(const std::string& tether, int pressure) {
  return artery(
      joined(test_support::wall_under("EXP1+EXP2-FS", tether),
             {{"geometry.ends=sliding", "geometry.length=0.04", "inlet.profile=natural",
               "inlet.waveform=pressure", "time.mode=static", "mesh.wall_cells=3", "mesh.axial_cells=12",
               "mesh.around_cells=8", "inlet.pressure=" + std::to_string(pressure) + " mmHg"}}));
}

struct Found {
  int negative;
  double least_eigenvalue;
  std::vector<std::string> findings;
};
Found found(const Result& result) {
  const auto& resolution = result.record.resolution;
  return {resolution.at("negative_pivots"), resolution.at("least_eigenvalue"), result.record.findings};
}

// Near its onset the least mode is the same all around, and both tiers have it: 2 % are twice what bisection
// leaves.
TEST(Full3dStability, LeastModeOfThePrintedTetherIsThatOfTheHalfPlane) {
  for (const int pressure : {50, 70}) {
    SCOPED_TRACE(pressure);
    const Scene scene = wall("reference", pressure);
    const Found space = found(test_support::run_full3d(scene)),
                plane = found(test_support::run_axisym(scene));
    EXPECT_NEAR(space.least_eigenvalue / plane.least_eigenvalue, 1, 0.02);
    // Ripples that vary around the section are more.
    EXPECT_GE(space.negative, plane.negative);
    if (pressure == 50) {
      EXPECT_EQ(space.negative, 0);
      EXPECT_TRUE(space.findings.empty());
      continue;
    }
    EXPECT_GT(plane.negative, 0);
    ASSERT_EQ(space.findings.size(), 1u);
    ASSERT_EQ(plane.findings.size(), 1u);
    // The same rate of growth and wave length.
    const auto tail = [](const std::string& text) { return text.substr(text.find("of which")); };
    EXPECT_EQ(tail(space.findings[0]), tail(plane.findings[0]));
    EXPECT_NE(space.findings[0].find("as ripples of 0.0"), std::string::npos) << space.findings[0];
  }
}

// What varies around the section is among the motions, and lowers the least eigenvalue.
TEST(Full3dStability, DefaultTetherHoldsInSpaceToo) {
  const Scene scene = wall("normal", 100);
  const Found space = found(test_support::run_full3d(scene)), plane = found(test_support::run_axisym(scene));
  EXPECT_EQ(space.negative, 0);
  EXPECT_EQ(plane.negative, 0);
  EXPECT_TRUE(space.findings.empty());
  EXPECT_GT(space.least_eigenvalue, 0);
  EXPECT_LT(space.least_eigenvalue, plane.least_eigenvalue);
}

}  // namespace
}  // namespace tunica
