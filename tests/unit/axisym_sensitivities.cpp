// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of runs of the 2D tier against central differences of whole runs with the same steps.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/observables/beat.hpp"
#include "core/run/quantity.hpp"
#include "tests/support/axisym_runs.hpp"

namespace tunica {
namespace {

using test_support::run_axisym;
using test_support::values;
using Overrides = std::vector<std::string>;

Overrides joined(Overrides all, const Overrides& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// A coarse artery whose equations are solved to far more digits than its mesh deserves. The inflow is given:
/// by default it would change with the radius.
Overrides coarse(const Overrides& more) {
  return joined({"mesh.wall_cells=2", "mesh.blood_cells=1", "mesh.axial_cells=6", "time.beats=1",
                 "time.step=8e-3", "output.interval=8e-3", "accuracy.tolerance=1e-8", "inlet.flow=0.1217"},
                more);
}

std::string asked(const Overrides& keys) {
  return fmt::format("sensitivity.parameters=['{}']", fmt::join(keys, "', '"));
}

/// The runs at a value of a key less and more by a relative step.
struct Pair {
  Result lower, upper;
  double step;
  Pair(const Overrides& overrides, const std::string& key, double relative) {
    const double value = test_support::artery(overrides).number(key);
    const auto at = [&](double v) {
      return run_axisym(test_support::artery(joined(overrides, {fmt::format("{}={:.17g}", key, v)})));
    };
    lower = at(value * (1 - relative));
    upper = at(value * (1 + relative));
    step = 2 * relative * value;
  }
};

struct Case {
  const char* name;
  Overrides overrides;
  Overrides keys;
};

class AxisymSensitivities : public testing::TestWithParam<Case> {};

// A wall without fibres is smooth in all of its keys. Differences with a relative step of 1e-4 leave out
// 1e-8 of the third derivative, and what the runs' own errors of some 1e-10 leave is a little more than 1e-6
// of the columns that hardly depend on a key: 1e-5 of a column's largest magnitude is allowed.
TEST_P(AxisymSensitivities, AgreeWithCentralDifferences) {
  const Overrides overrides = coarse(joined({"wall.law=EXP1"}, GetParam().overrides));
  const Result result = run_axisym(test_support::artery(joined(overrides, {asked(GetParam().keys)})));
  ASSERT_EQ(result.sensitivities.rows(), result.observables.rows());
  for (const std::string& key : GetParam().keys) {
    const Pair runs(overrides, key, 1e-4);
    int columns = 0;
    for (const char* quantity :
         {"pressure", "outlet_pressure", "transmural_pressure", "outflow", "radial_displacement.P1",
          "radial_displacement.P4", "von_mises.P1", "von_mises.P2", "von_mises.P4"}) {
      const auto& lower = values(runs.lower.observables, quantity);
      const auto& upper = values(runs.upper.observables, quantity);
      const auto& derivative = values(result.sensitivities, fmt::format("d({})/d({})", quantity, key));
      if (observables::is_none(lower.back())) continue;
      double largest = 0, gap = 0;
      for (std::size_t row = 0; row < lower.size(); ++row) {
        const double by_difference = (upper[row] - lower[row]) / runs.step;
        largest = std::max(largest, std::abs(by_difference));
        gap = std::max(gap, std::abs(derivative[row] - by_difference));
      }
      EXPECT_LE(gap, 1e-5 * largest) << quantity << " by " << key;
      if (largest > 0) ++columns;
    }
    EXPECT_GE(columns, 4) << key;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , AxisymSensitivities,
    testing::Values(Case{"implicit",
                         {},
                         {"outlet.resistance", "tether.stiffness", "geometry.thickness", "geometry.radius",
                          "geometry.length", "wall.stiffness", "wall.stiffening", "wall.bulk_modulus",
                          "blood.density", "inlet.flow"}},
                    Case{"sectional",
                         {"mesh.motion=sectional", "mesh.blood_cells=2"},
                         {"outlet.resistance", "geometry.thickness", "geometry.radius", "geometry.length"}},
                    Case{"lagged",
                         {"solver.geometry=lagged", "time.start=static"},
                         {"tether.stiffness", "geometry.radius"}},
                    Case{"lagged_sectional",
                         {"solver.geometry=lagged", "mesh.motion=sectional"},
                         {"outlet.resistance", "geometry.thickness"}},
                    Case{"windkessel",
                         {"outlet.kind=rcr", "outlet.proximal_resistance=1e5", "outlet.compliance=1e-7",
                          "inlet.profile=natural"},
                         {"outlet.resistance", "outlet.compliance", "outlet.proximal_resistance"}},
                    Case{"alpha", {"time.scheme=generalized-alpha", "time.step=8e-3"}, {"outlet.resistance"}},
                    Case{"linear", {"mesh.element=linear"}, {"outlet.resistance", "blood.viscosity"}},
                    Case{"static_start", {"time.start=static"}, {"outlet.resistance", "geometry.thickness"}},
                    Case{"static",
                         {"time.mode=static", "inlet.waveform=pressure", "inlet.pressure=1e5"},
                         {"tether.stiffness", "geometry.thickness", "inlet.pressure"}},
                    Case{"layers",
                         {"wall.layers=[{fraction=0.4}, {fraction=0.6, bulk_modulus=5e6}]"},
                         {"wall.layers[1].bulk_modulus"}}),
    [](const auto& instance) { return std::string(instance.param.name); });

// A fraction counts relative to the sum: one of two, f and 1 - f, that is varied by itself moves their
// boundary as much as both do when f + (1 - f) df takes the place of f.
TEST(AxisymSensitivityOfFractions, IsRelativeToTheirSum) {
  const auto layers = [](double first) {
    return fmt::format(
        "wall.layers=[{{fraction={:.17g}, law=\"EXP1\"}}, {{fraction={:.17g}, law=\"EXP1\", "
        "stiffness=9e4}}]",
        first, 1 - first);
  };
  const auto run = [&](double first, const Overrides& more) {
    return run_axisym(test_support::artery(coarse(joined({layers(first)}, more))));
  };
  constexpr double fraction = 0.4, h = 1e-4;
  const std::string key = "wall.layers[0].fraction";
  const Result result = run(fraction, {asked({key})});
  const Result lower = run(fraction - h, {}), upper = run(fraction + h, {});
  for (const char* quantity : {"pressure", "radial_displacement.P1"}) {
    const auto& derivative = values(result.sensitivities, fmt::format("d({})/d({})", quantity, key));
    double largest = 0, gap = 0;
    for (std::size_t row = 0; row < derivative.size(); ++row) {
      const double by_difference =
          (1 - fraction) / (2 * h) *
          (values(upper.observables, quantity)[row] - values(lower.observables, quantity)[row]);
      largest = std::max(largest, std::abs(by_difference));
      gap = std::max(gap, std::abs(derivative[row] - by_difference));
    }
    EXPECT_GT(largest, 0);
    EXPECT_LT(gap, 1e-5 * largest) << quantity;
  }
}

// The paper's wall: with steps of 1e-6 no fibres of a quadrature point are recruited between the runs, and
// the runs' errors of some 1e-11 leave 1e-5 of what a quantity has by the keys that it depends on.
const Overrides of_paper = coarse({"accuracy.tolerance=1e-9"});
const Overrides paper_keys{"outlet.resistance", "tether.stiffness", "wall.activation_stretch",
                           "geometry.thickness", "wall.stiffness"};

TEST(AxisymSensitivityOfThePapersWall, OfQuantities) {
  run::Question question;
  for (const char* name : {"pressure.max", "radial_displacement.P1.max", "radial_displacement.P1.change",
                           "fiber_angle.P1.change", "von_mises.P1.max"})
    question.quantities.push_back(run::parse_quantity(name));
  const Scene scene = test_support::artery(of_paper);
  const auto answer = [&](const Result& result, const Overrides& keys) {
    return run::answer_of(result, observables::last_beat(scene, result.observables),
                          {question.quantities, keys});
  };
  const auto gradients =
      answer(run_axisym(test_support::artery(joined(of_paper, {asked(paper_keys)}))), paper_keys).gradients;
  for (std::size_t k = 0; k < paper_keys.size(); ++k) {
    const Pair runs(of_paper, paper_keys[k], 1e-6);
    const auto lower = answer(runs.lower, {}).values, upper = answer(runs.upper, {}).values;
    for (std::size_t i = 0; i < lower.size(); ++i) {
      const double by_difference = (upper[i] - lower[i]) / runs.step;
      EXPECT_NEAR(gradients[i][k], by_difference, 1e-4 * std::abs(by_difference))
          << question.quantities[i].name() << " by " << paper_keys[k];
    }
  }
}

TEST(AxisymSensitivityOfThePapersWall, OfRecruitmentTimes) {
  const Overrides keys{"outlet.resistance", "wall.activation_stretch"};
  const Result result = run_axisym(test_support::artery(joined(of_paper, {asked(keys)})));
  ASSERT_GE(result.events.rows(), 2U);
  for (const std::string& key : keys) {
    const Pair runs(of_paper, key, 1e-6);
    const auto &lower = values(runs.lower.events, "time"), &upper = values(runs.upper.events, "time");
    const auto& moved = values(result.event_sensitivities, fmt::format("d(time)/d({})", key));
    ASSERT_EQ(lower.size(), moved.size());
    ASSERT_EQ(upper.size(), moved.size());
    for (std::size_t e = 0; e < moved.size(); ++e) {
      // Times are found to 1e-9 s and move by 1e-6 s and more.
      const double by_difference = (upper[e] - lower[e]) / runs.step;
      EXPECT_NEAR(moved[e], by_difference, 1e-3 * std::abs(by_difference) + 2e-9 / runs.step)
          << "event " << e << " by " << key;
    }
  }
}

}  // namespace
}  // namespace tunica
