// SPDX-License-Identifier: GPL-3.0-or-later
// Short ripples: the half-space is what the strip tends to.
#include "core/stability/half_space.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/strip_cases.hpp"

namespace tunica {
namespace {

using stability::BaseState;
using stability::HalfSpace;
using stability::Strip;
using test_support::wall_at;
using test_support::wall_density;
using test_support::wave_number;

// The stiffness of the strip's outer surface over k R is that of the half-space, up to springs and curvature,
// which are worth 1/k: half as much for waves half as long.
TEST(HalfSpace, IsTheLimitOfShortWaves) {
  for (const char* law : test_support::paper_laws)
    for (const char* tether : test_support::tether_readings) {
      SCOPED_TRACE(testing::Message() << law << ", " << tether);
      const BaseState base = wall_at(law, tether, 90, {10, 0.02});
      const Eigen::Matrix3d limit = *HalfSpace(base.outer).stiffness(0);
      const auto gap = [&](double share) {
        const double k = wave_number(share);
        const Eigen::MatrixXd stiffness = Strip(base, 0, true).surface_stiffness(k) / (k * base.outer.radius);
        return Eigen::Matrix3d(stiffness - limit);
      };
      const Eigen::Matrix3d at_08 = gap(0.08), at_04 = gap(0.04), at_02 = gap(0.02);
      const double scale = limit.cwiseAbs().maxCoeff();
      EXPECT_LT(at_02.cwiseAbs().maxCoeff(), 0.05 * scale);
      EXPECT_LT((at_04 - 0.5 * at_08).cwiseAbs().maxCoeff(), 2e-3 * scale);
      EXPECT_LT((at_02 - 0.5 * at_04).cwiseAbs().maxCoeff(), 1e-3 * scale);
    }
}

// The same at an angle: m and k in the ratio that the angle says.
TEST(HalfSpace, ObliqueRipplesAreHelices) {
  const BaseState base = wall_at("EXP1+EXP2-FS", "reference", 100, {10, 0.02});
  const double turn = 0.6;
  const Eigen::Matrix3d limit = *HalfSpace(base.outer).stiffness(turn);
  const auto gap = [&](int m) {
    const double total = m / base.outer.radius / std::sin(turn);
    return Eigen::Matrix3d(
        Strip(base, m).surface_stiffness(total * std::cos(turn)) / (total * base.outer.radius) - limit);
  };
  const double scale = limit.cwiseAbs().maxCoeff();
  EXPECT_LT(gap(500).cwiseAbs().maxCoeff(), 0.05 * scale);
  EXPECT_LT((gap(500) - 0.5 * gap(250)).cwiseAbs().maxCoeff(), 2e-3 * scale);
}

TEST(HalfSpace, GrowthOfShortRipplesIsProportionalToTheWaveNumber) {
  const BaseState base = wall_at("EXP1+EXP2-FS", "reference", 100, {10, 0.02});
  const double speed = HalfSpace(base.outer).growth_speed(0, wall_density);
  const auto gap = [&](double share) {
    return Strip(base).least_mode(wave_number(share), wall_density).growth_rate / wave_number(share) / speed -
           1;
  };
  EXPECT_LT(std::abs(gap(0.02)), 0.02);
  EXPECT_NEAR(gap(0.04) / gap(0.02), 2, 0.1);
}

TEST(HalfSpace, SurfaceWithAConservativeLoadIsSymmetric) {
  for (const char* law : test_support::paper_laws) {
    const BaseState base = wall_at(law, "normal", 90);
    for (const auto* surface : {&base.inner, &base.outer})
      for (const double angle : {0.0, 0.5, 1.2}) {
        const Eigen::Matrix3d s = *HalfSpace(*surface).stiffness(angle);
        EXPECT_LT((s - s.transpose()).cwiseAbs().maxCoeff(), 1e-8 * s.cwiseAbs().maxCoeff());
        EXPECT_GT(HalfSpace(*surface).least_stiffness(angle), 0);
        EXPECT_EQ(HalfSpace(*surface).growth_speed(angle, wall_density), 0);
      }
  }
}

// Tissue whose shear stiffness is below 0 ripples within, which no surface can prevent.
TEST(HalfSpace, TissueThatIsNotEllipticIsSaidToBeSo) {
  BaseState base = wall_at("EXP1", "normal", 20);
  auto& tangent = base.outer.tangent;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j) tangent[3 * i + j][3 * i + j] = -1e4;
  const HalfSpace surface(base.outer);
  EXPECT_FALSE(surface.stiffness(0).has_value());
  EXPECT_EQ(surface.least_stiffness(0), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(surface.growth_speed(0, wall_density), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace tunica
