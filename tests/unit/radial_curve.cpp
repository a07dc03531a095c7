// SPDX-License-Identifier: GPL-3.0-or-later
// The table of the wall's equilibria against equilibria solved for directly.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.hpp"
#include "core/radial/fronts.hpp"
#include "core/radial/wall_curve.hpp"
#include "tests/support/ring_cases.hpp"

namespace tunica {
namespace {

using radial::WallCurve;
using test_support::model_with;

const std::vector<double> places{0.0, 1.0 / 3, 2.0 / 3, 1.0};

void expect_table_of(const std::vector<std::string>& overrides) {
  const WallCurve curve(model_with(overrides), places);
  const auto model = model_with(overrides);
  constexpr unsigned seed = 20240611;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> stretches(0.85, 2.2);
  for (int k = 0; k < 60; ++k) {
    const double stretch = stretches(random);
    SCOPED_TRACE(testing::Message() << "stretch " << stretch << ", seed " << seed);
    const auto direct = model->respond(stretch, places, false);
    // Pieces are split until their last coefficients are below 1e-10 of the scale; slopes may have
    // 1e3 times less, as they scale the error of pressure by the piece's width.
    const double scale = std::abs(direct.pressure) + 0.05 * std::abs(direct.pressure_slope);
    EXPECT_NEAR(curve.pressure(stretch), direct.pressure, 1e-9 * scale);
    EXPECT_NEAR(curve.pressure_slope(stretch), direct.pressure_slope, 1e-6 * std::abs(direct.pressure_slope));
    for (std::size_t p = 0; p < places.size(); ++p) {
      EXPECT_NEAR(curve.displacement(stretch, static_cast<int>(p)), direct.states[p].displacement,
                  1e-9 * 0.033);
      EXPECT_NEAR(curve.radial_slope(stretch, static_cast<int>(p)), direct.states[p].radial_slope, 2e-8);
    }
  }
}

class CurveOf : public testing::TestWithParam<const char*> {};
TEST_P(CurveOf, EveryStretchIsItsDirectSolution) {
  expect_table_of({std::string("wall.law=") + GetParam()});
}
INSTANTIATE_TEST_SUITE_P(Law, CurveOf, testing::ValuesIn(test_support::paper_laws), [](const auto& instance) {
  std::string name = instance.param;
  std::erase_if(name, [](char c) { return c == '+' || c == '-'; });
  return name;
});

TEST(WallCurve, OfOtherWallsIsTheirDirectSolution) {
  expect_table_of({"wall.incompressible=true"});
  expect_table_of({"wall.recruitment=sharp"});
  expect_table_of({"wall.sharpness=100"});
  expect_table_of({"tether.traction=reference", "wall.law=EXP1+EXP2-FS", "wall.activation_squared=1.52"});
}

TEST(WallCurve, RatesAreDerivativesOfTheTable) {
  const WallCurve curve(model_with({}), places);
  for (const double s : {1.17, 1.43, 1.83}) {
    const double h = 1e-5;
    for (const int p : {0, 2, 3}) {
      const double rate = (curve.displacement(s + h, p) - curve.displacement(s - h, p)) / (2 * h);
      EXPECT_NEAR(curve.displacement_rate(s, p) / rate, 1, 1e-7);
      const double slope = (curve.radial_slope(s + h, p) - curve.radial_slope(s - h, p)) / (2 * h);
      EXPECT_NEAR(curve.radial_slope_rate(s, p) / slope, 1, 1e-6);
    }
  }
  // The lumen's own displacement is (s - 1) R0.
  EXPECT_NEAR(curve.displacement_rate(1.3, 0), 0.033, 1e-9);
}

TEST(WallCurve, CarriesParameterDerivatives) {
  const std::vector<std::string> keys{"tether.stiffness", "wall.activation_stretch"};
  const WallCurve curve(model_with({}, keys), places);
  const auto model = model_with({}, keys);
  for (const double stretch : {1.25, 1.61, 1.9}) {
    const auto direct = model->respond(stretch, places, true);
    for (int k = 0; k < 2; ++k) {
      const double scale = std::abs(direct.pressure_derivatives[k]) + 1e-3 * direct.pressure;
      EXPECT_NEAR(curve.pressure_derivative(stretch, k), direct.pressure_derivatives[k], 1e-6 * scale);
      for (int p = 0; p < 4; ++p) {
        const auto& state = direct.state_derivatives[k][p];
        EXPECT_NEAR(curve.displacement_derivative(stretch, k, p), state.displacement,
                    1e-6 * std::abs(direct.state_derivatives[k][3].displacement) + 1e-20);
        // Fibres that none recruits carry the same whatever their threshold: what is left is rounding.
        const double rounding = 1e-16 * std::abs(direct.states[3].radial_slope);
        EXPECT_NEAR(curve.radial_slope_derivative(stretch, k, p), state.radial_slope,
                    1e-4 * std::abs(direct.state_derivatives[k][3].radial_slope) + rounding);
      }
    }
  }
}

// At the threshold of a place the fibre stretch there, solved for anew, equals a^2.
TEST(WallCurve, ThresholdsAreWhereTheFibreStretchReachesASquared) {
  for (const std::vector<std::string>& overrides :
       {std::vector<std::string>{}, {"tether.traction=reference"}, {"wall.incompressible=true"}}) {
    const WallCurve curve(model_with(overrides), places);
    ASSERT_EQ(curve.thresholds().size(), 4U);
    double before = 1;
    for (const auto& threshold : curve.thresholds()) {
      const double xi = places[threshold.place];
      const auto state = curve.model().respond(threshold.stretch, std::array{xi}, false).states[0];
      const double hoop = 1 + state.displacement / (0.033 + 0.01 * xi), radial = 1 + state.radial_slope;
      const double beta = 42.82 * std::acos(-1) / 180, c2 = std::pow(std::cos(beta), 2);
      const double fourth = std::pow(radial * hoop, -2.0 / 3) * (hoop * hoop * c2 + 1 - c2);
      EXPECT_NEAR(fourth, 1.5009 * 1.5009 * c2 + 1 - c2, 1e-9) << "P" << threshold.place + 1;
      // Recruited from the inner to the outer surface.
      EXPECT_GT(threshold.stretch, before);
      before = threshold.stretch;
    }
  }
}

TEST(WallCurve, ThresholdDerivativesAgreeWithDifferences) {
  const std::vector<std::string> keys{"wall.activation_stretch", "tether.stiffness", "geometry.thickness",
                                      "wall.bulk_modulus"};
  const WallCurve curve(model_with({}, keys), places);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const double value = test_support::scene_with({}).number(keys[k]), h = 1e-3 * value;
    const auto stretches = [&](double x) {
      std::vector<double> all;
      const WallCurve changed(model_with({keys[k] + "=" + fmt::format("{:.17g}", x)}), places);
      for (const auto& threshold : changed.thresholds()) all.push_back(threshold.stretch);
      return all;
    };
    const auto above = stretches(value + h), below = stretches(value - h);
    for (std::size_t i = 0; i < above.size(); ++i) {
      const double by_difference = (above[i] - below[i]) / (2 * h);
      // Second-order differences with a step of 1e-3: 1e-6 of the derivative, which for a stretch of
      // order 1 has the size 1/|value|.
      EXPECT_NEAR(curve.thresholds()[i].derivatives[k] * value, by_difference * value, 1e-5)
          << keys[k] << " at P" << curve.thresholds()[i].place + 1;
    }
  }
}

TEST(WallCurve, StretchAtInvertsPressure) {
  for (const char* law : test_support::paper_laws) {
    const WallCurve curve(model_with({std::string("wall.law=") + law}), places);
    for (const double pressure : {-2e3, 0.0, 1.0, 5e4, 1.3e5, 2e5}) {
      const double stretch = curve.stretch_at(pressure);
      // find_root stops at 1e-14 of stretch.
      EXPECT_NEAR(curve.pressure(stretch), pressure, 1e-6 + 1e-10 * std::abs(pressure)) << law;
      EXPECT_EQ(stretch < 1, pressure < 0) << law;
    }
  }
}

TEST(WallCurve, RefusesWhatIsOutsideItsRange) {
  const WallCurve curve(model_with({}), places);
  for (const double stretch : {0.29, 4.0, 17.0, std::nan("")}) {
    try {
      curve.pressure(stretch);
      ADD_FAILURE() << "a pressure at stretch " << stretch;
    } catch (const SolverFailure& failure) {
      const std::string text = failure.what();
      EXPECT_NE(text.find("lumen stretch"), std::string::npos) << text;
      EXPECT_NE(text.find("0.3 to 4"), std::string::npos) << text;
    }
  }
}

// Without a tether a neo-Hookean tube carries at most
//   max over s of mu [ln s - 1/(2 s^2) - ln l + 1/(2 l^2)], l^2 = 1 + (s^2 - 1) (R_i/R_o)^2,
// which the failure has to name: the curve looks every 0.02 of stretch.
TEST(WallCurve, NamesTheLargestPressureOfAWallThatGivesWay) {
  const WallCurve curve(
      model_with({"wall.law=neo-Hookean", "wall.incompressible=true", "tether.stiffness=0"}), places);
  double largest = 0;
  for (double s = 1; s < 4; s += 1e-4) {
    const double l = std::sqrt(1 + (s * s - 1) * 0.033 * 0.033 / (0.043 * 0.043));
    largest = std::max(largest, 76350 * (std::log(s / l) - 1 / (2 * s * s) + 1 / (2 * l * l)));
  }
  EXPECT_NEAR(curve.pressure(curve.stretch_at(0.99 * largest)) / (0.99 * largest), 1, 1e-9);
  try {
    curve.stretch_at(1.05 * largest);
    FAIL() << "an equilibrium above the largest pressure";
  } catch (const SolverFailure& failure) {
    const std::string text = failure.what();
    const auto at = text.find("at most ");
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_NEAR(std::stod(text.substr(at + 8)) / largest, 1, 1e-3) << text;
    EXPECT_NE(text.find("no equilibrium at a pressure of"), std::string::npos) << text;
  }
}

TEST(WallCurve, SolvesOnlyWhereItIsAsked) {
  const WallCurve curve(model_with({}), places);
  curve.prepare(1.0, 1.3);
  const long prepared = curve.solves();
  for (double s = 1.0; s < 1.3; s += 0.01) curve.pressure(s);
  EXPECT_EQ(curve.solves(), prepared);
  curve.pressure(1.95);
  EXPECT_GT(curve.solves(), prepared);
}

}  // namespace
}  // namespace tunica
