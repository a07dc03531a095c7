// SPDX-License-Identifier: GPL-3.0-or-later
// Pressures between which the wall ripples, and the warning about them.
#include "core/stability/scan.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <iostream>

#include "core/error.hpp"
#include "core/stability/warning.hpp"
#include "core/units.hpp"
#include "tests/support/strip_cases.hpp"

namespace tunica {
namespace {

using stability::BaseState;
using stability::Scan;
using stability::Strip;
using test_support::model_with;
using test_support::scene_with;
using test_support::wall_density;
using test_support::wall_under;
using test_support::wave_number;

constexpr double h = test_support::wall_thickness;

std::vector<stability::UnstableRange> ranges(const std::string& law, const std::string& tether,
                                             const std::vector<double>& lengths, Scan scan) {
  const auto model = model_with(wall_under(law, tether));
  return unstable_ranges(*model, scan,
                         [&](const BaseState& base) { return unstable_ripples(base, {lengths}); });
}

TEST(StabilityScan, WaveLengthsAreInEqualRatios) {
  const auto lengths = stability::wave_lengths(0.01, 10, 7);
  ASSERT_EQ(lengths.size(), 7u);
  EXPECT_DOUBLE_EQ(lengths.front(), 0.01);
  EXPECT_DOUBLE_EQ(lengths[3], std::sqrt(0.1));
  EXPECT_DOUBLE_EQ(lengths.back(), 10);
}

// At the ends of a range the least eigenvalue is 0, computed from the whole matrix and not as the scan does.
TEST(StabilityScan, RangesEndWhereTheLeastEigenvalueIsZero) {
  for (const char* law : {"EXP2", "EXP1+EXP2-FS"})
    for (const double share : {0.2, 1.0}) {
      SCOPED_TRACE(testing::Message() << law << ", " << share);
      Scan scan{0.1 * mmhg, 200 * mmhg};
      scan.tolerance = 1e-8;
      const auto found = ranges(law, "reference", {share * h}, scan);
      ASSERT_EQ(found.size(), 1u);
      EXPECT_FALSE(found[0].open_below || found[0].open_above);
      EXPECT_LT(found[0].lower, found[0].upper);
      EXPECT_EQ(found[0].first.length, share * h);
      const auto model = model_with(wall_under(law, "reference"));
      const auto least = [&](double pressure) {
        const BaseState base = stability::base_state(*model, stability::lumen_stretch_at(*model, pressure));
        return Strip(base).least_mode(wave_number(share), wall_density).eigenvalue.real();
      };
      for (const double end : {found[0].lower, found[0].upper}) {
        EXPECT_LT(least(end - 1e-4 * mmhg) * least(end + 1e-4 * mmhg), 0) << end / mmhg << " mmHg";
      }
      EXPECT_LT(least(0.5 * (found[0].lower + found[0].upper)), 0);
    }
}

TEST(StabilityScan, RangesThatLeaveTheScanAreOpen) {
  const auto found = ranges("EXP1+EXP2-FS", "reference", {0.1 * h, 2 * h}, {80 * mmhg, 110 * mmhg, 8});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].open_below && found[0].open_above);
  EXPECT_NEAR(found[0].lower, 80 * mmhg, 1e-6 * mmhg);
  EXPECT_NEAR(found[0].upper, 110 * mmhg, 1e-6 * mmhg);
  EXPECT_EQ(found[0].first.length, 2 * h);
}

// The shorter the wave the wider the range, up to that of the limit of short waves.
TEST(StabilityScan, ShortWavesAreUnstableFirst) {
  for (const char* law : {"EXP2", "EXP1+EXP2-FS"}) {
    const Scan scan{0.1 * mmhg, 200 * mmhg, 40, 1e-5};
    const auto model = model_with(wall_under(law, "reference"));
    const auto limit =
        unstable_ranges(*model, scan, [](const BaseState& base) { return ill_posed_ripples(base, false); });
    ASSERT_EQ(limit.size(), 1u) << law;
    double lower = limit[0].lower, upper = limit[0].upper;
    for (const double share : {0.05, 0.1, 0.25, 0.5, 1.0}) {
      const auto found = ranges(law, "reference", {share * h}, scan);
      ASSERT_EQ(found.size(), 1u) << law << ", " << share;
      EXPECT_GT(found[0].lower, lower);
      EXPECT_LT(found[0].upper, upper);
      lower = found[0].lower;
      upper = found[0].upper;
    }
  }
}

