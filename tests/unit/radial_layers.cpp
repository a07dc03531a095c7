// SPDX-License-Identifier: GPL-3.0-or-later
// Layered walls, and the mesh that follows recruitment fronts.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/radial/fronts.hpp"
#include "tests/support/ring_cases.hpp"

namespace tunica {
namespace {

using radial::CompressibleRing;
using radial::Front;
using radial::IncompressibleRing;
using radial::Interval;
using radial::Ring;
using test_support::ring_with;

Ring<double> in_layers(Ring<double> ring, const std::vector<double>& shares) {
  const auto law = ring.layers.front().law;
  ring.layers.clear();
  for (const double share : shares) ring.layers.push_back({share, law});
  return ring;
}

/// Three layers that differ in law, stiffness and fibres.
Ring<double> three_layers() {
  Ring<double> ring = ring_with({});
  const auto intima = ring_with({"wall.law=EXP1", "wall.stiffness=3e4"}).layers.front().law;
  const auto adventitia = ring_with({"wall.fiber_angle=30", "wall.fiber_stiffness=2e5"}).layers.front().law;
  const auto media = ring.layers.front().law;
  ring.layers = {{0.1, intima}, {0.6, media}, {0.3, adventitia}};
  return ring;
}

TEST(RadialLayers, OfEqualTissueAreOneLayer) {
  const Ring<double> one = ring_with({});
  for (const auto& shares : {std::vector{1.0, 1.0}, std::vector{0.25, 0.35, 0.4}}) {
    const Ring<double> many = in_layers(one, shares);
    for (const double stretch : {1.2, 1.6, 1.8}) {
      const std::array places{0.1, 0.6, 1.0};
      const auto a = CompressibleRing(one, {}).respond(stretch, places, false);
      const auto b = CompressibleRing(many, {}).respond(stretch, places, false);
      // The discretisations differ, and both are converged far below this.
      EXPECT_NEAR(a.pressure / b.pressure, 1, 1e-9);
      for (std::size_t k = 0; k < places.size(); ++k)
        EXPECT_NEAR(a.states[k].displacement / b.states[k].displacement, 1, 1e-10);
      EXPECT_NEAR(IncompressibleRing(one, {}).respond(stretch, {}, false).pressure /
                      IncompressibleRing(many, {}).respond(stretch, {}, false).pressure,
                  1, 1e-11);
    }
  }
}

TEST(RadialLayers, RadialStressIsContinuousAndTheSlopeIsNot) {
  const CompressibleRing model(three_layers(), {});
  for (const double stretch : {1.3, 1.55, 1.75}) {
    const double d = 1e-9;
    const auto response = model.respond(stretch, std::array{0.1 - d, 0.1 + d, 0.7 - d, 0.7 + d}, false);
    for (const int k : {0, 2}) {
      const auto &below = response.states[k], &above = response.states[k + 1];
      // Displacement differs by slope times distance, stress by its gradient times distance, and by
      // the digits that kappa takes from slopes.
      EXPECT_NEAR(below.displacement, above.displacement, 1e-10);
      EXPECT_NEAR(below.radial_stress / above.radial_stress, 1, 1e-6) << "interface " << k / 2;
    }
    EXPECT_GT(std::abs(response.states[0].radial_slope - response.states[1].radial_slope), 1e-5);
  }
}

TEST(RadialLayers, IncompressibleOnesTendToCompressibleOnes) {
  Ring<double> ring = three_layers();
  const double exact = IncompressibleRing(ring, {}).respond(1.6, {}, false).pressure;
  const auto gap = [&](double kappa) {
    for (auto& layer : ring.layers)
      std::visit(
          [&](auto& law) {
            if constexpr (wall::HasFamilies<std::decay_t<decltype(law)>>) law.volumetric.bulk_modulus = kappa;
          },
          layer.law);
    return CompressibleRing(ring, {}).respond(1.6, {}, false).pressure - exact;
  };
  EXPECT_NEAR(gap(1e8) / gap(1e9), 10, 0.3);
}

TEST(RadialLayers, OrderMatters) {
  Ring<double> ring = three_layers();
  const double outwards = CompressibleRing(ring, {}).respond(1.5, {}, false).pressure;
  std::swap(ring.layers.front(), ring.layers.back());
  const double inwards = CompressibleRing(ring, {}).respond(1.5, {}, false).pressure;
  EXPECT_GT(std::abs(outwards / inwards - 1), 1e-4);
}

TEST(RadialFronts, BoundariesFollowTheSharesOverTheirSum) {
  const auto boundaries = radial::layer_boundaries(in_layers(ring_with({}), {1, 2, 1}));
  EXPECT_EQ(boundaries, (std::vector<double>{0, 0.25, 0.75, 1}));
  EXPECT_EQ(radial::layer_at(boundaries, 0.0), 0U);
  EXPECT_EQ(radial::layer_at(boundaries, 0.25), 0U);
  EXPECT_EQ(radial::layer_at(boundaries, 0.26), 1U);
  EXPECT_EQ(radial::layer_at(boundaries, 1.0), 2U);
}

/// Motion of an incompressible ring, for which the front is known: (r/R)^2 = lambda_A^2 there, so
/// R^2 = (s^2 - 1) R0^2 / (lambda_A^2 - 1).
radial::Field incompressible_motion(const Ring<double>& ring, double stretch) {
  const double shift = (stretch * stretch - 1) * ring.inner_radius * ring.inner_radius;
  return [&ring, shift](double xi) {
    const double radius = ring.radius(xi), current = std::sqrt(radius * radius + shift);
    return std::pair{current - radius, radius / current - 1};
  };
}

TEST(RadialFronts, LieWhereTheFibreStretchReachesItsThreshold) {
  const Ring<double> ring = ring_with({});
  const double front = std::sqrt((1.6 * 1.6 - 1) / (1.5009 * 1.5009 - 1)) * 0.033;
  const auto found = radial::find_fronts(ring, {0, 1}, incompressible_motion(ring, 1.6));
  ASSERT_EQ(found.size(), 1U) << "mirror images share their front";
  EXPECT_NEAR(found[0].xi, (front - 0.033) / 0.01, 1e-11);

  EXPECT_TRUE(radial::find_fronts(ring, {0, 1}, incompressible_motion(ring, 1.4)).empty());
  EXPECT_TRUE(radial::find_fronts(ring, {0, 1}, incompressible_motion(ring, 2.2)).empty());
  const Ring<double> isotropic = ring_with({"wall.law=EXP1"});
  EXPECT_TRUE(radial::find_fronts(isotropic, {0, 1}, incompressible_motion(isotropic, 1.6)).empty());
  const Ring<double> zero_strain = ring_with({"wall.law=EXP1+EXP2-ZS"});
  EXPECT_TRUE(radial::find_fronts(zero_strain, {0, 1}, incompressible_motion(zero_strain, 1.0)).empty())
      << "round-off at rest is no front";
}

TEST(RadialFronts, WideRecruitmentIsResolvedByMoreElements) {
  const Ring<double> wide = ring_with({"wall.sharpness=100"});
  const auto fronts = radial::find_fronts(wide, {0, 1}, incompressible_motion(wide, 1.6));
  EXPECT_GT(fronts.size(), 1U);
  for (std::size_t k = 1; k < fronts.size(); ++k) EXPECT_LE(fronts[k - 1].xi, fronts[k].xi);
}

TEST(RadialFronts, MeshEndsAtLayersAndFronts) {
  const auto mesh = radial::radial_mesh({0, 0.4, 1}, {{0.3, 1e-7}, {0.4, 1e-7}, {0.8, 1e-7}});
  ASSERT_EQ(mesh.size(), 4U);
  const std::vector<double> ends{0.3, 0.4, 0.8, 1};
  const std::vector<std::size_t> layers{0, 0, 1, 1};
  double lower = 0;
  for (std::size_t k = 0; k < mesh.size(); ++k) {
    EXPECT_EQ(mesh[k].lower, lower);
    EXPECT_EQ(mesh[k].upper, ends[k]);
    EXPECT_EQ(mesh[k].layer, layers[k]);
    lower = mesh[k].upper;
  }
  EXPECT_TRUE(radial::has_end_near(mesh, {0.3 + 1e-8, 1e-7}));
  EXPECT_FALSE(radial::has_end_near(mesh, {0.31, 1e-7}));
}

TEST(RadialFronts, NoElementIsTooNarrowForItsSlopes) {
  for (const double front : {1e-9, 0.4 - 1e-9, 0.4 + 1e-9, 1 - 1e-9, 0.5, 0.5 + 1e-8}) {
    const auto mesh = radial::radial_mesh({0, 0.4, 1}, {{front, 1e-7}, {front + 1e-8, 1e-7}});
    double covered = 0;
    for (const Interval& cell : mesh) {
      EXPECT_GT(cell.upper - cell.lower, 1e-7) << front;
      EXPECT_EQ(cell.lower, covered) << front;
      covered = cell.upper;
    }
    EXPECT_EQ(covered, 1.0);
  }
}

TEST(RadialFronts, SharpJumpInCompressibleTissueIsRefused) {
  EXPECT_THROW(test_support::model_with({"wall.exponent=1", "wall.recruitment=sharp"}), InvalidInput);
  // Exactly incompressible tissue has its equilibrium, by an integral.
  const auto model =
      test_support::model_with({"wall.exponent=1", "wall.recruitment=sharp", "wall.incompressible=true"});
  EXPECT_GT(model->respond(1.6, {}, false).pressure, 0);
}

}  // namespace
}  // namespace tunica
