// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the thick ring with respect to parameters, against rings built anew.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "tests/support/ring_cases.hpp"

namespace tunica {
namespace {

using test_support::joined;
using test_support::model_with;
using test_support::scene_with;

constexpr std::array places{0.0, 0.4, 1.0};

/// Derivative by differences of fourth order of something computed from a changed scene.
template <class Compute>
double difference(const std::vector<std::string>& base, const std::string& key, Compute&& compute) {
  const double value = scene_with(base).number(key);
  // Relative step 1e-3: what is left out is of the order 1e-12, round-off some 1e-9.
  const double h = 1e-3 * std::abs(value);
  const auto at = [&](double x) {
    return compute(*model_with(joined(base, {fmt::format("{}={:.17g}", key, x)})));
  };
  return (8 * (at(value + h) - at(value - h)) - (at(value + 2 * h) - at(value - 2 * h))) / (12 * h);
}

void expect_derivatives(const std::vector<std::string>& base, const std::string& key, double stretch) {
  SCOPED_TRACE(testing::Message() << key << " at stretch " << stretch);
  const auto model = model_with(base, {key});
  const auto response = model->respond(stretch, places, true);
  ASSERT_EQ(response.pressure_derivatives.size(), 1U);
  const double value = std::abs(scene_with(base).number(key));

  const double by_difference = difference(base, key, [&](const radial::RingModel& changed) {
    return changed.respond(stretch, {}, false).pressure;
  });
  // Relative to the derivative or, where it is small, to what one per cent of the pressure would be.
  const double scale = std::max(std::abs(by_difference), 1e-2 * std::abs(response.pressure) / value);
  EXPECT_NEAR(response.pressure_derivatives[0], by_difference, 1e-6 * scale);

  for (std::size_t k = 0; k < places.size(); ++k) {
    const double by_place = difference(base, key, [&](const radial::RingModel& changed) {
      return changed.respond(stretch, std::array{places[k]}, false).states[0].displacement;
    });
    const double least = 1e-2 * std::abs(response.states[k].displacement) / value;
    EXPECT_NEAR(response.state_derivatives[0][k].displacement, by_place,
                1e-6 * std::max(std::abs(by_place), least))
        << "place " << places[k];
    const double by_slope = difference(base, key, [&](const radial::RingModel& changed) {
      return changed.respond(stretch, std::array{places[k]}, false).states[0].radial_slope;
    });
    const double least_slope = 1e-2 * std::abs(response.states[k].radial_slope) / value;
    EXPECT_NEAR(response.state_derivatives[0][k].radial_slope, by_slope,
                1e-5 * std::max(std::abs(by_slope), least_slope))
        << "place " << places[k];
  }
}

class ParameterDerivatives : public testing::TestWithParam<const char*> {};

TEST_P(ParameterDerivatives, AgreeWithDifferences) {
  // 1.62: the recruitment front is inside the wall, and stays there for the changed parameters.
  for (const char* reading : {"normal", "reference"})
    for (const double stretch : {1.3, 1.62, 1.85})
      expect_derivatives({std::string("tether.traction=") + reading}, GetParam(), stretch);
}
INSTANTIATE_TEST_SUITE_P(Ring, ParameterDerivatives,
                         testing::Values("wall.bulk_modulus", "wall.activation_stretch", "wall.stiffness",
                                         "wall.stiffening", "wall.fiber_stiffness", "wall.fiber_stiffening",
                                         "wall.fiber_angle", "geometry.thickness", "geometry.radius",
                                         "tether.stiffness"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           for (char& c : name)
                             if (c == '.') c = '_';
                           return name;
                         });

TEST(ParameterDerivativesOf, TheIncompressibleRing) {
  for (const char* key : {"wall.activation_stretch", "wall.stiffness", "geometry.thickness",
                          "geometry.radius", "tether.stiffness"})
    for (const double stretch : {1.3, 1.62}) expect_derivatives({"wall.incompressible=true"}, key, stretch);
}

TEST(ParameterDerivativesOf, TheBenchmarkLaws) {
  for (const char* key : {"wall.young_modulus", "wall.poisson_ratio"}) {
    expect_derivatives({"wall.law=linear-elastic"}, key, 1.1);
    expect_derivatives({"wall.law=St-Venant-Kirchhoff"}, key, 1.1);
  }
  expect_derivatives({"wall.law=neo-Hookean-compressible"}, "wall.shear_modulus", 1.2);
}

/// Shares of layers have to add up to 1 in a scene, so here the ring itself is changed.
TEST(ParameterDerivativesOf, ALayersFraction) {
  using D = Dual<double, 1>;
  const auto build = []<class P>(const P& share) {
    const auto law = [](const std::vector<std::string>& overrides) {
      const Scene scene = scene_with(overrides);
      return radial::ring_from_scene(SeededScene<P>(scene));
    };
    radial::Ring<P> ring = law({});
    const auto media = ring.layers.front().law;
    ring.layers = {{share, law({"wall.law=EXP1", "wall.stiffness=3e4"}).layers.front().law},
                   {P(1.0), media},
                   {P(0.5), law({"wall.fiber_stiffness=3e5"}).layers.front().law}};
    return ring;
  };
  const double share = 0.25, h = 1e-3 * share;
  // Places in each layer: an element passes by them as the share changes.
  const std::array inside{0.05, 0.5, 0.9};
  const auto expect = [&](const auto& make, double stretch) {
    const auto response = make(share, std::vector{build(D::variable(share))})->respond(stretch, inside, true);
    const auto difference = [&](const auto& of) {
      const auto at = [&](double x) { return of(make(x, {})->respond(stretch, inside, false)); };
      return (8 * (at(share + h) - at(share - h)) - (at(share + 2 * h) - at(share - 2 * h))) / (12 * h);
    };
    const double by_pressure = difference([](const auto& r) { return r.pressure; });
    EXPECT_NEAR(response.pressure_derivatives[0] / by_pressure, 1, 1e-6) << stretch;
    for (std::size_t k = 0; k < inside.size(); ++k) {
      const double u = difference([&](const auto& r) { return r.states[k].displacement; });
      // Incompressible tissue moves alike whatever it is made of; slopes keep fewer digits.
      EXPECT_NEAR(response.state_derivatives[0][k].displacement, u, 1e-5 * std::abs(u) + 1e-12) << stretch;
      const double slope = difference([&](const auto& r) { return r.states[k].radial_slope; });
      EXPECT_NEAR(response.state_derivatives[0][k].radial_slope, slope, 1e-4 * std::abs(slope) + 1e-8)
          << stretch;
    }
  };
  using Seeded = std::vector<radial::RingModel::Seeded>;
  const auto compressible = [&](double x, Seeded seeded) -> std::unique_ptr<radial::RingModel> {
    return std::make_unique<radial::CompressibleRing>(build(x), std::move(seeded));
  };
  const auto incompressible = [&](double x, Seeded seeded) -> std::unique_ptr<radial::RingModel> {
    return std::make_unique<radial::IncompressibleRing>(build(x), std::move(seeded));
  };
  for (const double stretch : {1.3, 1.8}) {
    expect(compressible, stretch);
    expect(incompressible, stretch);
  }
}

}  // namespace
}  // namespace tunica