TEST(StabilityScan, TheOtherTethersAndLawsAreStable) {
  const Scan scan{0.5 * mmhg, 160 * mmhg, 20};
  const auto lengths = stability::wave_lengths(0.05 * h, 100 * h, 14);
  for (const char* law : test_support::paper_laws)
    for (const char* tether : test_support::tether_readings) {
      const bool soft = law == std::string("EXP2") || law == std::string("EXP1+EXP2-FS");
      const bool dead = tether == std::string("reference");
      EXPECT_EQ(ranges(law, tether, lengths, scan).empty(), !(soft && dead)) << law << ", " << tether;
    }
}

TEST(StabilityScan, PressureThatTheWallCannotCarryIsRefused) {
  const auto model = model_with({"wall.law=neo-Hookean", "wall.shear_modulus=1e4", "tether.stiffness=0"});
  EXPECT_THROW(stability::unstable_ranges(*model, {1, 1e6},
                                          [](const BaseState&) { return std::vector<stability::Ripple>(); }),
               SolverFailure);
}

TEST(StabilityWarning, SaysPressuresWaveLengthAndRemedy) {
  const auto text = stability::warning(scene_with(wall_under("EXP1+EXP2-FS", "reference")), 130 * mmhg);
  ASSERT_TRUE(text);
  EXPECT_EQ(text->find('\n'), std::string::npos);
  for (const char* part : {"tether.traction = \"reference\"", "from 55 to 130 mmHg",
                           "wave lengths up to 0.06", "tether.traction = \"normal\""})
    EXPECT_NE(text->find(part), std::string::npos) << part << " in: " << *text;
}

TEST(StabilityWarning, IsSilentForStableWalls) {
  for (const char* law : test_support::paper_laws)
    EXPECT_FALSE(stability::warning(scene_with(wall_under(law, "normal")), 160 * mmhg)) << law;
  for (const char* law : {"EXP1", "EXP1+EXP2-ZS"})
    EXPECT_FALSE(stability::warning(scene_with(wall_under(law, "reference")), 160 * mmhg)) << law;
  EXPECT_FALSE(stability::warning(scene_with(wall_under("EXP1+EXP2-FS", "reference")), 50 * mmhg));
  EXPECT_FALSE(stability::warning(scene_with(wall_under("EXP1+EXP2-FS", "reference")), 0));
}

// A law of small strains has no stress that stiffens a surface against turning, but the pressure does turn.
TEST(StabilityWarning, HasAnotherRemedyWhereTheTetherIsNotToBlame) {
  for (const char* tether : {"normal", "reference"}) {
    const auto text =
        stability::warning(scene_with({"wall.law=linear-elastic", "wall.young_modulus=1e5",
                                       "wall.poisson_ratio=0.49", std::string("tether.traction=") + tether}),
                           60 * mmhg);
    ASSERT_TRUE(text) << tether;
    EXPECT_NE(text->find("use a stiffer wall or tether"), std::string::npos) << *text;
    EXPECT_EQ(text->find("with which it is stable"), std::string::npos) << *text;
  }
}

// Some 10 to 30 ms where everything is optimised; the bar leaves room for sanitisers and busy machines.
TEST(StabilityWarning, IsCheapEnoughToBeGivenAlways) {
  for (const char* tether : test_support::tether_readings) {
    const Scene scene = scene_with(wall_under("EXP1+EXP2-FS", tether));
    const auto start = std::chrono::steady_clock::now();
    stability::warning(scene, 130 * mmhg);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    std::cout << tether << ": " << time.count() << " ms\n";
    EXPECT_LT(time.count(), 3000) << tether;
  }
}

}  // namespace
}  // namespace tunica
