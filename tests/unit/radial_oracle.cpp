// SPDX-License-Identifier: GPL-3.0-or-later
// The thick ring against another method: an initial-value problem in the radius, with the laws
// written out by hand (tests/support/shooting_ring.cpp).
#include <gtest/gtest.h>

#include "tests/support/ring_cases.hpp"
#include "tests/support/shooting_ring.hpp"

namespace tunica {
namespace {

using test_support::FiberTissue;
using test_support::model_with;
using test_support::ShotRing;

constexpr double inner_radius = 0.033, thickness = 0.01, tether = 1e7;

/// Pressure and outer displacement at the lumen stretch that the shot arrives at. The displacements
/// of the two methods are compared relative to the lumen's.
void expect_same(const ShotRing& shot, const radial::RingModel& model, double outer_displacement,
                 double tolerance) {
  const auto response = model.respond(shot.lumen_stretch, std::array{0.0, 1.0}, false);
  EXPECT_NEAR(response.pressure / shot.pressure, 1, tolerance) << "at lumen stretch " << shot.lumen_stretch;
  EXPECT_NEAR(response.states[1].displacement / outer_displacement, 1, tolerance);
  EXPECT_NEAR(response.states[0].displacement / shot.inner_displacement, 1, 1e-12);
}

// Displacements are those of shooting to a relative 1e-8, with the recruitment front inside the wall.
class AgainstShooting : public testing::TestWithParam<const char*> {};

TEST_P(AgainstShooting, FrontInsideTheWall) {
  const auto model = model_with({"wall.law=EXP1+EXP2-FS", std::string("tether.traction=") + GetParam()});
  int with_front_inside = 0;
  for (const double u : {0.004, 0.0105, 0.0112, 0.012, 0.0135, 0.015, 0.018, 0.025}) {
    const ShotRing shot = test_support::shoot(FiberTissue{}, inner_radius, thickness, tether, GetParam(), u);
    if (shot.excess_inner > 0 && shot.excess_outer < 0) ++with_front_inside;
    expect_same(shot, *model, u, 1e-8);
  }
  EXPECT_GE(with_front_inside, 3) << "the cases no longer put the front inside the wall";
}
INSTANTIATE_TEST_SUITE_P(Tether, AgainstShooting, testing::ValuesIn(test_support::tether_readings),
                         [](const auto& instance) { return std::string(instance.param); });

TEST(RadialOracle, RecruitmentAtZeroStrain) {
  const auto model = model_with({"wall.law=EXP1+EXP2-ZS"});
  const FiberTissue zs{.alpha = 1.7471e4,
                       .gamma = 0.8620,
                       .fiber_alpha = 1.4979e5,
                       .fiber_gamma = 0.5736,
                       .angle = 56.52,
                       .activation_stretch = 1};
  for (const double u : {1e-4, 0.004, 0.012, 0.02})
    expect_same(test_support::shoot(zs, inner_radius, thickness, tether, "normal", u), *model, u, 1e-8);
}

TEST(RadialOracle, EverySharpnessAndTheStep) {
  for (const double u : {0.011, 0.0125, 0.0145}) {
    for (const double sharpness : {10.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7}) {
      SCOPED_TRACE(testing::Message() << "sharpness " << sharpness << ", outer displacement " << u);
      const auto model = model_with({"wall.sharpness=" + std::to_string(sharpness)});
      const FiberTissue tissue{.sharpness = sharpness};
      expect_same(test_support::shoot(tissue, inner_radius, thickness, tether, "normal", u), *model, u, 1e-8);
    }
    SCOPED_TRACE("sharp");
    const auto model = model_with({"wall.recruitment=sharp"});
    expect_same(test_support::shoot(FiberTissue{.sharp = true}, inner_radius, thickness, tether, "normal", u),
                *model, u, 1e-8);
  }
}

// Walls whose equilibria were once missed from some stretch on, at stretches before, about and beyond it:
// thick ones, whose fields need more than one element, and fronts that move along the wall by their own
// slopes' errors, since the fibre stretch hardly changes through it.
TEST(RadialOracle, WallsWhoseFrontsAreHardToFind) {
  struct Wall {
    std::vector<std::string> overrides;
    FiberTissue tissue;
    double thickness;
    std::vector<double> outer_displacements;
  };
  const std::vector<Wall> walls{
      {{"geometry.thickness=0.1"}, {}, 0.1, {0.0045, 0.0051, 0.00515, 0.0053, 0.008, 0.02}},
      {{"geometry.thickness=0.2"}, {}, 0.2, {0.0025, 0.0028, 0.004, 0.01}},
      {{"wall.fiber_stiffening=10"}, {.fiber_gamma = 10}, thickness, {0.0145, 0.0149, 0.0151, 0.016}},
      {{"wall.fiber_angle=87"}, {.angle = 87}, thickness, {0.003, 0.00395, 0.0042, 0.01, 0.016}},
      {{"wall.fiber_angle=88"}, {.angle = 88}, thickness, {0.0021, 0.0022, 0.004, 0.016}},
      {{"wall.fiber_angle=88.5"}, {.angle = 88.5}, thickness, {0.0013, 0.00132, 0.004, 0.016}},
      {{"wall.fiber_angle=89.5"}, {.angle = 89.5}, thickness, {0.0003, 0.004, 0.016}}};
  for (const Wall& wall : walls) {
    SCOPED_TRACE(wall.overrides[0]);
    const auto model = model_with(wall.overrides);
    for (const double u : wall.outer_displacements)
      expect_same(test_support::shoot(wall.tissue, inner_radius, wall.thickness, tether, "normal", u), *model,
                  u, 1e-7);
  }
}

// The bulk modulus may be any: p/kappa is then all that is left of the compression.
TEST(RadialOracle, AnyBulkModulus) {
  for (const char* kappa : {"1e6", "1e8", "1e10"}) {
    const auto model = model_with({std::string("wall.bulk_modulus=") + kappa});
    for (const double u : {0.002, 0.012, 0.018}) {
      const FiberTissue tissue{.kappa = std::stod(kappa)};
      // Shooting takes J - 1 from its stretches: 1e-16 kappa is its round-off.
      expect_same(test_support::shoot(tissue, inner_radius, thickness, tether, "normal", u), *model, u,
                  1e-8 + 1e-16 * std::stod(kappa));
    }
  }
  // The difference to the incompressible ring falls with 1/kappa without a floor.
  const double exact = model_with({"wall.incompressible=true"})->respond(1.6, {}, false).pressure;
  double before = model_with({"wall.bulk_modulus=1e9"})->respond(1.6, {}, false).pressure / exact - 1;
  for (const char* kappa : {"1e10", "1e11", "1e12", "1e13"}) {
    const double gap =
        model_with({std::string("wall.bulk_modulus=") + kappa})->respond(1.6, {}, false).pressure / exact - 1;
    EXPECT_NEAR(gap / before, 0.1, 0.01) << kappa;
    before = gap;
  }
}

// The energy with exponent 1 has stress that all but jumps: the tissue lingers at the threshold, where
// either method loses digits; 1e-6 is what the two hold together.
TEST(RadialOracle, ExponentOneWhoseStressJumps) {
  for (const double sharpness : {1e2, 1e4}) {
    SCOPED_TRACE(sharpness);
    const auto model = model_with({"wall.exponent=1", "wall.sharpness=" + std::to_string(sharpness)});
    const FiberTissue tissue{.exponent = 1, .sharpness = sharpness};
    for (const double u : {0.0105, 0.013})
      expect_same(test_support::shoot(tissue, inner_radius, thickness, tether, "normal", u), *model, u, 1e-6);
  }
}

TEST(RadialOracle, SoftAndCompressibleTissue) {
  // A ratio of bulk to shear stiffness of 3: the incompressible estimate that the solver starts from is far
  // off.
  const auto model = model_with({"wall.bulk_modulus=1e5", "tether.stiffness=1e6"});
  for (const double u : {0.004, 0.01, 0.02})
    expect_same(test_support::shoot(FiberTissue{.kappa = 1e5}, inner_radius, thickness, 1e6, "normal", u),
                *model, u, 1e-8);
}

}  // namespace
}  // namespace tunica
