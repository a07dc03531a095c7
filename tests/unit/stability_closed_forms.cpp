// SPDX-License-Identifier: GPL-3.0-or-later
// Ripples of the wall against solutions in closed form: waves of elastic tubes, the surface of a half-space
// under compression and under a dead load, and the pressure maximum of a rubber tube.
#include <gtest/gtest.h>

#include <cmath>

#include "core/root.hpp"
#include "core/stability/half_space.hpp"
#include "tests/support/strip_cases.hpp"

namespace tunica {
namespace {

using stability::BaseState;
using stability::HalfSpace;
using stability::Strip;
using test_support::elastic_wall;
using test_support::joined;
using test_support::model_with;
using test_support::wall_density;
using test_support::wall_stretched;
using test_support::wave_number;

constexpr double along = 0, around = std::numbers::pi / 2;
constexpr double young = 3e6, poisson = 0.25, shear = young / (2 * (1 + poisson));
constexpr double inner = 0.033, outer = 0.043;

double least(const BaseState& base, int m, bool twist, double k) {
  return Strip(base, m, twist).least_mode(k, wall_density).eigenvalue.real();
}

// d_theta = R sin(k Z - w t) with w^2 = k^2 mu/rho, exact for every tube; below other waves when it is long.
TEST(StabilityClosedForm, TorsionTravelsAtTheSpeedOfShear) {
  const BaseState base = wall_stretched(elastic_wall(young, poisson), 1.0, {8, 1});
  for (const double k : {1.0, 5.0, 20.0})
    // Round-off is relative to the fastest oscillations across the wall, some 1e9 times the square of k = 1.
    EXPECT_NEAR(least(base, 0, true, k) * wall_density / (shear * k * k), 1, 1e-6 / (k * k)) << k;
}

// Long axial waves are those of a bar, w^2 = k^2 E/rho; the inertia of the section's breathing slows them by
// nu^2 k^2 R^2 with R^2 = (R_i^2 + R_o^2)/2 (Love, section 278).
TEST(StabilityClosedForm, LongAxialWavesAreThoseOfABar) {
  const BaseState base = wall_stretched(elastic_wall(young, poisson), 1.0, {8, 1});
  for (const double k : {0.5, 1.0, 2.0})
    EXPECT_NEAR(least(base, 0, false, k) * wall_density / (young * k * k),
                1 - poisson * poisson * k * k * (inner * inner + outer * outer) / 2, 1e-5)
        << k;
}

// In-extensional bending of a thin ring in plane strain (Love, Mathematical Theory of Elasticity, section
// 293): w^2 = E/(1-nu^2) h^2/(12 rho R^4) m^2 (m^2-1)^2/(m^2+1); shear and rotary inertia are worth (m
// h/R)^2.
TEST(StabilityClosedForm, ThinRingBends) {
  for (const double ratio : {0.02, 0.01}) {
    const BaseState base = wall_stretched(
        joined(elastic_wall(young, poisson), {"geometry.radius=" + std::to_string(1 - ratio / 2),
                                              "geometry.thickness=" + std::to_string(ratio)}),
        1.0, {8, 1});
    for (const int m : {2, 3, 4}) {
      const double squared = m * m;
      const double exact = young / (1 - poisson * poisson) * ratio * ratio / (12 * wall_density) * squared *
                           (squared - 1) * (squared - 1) / (squared + 1);
      EXPECT_NEAR(least(base, m, true, 0) / exact, 1, squared * ratio * ratio) << "m = " << m;
    }
  }
}

// Rayleigh's wave for nu = 1/4: rho c^2 = (2 - 2/sqrt(3)) mu. The surface yields to it without a force.
TEST(StabilityClosedForm, SurfaceWavesAreRayleighs) {
  const BaseState base = wall_stretched(elastic_wall(young, poisson), 1.0);
  const double rayleigh = (2 - 2 / std::sqrt(3.0)) * shear;
  for (const auto* surface : {&base.inner, &base.outer})
    for (const double angle : {along, 0.4, around})
      EXPECT_NEAR(HalfSpace(*surface).least_stiffness(angle, -rayleigh), 0, 1e-10 * shear) << angle;
  // In the tube they bend with the surface, a relative effect of 1/(k R).
  for (const double share : {0.2, 0.1, 0.05}) {
    const double k = wave_number(share);
    EXPECT_NEAR(least(base, 0, false, k) * wall_density / (k * k) / rayleigh, 1, 1.5 / (k * inner));
  }
}

std::vector<std::string> rubber(const std::string& tether, const std::string& reading = "normal") {
  return {"wall.law=neo-Hookean", "wall.shear_modulus=76350", "wall.incompressible=true",
          "tether.stiffness=" + tether, "tether.traction=" + reading};
}

// Biot's surface instability in plane strain: l^6 + l^4 + 3 l^2 = 1, l = 0.5437, of the stretch along a
// ripple. A lumen sucked in is pressed together like that along its circumference. The pressure there follows
// the surface, which for incompressible tissue is no load at all.
TEST(StabilityClosedForm, CompressedSurfaceYieldsAtBiotsStretch) {
  const double biot =
      find_root([](double l) { return std::pow(l, 6) + std::pow(l, 4) + 3 * l * l - 1; }, 0.5, 0.6, 1e-13);
  const auto model = model_with(rubber("0"));
  const auto stiffness = [&](double stretch) {
    return HalfSpace(stability::base_state(*model, stretch, {2, 1}).inner).least_stiffness(around);
  };
  // The bulk stiffness that stands for incompressibility is 1e5 times the shear modulus.
  EXPECT_NEAR(find_root(stiffness, 0.5, 0.6, 1e-10), biot, 1e-5);
  EXPECT_GT(HalfSpace(stability::base_state(*model, biot - 0.01, {2, 1}).inner).least_stiffness(along), 0);

  // Waves around the ring tend to it as they shorten, with what the stretch varies over their depth.
  const auto critical = [&](int m) {
    return find_root(
        [&](double stretch) {
          return Strip(stability::base_state(*model, stretch, {10, 0.05}), m).is_stable(0) ? 1.0 : -1.0;
        },
        0.45, 0.6, 1e-7);
  };
  const double at_100 = biot - critical(100), at_200 = biot - critical(200), at_400 = biot - critical(400);
  EXPECT_NEAR(at_100 / at_200, 2, 0.3);
  EXPECT_NEAR(at_200 / at_400, 2, 0.15);
  EXPECT_LT(std::abs(at_400), 2e-3);
}

// A half-space of shear modulus mu takes 2 mu kappa d, normal or tangential. A dead pressure p that does not
// turn with it gives -p kappa d across, so that the surface yields at p = 2 mu. A tether so stiff that
// nothing moves shows it; the other two readings turn or stretch with the surface and do not.
TEST(StabilityClosedForm, DeadPressureOfTwiceTheShearModulusRipplesTheSurface) {
  const double mu = 76350;
  const auto stiffness = [&](const char* reading, double pressure) {
    const auto model = model_with(rubber("1e12", reading));
    const double stretch = stability::lumen_stretch_at(*model, pressure);
    const BaseState base = stability::base_state(*model, stretch, {2, 1});
    return *HalfSpace(base.outer).stiffness(along);
  };
  const auto least_of_pair = [&](const char* reading, double pressure) {
    const Eigen::Matrix3d s = stiffness(reading, pressure);
    const Eigen::Matrix2d pair = s({0, 2}, {0, 2});
    return pair.eigenvalues().real().minCoeff();
  };
  // Bulk stiffness 1e5 mu; strains of 1e-5.
  for (const double pressure : {0.5 * mu, mu, 3 * mu})
    EXPECT_NEAR(least_of_pair("reference", pressure), 2 * mu - pressure, 1e-3 * mu);
  const double critical =
      find_root([&](double p) { return least_of_pair("reference", p); }, mu, 3 * mu, 1e-6 * mu);
  EXPECT_NEAR(critical / mu, 2, 1e-4);
  EXPECT_NEAR(least_of_pair("normal", 3 * mu), 2 * mu, 1e-3 * mu);
  EXPECT_GT(least_of_pair("current", 3 * mu), 1.9 * mu);
}

// The inflation of the ring loses stability where its pressure is greatest, dp/ds = 0 of the ring, here a
// tube of compressible rubber.
TEST(StabilityClosedForm, InflationLosesStabilityAtTheMaximumOfPressure) {
  for (const char* reading : test_support::tether_readings) {
    SCOPED_TRACE(reading);
    const auto model = model_with({"wall.law=neo-Hookean", "wall.shear_modulus=1e5", "wall.bulk_modulus=1e5",
                                   "tether.stiffness=1e3", std::string("tether.traction=") + reading});
    const auto slope = [&](double stretch) { return model->respond(stretch, {}, false).pressure_slope; };
    // Long waves can also shift the wall along its axis, which the tether resists.
    const auto stable = [&](double stretch) {
      return Strip(stability::base_state(*model, stretch, {8, 1})).is_stable(0) ? 1.0 : -1.0;
    };
    EXPECT_NEAR(find_root(stable, 1.5, 3.5, 1e-9), find_root(slope, 1.5, 3.5, 1e-11), 1e-7);
  }
}

}  // namespace
}  // namespace tunica
