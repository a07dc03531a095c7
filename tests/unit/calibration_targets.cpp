// SPDX-License-Identifier: GPL-3.0-or-later
// What --free and --target say, and calibrations of a tier whose answer is known.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "tests/support/fake_tier.hpp"
#include "verification/calibration/result.hpp"

using namespace tunica;
using namespace tunica::verification::calibration;

namespace {

/// pressure = 2 R everywhere, outflow = sqrt(R) + outlet.pressure.
Result answer(const Scene& scene, const RunControl&) {
  Result result;
  result.observables = observables::standard_table();
  result.record.converged = true;
  const double resistance = scene.number("outlet.resistance");
  for (const double time : {0.0, 0.4, 0.8}) {
    observables::Sample row;
    row.time = time;
    row.pressure = 2 * resistance;
    row.outflow = std::sqrt(resistance) + scene.number("outlet.pressure");
    observables::append(result.observables, row);
  }
  return result;
}

class Calibrating : public testing::Test {
 protected:
  Calibrating() {
    tiers_.push_back(std::make_unique<test_support::FakeTier>("fake", answer, [](const Scene& scene) {
      return scene.texts("sensitivity.parameters").empty() ? "" : "no derivatives";
    }));
  }
  Target target(const std::string& text) const { return parse_target(text, source_.scene(), free_); }
  Calibration run(std::vector<std::string> keys, std::vector<std::string> targets) {
    task_ = {"fake", {}, {}, 3, 1, 1};
    for (const std::string& key : keys) task_.free.push_back(parse_free(key, source_));
    for (const std::string& text : targets)
      task_.targets.push_back(parse_target(text, source_.scene(), task_.free));
    return calibrate(run::Door(tiers_, source_), task_);
  }
  std::string refusal(const std::string& text) const {
    try {
      target(text);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  }

  run::SceneSource source_{std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml", {"time.beats=1"}};
  std::vector<FreeKey> free_{{"outlet.resistance", "dyn s/cm5", 5e5, 2e6}};
  TierList tiers_;
  Task task_;
};

}  // namespace

TEST_F(Calibrating, ReadsTargetsWithUnitsAndDeviations) {
  EXPECT_NEAR(target("pressure.max=130 mmHg").value, 130 * mmhg, 1e-6);
  EXPECT_NEAR(target("pressure.max=130 mmHg").standard_deviation, 1.3 * mmhg, 1e-6);
  for (const char* text : {"pressure.max=130 mmHg+-2", "pressure.max = 130 +- 2 mmHg",
                           "pressure.max=130 mmHg±2 mmHg", "pressure.max=130 mmHg+/-1.5384615384615385 %"}) {
    EXPECT_NEAR(target(text).value, 130 * mmhg, 1e-6) << text;
    EXPECT_NEAR(target(text).standard_deviation, 2 * mmhg, 1e-6) << text;
    EXPECT_TRUE(target(text).deviation_given);
  }
  EXPECT_NEAR(target("radial_displacement.P1.change=25 % of geometry.radius").value, 0.25 * 0.033, 1e-15);
  EXPECT_NEAR(target("radial_displacement.P1.change=25% of geometry.radius +- 2%").standard_deviation,
              0.02 * 0.25 * 0.033, 1e-15);
  EXPECT_EQ(target("pressure.drift=0+-10").standard_deviation, 10);
}

TEST_F(Calibrating, RefusesTargetsThatMakeNoSense) {
  EXPECT_NE(refusal("pressure.max").find("write QUANTITY=VALUE"), std::string::npos);
  EXPECT_NE(refusal("presure.max=3").find("did you mean pressure.max"), std::string::npos);
  EXPECT_NE(refusal("pressure.max=3 cm").find("another dimension"), std::string::npos);
  EXPECT_NE(refusal("pressure.drift=0").find("needs a standard deviation"), std::string::npos);
  EXPECT_NE(refusal("pressure.max=3+-0").find("above 0"), std::string::npos);
  EXPECT_NE(refusal("pressure.max=3+-").find("no standard deviation behind"), std::string::npos);
  EXPECT_NE(refusal("pressure.max=5 % of geometry.radius").find("another dimension"), std::string::npos);
  EXPECT_NE(refusal("pressure.max=5 % of outlet.resistance").find("is free itself"), std::string::npos);
  EXPECT_NE(refusal("pressure.max=5 % of geometry.radios").find("geometry.radius"), std::string::npos);
  EXPECT_THROW(parse_free("outlet.resistance=2e6:5e5", source_), InvalidInput);
  EXPECT_THROW(parse_free("outlet.resistance=5e5:2e6:5", source_), InvalidInput);
  EXPECT_THROW(parse_free("outlet.resistance=-1:2e6", source_), InvalidInput);
  EXPECT_THROW(parse_free("time.beats=1:5", source_), InvalidInput);
  EXPECT_THROW(run({"outlet.resistance=5e5:2e6", "outlet.pressure=0:1e5"}, {"pressure.max=1e6"}),
               InvalidInput);
  EXPECT_THROW(run({"outlet.resistance=5e5:2e6"}, {"pressure.max=1e6", "pressure.max=2e6"}), InvalidInput);
}

TEST_F(Calibrating, FindsTheKeyAndItsDeviation) {
  // pressure = 2 R: R = 6e5 for 1.2e6, and a deviation of 1e4 of the pressure is one of 5e3 of R.
  const Calibration found = run({"outlet.resistance=5e5:2e6"}, {"pressure.max=1.2e6+-1e4"});
  ASSERT_TRUE(found.has_answer());
  EXPECT_TRUE(found.converged) << found.reason;
  EXPECT_NEAR(found.free[0].value, 6e5, 6);
  // Differences over 1 % of an exponential in u are off by (1 %)^2 / 6.
  EXPECT_NEAR(found.free[0].standard_deviation, 5e3, 1);
  EXPECT_EQ(found.agreeing(), 3);
  EXPECT_FALSE(found.conflicts());
  EXPECT_TRUE(findings(task_, found).empty());
  EXPECT_EQ(parameters_csv(task_, found).substr(0, 55),
            "parameter,value,low,high,standard_deviation,unit\noutlet");
}

TEST_F(Calibrating, SaysByHowMuchTargetsConflict) {
  // Two of 2 R at 1 %: 1.2e6 and 1.6e6 are answered by neither. Least squares with weights 1/s_i^2,
  // s_i = y_i / 100, gives 2 R = sum(y_i / s_i^2) / sum(1 / s_i^2) = 1.344e6.
  const Calibration found = run({"outlet.resistance=5e5:2e6"}, {"pressure.max=1.2e6", "pressure.min=1.6e6"});
  EXPECT_TRUE(found.converged) << found.reason;
  EXPECT_TRUE(found.conflicts());
  EXPECT_NEAR(2 * found.free[0].value, 1.344e6, 1e2);
  ASSERT_FALSE(findings(task_, found).empty());
  EXPECT_NE(findings(task_, found)[0].find(
                "pressure.max reaches 1.344e+06 instead of 1200000 dyn/cm2 (+12 %, +12 "),
            std::string::npos)
      << findings(task_, found)[0];
}

TEST_F(Calibrating, NamesKeysWithoutInfluenceAndThoseThatAreSeenTogether) {
  const Calibration without = run({"outlet.resistance=5e5:2e6", "tether.stiffness=1e6:1e8"},
                                  {"pressure.max=1.2e6", "pressure.min=1.2e6"});
  ASSERT_TRUE(without.has_answer());
  EXPECT_FALSE(without.free[1].has_influence);
  EXPECT_TRUE(observables::is_none(without.free[1].standard_deviation));
  EXPECT_NEAR(without.free[0].value, 6e5, 6);
  ASSERT_FALSE(findings(task_, without).empty());
  EXPECT_NE(findings(task_, without)[0].find("tether.stiffness has no influence"), std::string::npos);

  const Calibration together =
      run({"outlet.resistance=5e5:2e6", "outlet.pressure=1:1e5"}, {"outflow.max=1000", "outflow.min=1000"});
  ASSERT_TRUE(together.has_answer());
  EXPECT_FALSE(together.free[0].is_determined);
  EXPECT_NE(findings(task_, together)[0].find("do not tell outlet.resistance and outlet.pressure apart"),
            std::string::npos)
      << findings(task_, together)[0];
}

TEST_F(Calibrating, EndsAtABoundAndSaysSo) {
  const Calibration found = run({"outlet.resistance=5e5:2e6"}, {"pressure.max=5e6"});
  EXPECT_EQ(found.free[0].value, 2e6);
  EXPECT_TRUE(found.free[0].at_bound);
  EXPECT_TRUE(found.conflicts());
  EXPECT_NE(findings(task_, found).back().find("outlet.resistance ends at a bound"), std::string::npos);
}

TEST_F(Calibrating, KeepsTheBestWhenItIsInterrupted) {
  run({"outlet.resistance=5e5:2e6"}, {"pressure.max=1.2e6"});
  int runs = 0;
  Watch watch;
  watch.interrupted = [&] { return ++runs > 9; };
  const Calibration found = calibrate(run::Door(tiers_, source_), task_, watch);
  EXPECT_TRUE(found.interrupted);
  EXPECT_FALSE(found.converged);
  EXPECT_TRUE(found.has_answer());
}
