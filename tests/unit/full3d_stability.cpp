// SPDX-License-Identifier: GPL-3.0-or-later
// The stability of static walls in space against that of the half plane on the same cells.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
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

/// A tube on rollers without tether: free to shift sideways and to turn about its axis.
Scene tube_on_rollers(const std::string& symmetry, double pressure, std::vector<std::string> more = {}) {
  return artery(
      joined({"geometry.radius=0.1", "geometry.thickness=0.03", "geometry.length=0.6",
              "geometry.ends=sliding", "wall.law=St-Venant-Kirchhoff", "wall.young_modulus=1e7",
              "wall.poisson_ratio=0.3", "tether.stiffness=0", "time.mode=static", "inlet.waveform=pressure",
              "mesh.wall_cells=1", "mesh.axial_cells=4", "mesh.around_cells=8",
              "inlet.pressure=" + std::to_string(pressure), "mesh.symmetry=" + symmetry},
             {std::move(more)}));
}
int neutral(const Result& result) {
  return result.record.resolution.value("neutral_motions", 0);
}

TEST(NeutralMotions, AreNoAlarm) {
  const Result full = test_support::run_full3d(tube_on_rollers("full", 1e4)),
               half = test_support::run_full3d(tube_on_rollers("half", 1e4)),
               quarter = test_support::run_full3d(tube_on_rollers("quarter", 1e4)),
               plane = test_support::run_axisym(tube_on_rollers("full", 1e4));
  // Two shifts and a turn; along the plane of the half; none in a quarter, nor in the half plane.
  EXPECT_EQ(neutral(full), 3);
  EXPECT_EQ(neutral(half), 1);
  EXPECT_EQ(neutral(quarter), 0);
  EXPECT_EQ(neutral(plane), 0);
  for (const Result* each : {&full, &half, &quarter, &plane}) {
    EXPECT_EQ(found(*each).negative, 0);
    EXPECT_TRUE(found(*each).findings.empty());
  }
  // The least mode that deforms: in a quarter those are missing that are not symmetric about both planes.
  EXPECT_NEAR(found(full).least_eigenvalue / found(half).least_eigenvalue, 1, 0.02);
  EXPECT_LT(found(full).least_eigenvalue, found(quarter).least_eigenvalue);
  EXPECT_LT(found(quarter).least_eigenvalue, found(plane).least_eigenvalue);
  // Nothing has drifted along what nothing holds.
  const auto& moved = full.observables.find("radial_displacement.P1")->values.back();
  EXPECT_NEAR(moved / quarter.observables.find("radial_displacement.P1")->values.back(), 1, 1e-9);
}

// A ring of radius r through the middle of its wall buckles under the external pressure
// E/(4 (1 - nu^2)) (h/r)^3 (Bresse), here a suction on the inner surface, which is smaller by R/r.
TEST(NeutralMotions, DoNotHideATubeThatBuckles) {
  const double radius = 0.1, middle = 0.115, thickness = 0.03;
  const double critical = 1e7 / (4 * (1 - 0.3 * 0.3)) * std::pow(thickness / middle, 3) * middle / radius;
  const Result before = test_support::run_full3d(tube_on_rollers("full", -0.5 * critical)),
               beyond = test_support::run_full3d(tube_on_rollers("full", -2 * critical));
  EXPECT_EQ(neutral(before), 3);
  EXPECT_EQ(found(before).negative, 0);
  EXPECT_TRUE(found(before).findings.empty());
  EXPECT_EQ(neutral(beyond), 3);
  // It becomes an oval, in one of two directions.
  EXPECT_GE(found(beyond).negative, 2);
  ASSERT_EQ(found(beyond).findings.size(), 1U);
  EXPECT_NE(found(beyond).findings[0].find("is unstable"), std::string::npos);
}

// Motions that something holds are none: a tether resists shifts, and clamped ends leave none.
TEST(NeutralMotions, AreThoseThatNothingHolds) {
  for (const char* held : {"tether.stiffness=1e6", "geometry.ends=clamped"}) {
    const Result result = test_support::run_full3d(tube_on_rollers("full", 1e4, {held}));
    EXPECT_EQ(neutral(result), 0) << held;
    EXPECT_EQ(found(result).negative, 0) << held;
    EXPECT_GT(found(result).least_eigenvalue, 0) << held;
  }
}

}  // namespace
}  // namespace tunica
