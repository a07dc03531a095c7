// SPDX-License-Identifier: GPL-3.0-or-later
// The stability of static states on the whole mesh, against the periodic strip of core/stability.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "axisym/assembler.hpp"
#include "axisym/coarser_meshes.hpp"
#include "axisym/setup.hpp"
#include "axisym/tangent_stability.hpp"
#include "core/coupled/newton.hpp"
#include "tests/support/strip_cases.hpp"

namespace tunica::axisym {
namespace {

constexpr double half_waves_length = 0.2;  // cm: twenty thicknesses

/// A wall that slides at its ends, so that exactly the waves of which a whole number of halves fits in are
/// there.
TangentStability strip_on_mesh(const std::string& law, const std::string& tether, double pressure) {
  auto overrides = test_support::wall_under(law, tether);
  for (const char* more :
       {"geometry.ends=sliding", "geometry.length=0.2", "inlet.profile=natural", "inlet.waveform=pressure",
        "time.mode=static", "mesh.wall_cells=6", "mesh.axial_cells=60"})
    overrides.emplace_back(more);
  overrides.push_back("inlet.pressure=" + std::to_string(pressure) + " mmHg");
  const Scene scene = parse_scene("[geometry]\nradius = 0.033\n", "strip", ".", overrides);
  const auto setup = setup_of(scene);
  const Assembler assembler(setup->problem);
  coupled::Newton newton(assembler);
  coupled::StaticReport report;
  const auto state = coupled::static_state(
      *setup, assembler, CoarserMeshes(scene, *setup), newton, 0, 1e-9, [] { return false; }, report);
  return tangent_stability(assembler, 0, state);
}

/// Least eigenvalue over the same waves.
double strip_by_waves(const std::string& law, const std::string& tether, double pressure, double shortest) {
  const stability::Strip strip(test_support::wall_at(law, tether, pressure));
  double least = std::numeric_limits<double>::infinity();
  for (int halves = 1; 2 * half_waves_length / halves >= shortest; ++halves) {
    const double k = std::numbers::pi * halves / half_waves_length;
    least = std::min(least, strip.least_mode(k, test_support::wall_density).eigenvalue.real());
  }
  return least;
}

TEST(AxisymStability, LongRipplesOfThePrintedTetherAreThoseOfTheStrip) {
  // Near the onset the fastest waves are some 3 h long: 18 quadratic cells each. Bisection stops at 1 %.
  for (const double pressure : {66.0, 70.0}) {
    const auto mesh = strip_on_mesh("EXP1+EXP2-FS", "reference", pressure);
    const double strip =
        strip_by_waves("EXP1+EXP2-FS", "reference", pressure, 2 * test_support::wall_thickness);
    EXPECT_LT(strip, 0);
    EXPECT_GT(mesh.negative, 0);
    EXPECT_NEAR(mesh.least_eigenvalue / strip, 1, 0.03) << pressure;
    EXPECT_NEAR(mesh.wave_length, 3 * test_support::wall_thickness, 0.5 * test_support::wall_thickness);
  }
}

TEST(AxisymStability, NegativeDirectionsComeAndGoWithThePressuresOfTheStrip) {
  // Of waves above h, FS is unstable from 63.8 to 146.5 mmHg (docs/verification/tether-stability.md).
  EXPECT_EQ(strip_on_mesh("EXP1+EXP2-FS", "reference", 62).negative, 0);
  EXPECT_GT(strip_on_mesh("EXP1+EXP2-FS", "reference", 65.5).negative, 0);
  EXPECT_EQ(strip_on_mesh("EXP1+EXP2-FS", "reference", 160).negative, 0);
}

TEST(AxisymStability, OtherWallsAreStable) {
  EXPECT_EQ(strip_on_mesh("EXP1+EXP2-FS", "normal", 100).negative, 0);
  const auto stiff = strip_on_mesh("EXP1", "reference", 100);
  EXPECT_EQ(stiff.negative, 0);
  EXPECT_NEAR(stiff.least_eigenvalue / strip_by_waves("EXP1", "reference", 100, test_support::wall_thickness),
              1, 0.03);
}

}  // namespace
}  // namespace tunica::axisym
