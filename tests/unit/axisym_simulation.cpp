// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of the axisymmetric tier that stop on the way: what is saved is all that a run depends on, so that
// every later bit is that of a run that was not disturbed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "axisym/assembler.hpp"
#include "axisym/axisym_tier.hpp"
#include "axisym/setup.hpp"
#include "core/coupled/simulation.hpp"
#include "core/error.hpp"
#include "core/observables/result_json.hpp"

namespace tunica::axisym {
namespace {

using coupled::Simulation;
using coupled::SimulationOptions;

using Overrides = std::vector<std::string>;

/// The paper's cylinder on a coarse mesh.
Scene coarse(const Overrides& more) {
  Overrides all{"mesh.wall_cells=1", "mesh.blood_cells=1", "mesh.axial_cells=4", "time.beats=1",
                "output.interval=0.01"};
  all.insert(all.end(), more.begin(), more.end());
  return parse_scene("[geometry]\nradius = 0.033\n", "coarse", ".", all);
}

struct Case {
  const char* name;
  time::Method method;
  bool fixed;
  Overrides overrides;
};

class SavedSimulation : public testing::TestWithParam<Case> {
 protected:
  std::unique_ptr<Simulation> simulation() const {
    SimulationOptions options;
    options.method = GetParam().method;
    options.steps = {.first = 1e-4, .minimum = 1e-9, .maximum = 0.01, .fixed = GetParam().fixed};
    if (GetParam().fixed) options.steps.first = options.steps.maximum = 2e-3;
    options.jumps = setup_->inlet.jumps(1.0);
    options.milestone = 5;
    return std::make_unique<Simulation>(assembler_, options);
  }
  const Scene scene_ = coarse(GetParam().overrides);
  const std::unique_ptr<axisym::Setup> setup_ = setup_of(scene_);
  const Assembler assembler_{setup_->problem};
};

TEST_P(SavedSimulation, GoesOnBitwiseFromEveryMilestone) {
  constexpr int steps = 40;
  const auto whole = simulation();
  whole->start(0, std::vector<double>(whole->layout().size(), 0.0));
  std::vector<std::vector<std::uint8_t>> saved;
  std::vector<int> at;
  for (int k = 1; k <= steps; ++k) {
    whole->advance(1.0);
    if (!whole->at_milestone()) continue;
    // As a checkpoint has it.
    saved.push_back(nlohmann::json::to_cbor(whole->save()));
    at.push_back(k);
  }
  ASSERT_EQ(saved.size(), 8U);
  for (std::size_t s = 0; s < saved.size(); ++s) {
    const auto resumed = simulation();
    resumed->restore(nlohmann::json::from_cbor(saved[s]));
    for (int k = at[s]; k < steps; ++k) resumed->advance(1.0);
    EXPECT_EQ(resumed->time(), whole->time()) << "from step " << at[s];
    EXPECT_EQ(resumed->step_begin(), whole->step_begin());
    EXPECT_EQ(resumed->least_jacobian(), whole->least_jacobian());
    EXPECT_TRUE(resumed->state() == whole->state()) << "from step " << at[s];
    EXPECT_TRUE(resumed->rates() == whole->rates()) << "from step " << at[s];
    EXPECT_EQ(resumed->step_counts().accepted, whole->step_counts().accepted);
    EXPECT_EQ(resumed->step_counts().rejected_by_error, whole->step_counts().rejected_by_error);
  }
}

const char* const pulse = "inlet.waveform=pulse";
INSTANTIATE_TEST_SUITE_P(
    , SavedSimulation,
    testing::Values(Case{"bdf2", time::Method::bdf2, false, {}},
                    Case{"backward_euler", time::Method::backward_euler, false, {"outlet.kind=rcr"}},
                    Case{"fixed_alpha", time::Method::generalized_alpha, true, {"inlet.profile=natural"}},
                    Case{"pulses",
                         time::Method::bdf2,
                         false,
                         {pulse, "inlet.period=0.02", "inlet.pressure=3000", "time.ramp=0"}}),
    [](const auto& instance) { return instance.param.name; });

TEST(SimulationJumps, EndAStepThatCanBeInterpolated) {
  const Scene scene = coarse({pulse, "inlet.period=0.02", "inlet.pressure=3000", "time.ramp=0"});
  const auto setup = setup_of(scene);
  SimulationOptions options;
  options.steps = {.first = 1e-4, .minimum = 1e-9, .maximum = 0.01};
  options.jumps = setup->inlet.jumps(0.05);
  ASSERT_EQ(options.jumps.size(), 5U);  // 0.003, 0.02, 0.023, 0.04, 0.043
  const Assembler assembler(setup->problem);
  Simulation simulation(assembler, options);
  simulation.start(0, std::vector<double>(simulation.layout().size(), 0.0));
  std::vector<double> met, between(simulation.layout().size());
  while (simulation.time() < 0.05) {
    simulation.advance(0.05);
    if (std::binary_search(options.jumps.begin(), options.jumps.end(), simulation.time()))
      met.push_back(simulation.time());
    simulation.interpolate(simulation.time(), between);
    EXPECT_TRUE(between == simulation.state());
    EXPECT_NO_THROW(simulation.interpolate(0.5 * (simulation.step_begin() + simulation.time()), between));
  }
  EXPECT_EQ(met, options.jumps);
}

/// A result without what no two runs share.
nlohmann::json comparable(Result result) {
  result.record.setup_seconds = result.record.solve_seconds = result.record.median_step_seconds = 0;
  return json::from_result(result);
}

class ResumedRun : public testing::TestWithParam<std::pair<const char*, Overrides>> {
 protected:
  Result run(const RunControl& control) const { return AxisymTier().prepare(scene_)->execute(control); }
  const Scene scene_ = coarse(GetParam().second);
};

TEST_P(ResumedRun, HasEveryBitOfOneThatWasNotDisturbed) {
  std::vector<Checkpoint> saved;
  RunControl control;
  control.save = [&](const Checkpoint& checkpoint) {
    // As it comes back from a file.
    const auto state = nlohmann::json::from_cbor(nlohmann::json::to_cbor(checkpoint.state));
    saved.push_back({state, json::to_result(json::from_result(checkpoint.so_far))});
  };
  const Result whole = run(control);
  ASSERT_EQ(whole.record.failure, "");
  ASSERT_GE(saved.size(), 2U);
  EXPECT_GT(whole.observables.rows(), 50U);
  const std::size_t few = std::max<std::size_t>(1, saved.size() / 4);
  for (std::size_t k = 0; k < saved.size(); k += few) {
    RunControl resuming;
    resuming.resume = &saved[k];
    EXPECT_TRUE(comparable(run(resuming)) == comparable(whole)) << "from checkpoint " << k;
  }
}

TEST_P(ResumedRun, EndsWhenAskedAtAnyMomentAndKeepsWhatItHas) {
  const Result whole = run({});
  for (const int moment : {0, 1, 7, 60}) {
    int asked = 0;
    RunControl control;
    control.interrupted = [&] { return asked++ >= moment; };
    const Result part = run(control);
    EXPECT_TRUE(part.record.interrupted);
    EXPECT_FALSE(part.record.converged);
    EXPECT_EQ(part.record.failure, "");
    ASSERT_LT(part.observables.rows(), whole.observables.rows());
    for (std::size_t c = 0; c < part.observables.columns().size(); ++c)
      for (std::size_t row = 0; row < part.observables.rows(); ++row) {
        const double value = part.observables[c].values[row], wanted = whole.observables[c].values[row];
        EXPECT_TRUE(value == wanted || (observables::is_none(value) && observables::is_none(wanted)))
            << part.observables[c].name << " in row " << row;
      }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , ResumedRun,
    testing::Values(
        std::pair{"rest", Overrides{"accuracy.tolerance=1e-3"}},
        std::pair{"static", Overrides{"time.start=static", "time.step=4e-3"}},
        std::pair{"sensitivities",
                  Overrides{"accuracy.tolerance=1e-3",
                            "sensitivity.parameters=['outlet.resistance', 'geometry.thickness']"}},
        std::pair{"periodic", Overrides{"time.start=periodic", "outlet.kind=rcr", "time.beats=3"}},
        std::pair{"pulses",
                  Overrides{pulse, "inlet.period=0.1", "time.beats=6", "time.ramp=0", "inlet.pressure=3000"}},
        std::pair{"alpha", Overrides{"time.scheme=generalized-alpha", "time.step=4e-3", "wall.law=EXP1"}}),
    [](const auto& instance) { return instance.param.first; });

TEST(AxisymProgress, TellsOfTheWayToTheFirstState) {
  const Scene scene = coarse({"time.start=periodic"});
  std::vector<Progress> told;
  RunControl control;
  control.report = [&](const Progress& progress) { told.push_back(progress); };
  AxisymTier().prepare(scene)->execute(control);
  const auto first = std::find_if(told.begin(), told.end(), [](const Progress& p) { return p.beat > 0; });
  // Five loads of 15 mmHg and at least two periods of twenty steps.
  EXPECT_GT(first - told.begin(), 45);
  EXPECT_TRUE(std::all_of(first, told.end(), [](const Progress& p) { return p.beat == 1; }));
}

// The pressure that drives a given flow holds the flow's rate, which a static state has not: it jumps at the
// first step however small that is.
TEST(AxisymStart, FromAStaticStateUnderAFlowThatChanges) {
  const Result result =
      AxisymTier().prepare(coarse({"time.start=static", "inlet.profile=natural"}))->execute({});
  EXPECT_EQ(result.record.failure, "");
  EXPECT_EQ(result.observables.rows(), 81U);
}

TEST(AxisymSteps, ThatAreTooLongAreDividedAndItIsSaid) {
  const auto findings = [](const char* step) {
    const Result result = AxisymTier().prepare(coarse({step, "time.ramp=0"}))->execute({});
    EXPECT_EQ(result.record.failure, "");
    return result.record.findings;
  };
  EXPECT_TRUE(findings("time.step=2e-3").empty());
  const auto found = findings("time.step=0.1");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found.front().find("time.step = 0.1 s"), std::string::npos) << found.front();
  EXPECT_NE(found.front().find("divided"), std::string::npos) << found.front();
}

TEST(AxisymSimulation, RestIsWithoutSigns) {
  const Result result = AxisymTier().prepare(coarse({}))->execute({});
  for (const char* name : {"inflow", "outflow", "pressure", "outlet_pressure"}) {
    const double value = result.observables.find(name)->values.front();
    EXPECT_EQ(value, 0) << name;
    EXPECT_FALSE(std::signbit(value)) << name;
  }
}

}  // namespace
}  // namespace tunica::axisym
