// SPDX-License-Identifier: GPL-3.0-or-later
// What the results owe to the tolerances.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <numbers>

#include "core/error.hpp"
#include "tests/support/lumped_runs.hpp"

namespace tunica {
namespace {

using test_support::joined;
using test_support::run_lumped;

struct Gap {
  double size = 0;
  std::string where;
};

/// Largest move of any column of observables.csv over the column's range.
Gap largest_move(const Result& a, const Result& b) {
  Gap gap;
  for (std::size_t c = 1; c < a.observables.columns().size(); ++c) {
    const auto &x = a.observables[c].values, &y = b.observables[c].values;
    const double range = test_support::range(y);
    EXPECT_EQ(x.size(), y.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (range == 0 || observables::is_none(x[k])) continue;
      if (const double move = std::abs(x[k] - y[k]) / range; move > gap.size)
        gap = {move, fmt::format("{} at {:.3f} s", a.observables[c].name, a.observables[0].values[k])};
    }
  }
  return gap;
}

struct Case {
  const char* law;
  const char* reading;
};
class Tolerance : public testing::TestWithParam<Case> {
 protected:
  std::vector<std::string> base_{std::string("wall.law=") + GetParam().law,
                                 std::string("tether.traction=") + GetParam().reading};
  Result at(double tolerance) const {
    return run_lumped(joined(base_, {fmt::format("accuracy.tolerance={}", tolerance)}));
  }
};

/// The share that is recruited, H, is an arctangent of 5e5 times what the tolerance holds for: of rows it is
/// left out, of quantities it is not (RunQuestion).
Gap largest_move_but_recruitment(Result a, const Result& b) {
  for (std::size_t c = 0; c < a.observables.columns().size(); ++c)
    if (a.observables[c].name.starts_with("recruitment")) a.observables[c].values = b.observables[c].values;
  return largest_move(a, b);
}

// No column is off by more than the tolerance of its range, and what is looser takes fewer steps. Their
// errors fall with up to the sixth power of their length: 1e5 of tolerance is worth a factor of 3 at least.
TEST_P(Tolerance, IsKeptAtEveryValueAndPaidFor) {
  const Result finest = at(1e-9);
  std::vector<long> steps;
  for (const double tolerance : {0.1, 1e-2, 1e-3, 1e-5, 1e-7}) {
    const Result whole = at(tolerance);
    const Gap error = largest_move_but_recruitment(whole, finest);
    std::cout << GetParam().law << ", " << GetParam().reading << ", tolerance " << tolerance << ": "
              << error.size << " (" << error.where << "), " << whole.record.steps << " steps\n";
    EXPECT_LT(error.size, tolerance) << error.where;
    steps.push_back(whole.record.steps);
  }
  EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end()));
  EXPECT_GT(steps.back(), 3 * steps[1]);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* law : test_support::paper_laws)
    for (const char* reading : {"normal", "reference"}) all.push_back({law, reading});
  return all;
}
INSTANTIATE_TEST_SUITE_P(Lumped, Tolerance, testing::ValuesIn(cases()), [](const auto& instance) {
  std::string name = std::string(instance.param.law) + "_" + instance.param.reading;
  std::erase_if(name, [](char c) { return c == '+' || c == '-'; });
  return name;
});

TEST(LumpedTolerance, OfAChainWithInertanceAndRcr) {
  const std::vector<std::string> base{"lumped.compartments=12", "lumped.inertance=true", "outlet.kind=rcr"};
  const Result whole = run_lumped(joined(base, {"accuracy.tolerance=1e-6"}));
  const Gap gap = largest_move(whole, run_lumped(joined(base, {"accuracy.tolerance=5e-7"})));
  std::cout << "12 compartments: halving moves " << gap.size << " (" << gap.where << ")\n";
  EXPECT_LT(gap.size, 1e-5) << gap.where;
}

// Networks of other kinds than the paper's, against a million times tighter steps.
TEST(LumpedTolerance, OfOtherNetworks) {
  for (const std::vector<std::string>& base : {std::vector<std::string>{"outlet.kind=rcr"},
                                               {"lumped.compartments=5"},
                                               {"inlet.waveform=pressure"},
                                               {"wall.incompressible=true"},
                                               {"lumped.compartments=5", "lumped.inertance=true"}}) {
    const Result finest = run_lumped(joined(base, {"accuracy.tolerance=1e-9"}));
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
      const Gap gap = largest_move_but_recruitment(
          run_lumped(joined(base, {fmt::format("accuracy.tolerance={}", tolerance)})), finest);
      std::cout << base.back() << ", " << tolerance << ": " << gap.size << " (" << gap.where << ")\n";
      EXPECT_LT(gap.size, tolerance) << base[0] << ": " << gap.where;
    }
  }
}

struct Stiffness {
  const char* name;
  std::vector<std::string> overrides;
};
class AnyStiffness : public testing::TestWithParam<Stiffness> {};

// The tolerance is held in pressure as in area, of walls that move by 1e-8 of their radius and of such as a
// tether has to hold.
TEST_P(AnyStiffness, KeepsTheTolerance) {
  Result whole = run_lumped(GetParam().overrides);
  const Result finest = run_lumped(joined(GetParam().overrides, {"accuracy.tolerance=1e-9"}));
  const Gap gap = largest_move(whole, finest);
  std::cout << GetParam().name << ": 1e-9 moves " << gap.size << " (" << gap.where << ")\n";
  EXPECT_LT(gap.size, 1e-7) << gap.where;
}
INSTANTIATE_TEST_SUITE_P(
    Lumped, AnyStiffness,
    testing::Values(Stiffness{"shear_1e12", {"wall.law=neo-Hookean", "wall.shear_modulus=1e12"}},
                    Stiffness{
                        "shear_1e12_incompressible",
                        {"wall.law=neo-Hookean", "wall.shear_modulus=1e12", "wall.incompressible=true"}},
                    Stiffness{"young_1e12", {"wall.law=linear-elastic", "wall.young_modulus=1e12"}},
                    Stiffness{"exponential_1e12", {"wall.law=EXP1", "wall.stiffness=1e12"}},
                    Stiffness{"steep_exponential", {"wall.law=EXP1", "wall.stiffening=100"}},
                    Stiffness{"bulk_1e13", {"wall.law=EXP1", "wall.bulk_modulus=1e13"}},
                    Stiffness{"shear_1e3", {"wall.law=neo-Hookean", "wall.shear_modulus=1e3"}},
                    Stiffness{"chain_1e12",
                              {"wall.law=neo-Hookean", "wall.shear_modulus=1e12", "lumped.compartments=40"}}),
    [](const auto& instance) { return std::string(instance.param.name); });

// A wall that stiff is a rigid pipe: p = (R + R_p/2) Q with Poiseuille's R_p = 8 mu l/(pi r^4), to the 1e-7
// that it gives way by.
TEST(LumpedTolerance, AStiffWallIsARigidPipe) {
  const Result run = run_lumped({"wall.law=neo-Hookean", "wall.shear_modulus=1e12"});
  const double half = 4 * 0.035 * 0.66 / (std::numbers::pi * std::pow(0.033, 4));
  const auto &pressure = test_support::column(run.observables, "pressure"),
             &inflow = test_support::column(run.observables, "inflow");
  const double range = test_support::range(pressure);
  for (std::size_t k = 0; k < pressure.size(); ++k)
    EXPECT_NEAR(pressure[k], (1.032e6 + half) * inflow[k], 1e-6 * range) << "row " << k;
}

// The output grid only looks: it must not steer the steps.
TEST(LumpedTolerance, OutputIntervalMovesNothing) {
  const Result coarse = run_lumped({"output.interval=0.01", "accuracy.tolerance=1e-6"});
  const Result fine = run_lumped({"output.interval=0.001", "accuracy.tolerance=1e-6"});
  for (std::size_t c = 1; c < coarse.observables.columns().size(); ++c)
    for (std::size_t k = 0; k < coarse.observables.rows(); ++k)
      EXPECT_NEAR(coarse.observables[c].values[k], fine.observables[c].values[10 * k],
                  1e-5 * test_support::range(fine.observables[c].values) + 1e-12)
          << coarse.observables[c].name << " row " << k;
}

TEST(LumpedTolerance, RowsAreAtTheirTimesAndTheEndIsThere) {
  const Result result = run_lumped({"output.interval=0.03", "time.beats=1"});
  const auto& time = test_support::column(result.observables, "time");
  ASSERT_EQ(time.size(), 28U);
  for (std::size_t k = 0; k + 1 < time.size(); ++k) EXPECT_DOUBLE_EQ(time[k], 0.03 * static_cast<double>(k));
  EXPECT_DOUBLE_EQ(time.back(), 0.8);
}

// A neo-Hookean wall that nothing holds gives way at a pressure far below the artery's.
TEST(LumpedFailure, KeepsWhatItHasAndSaysWhenAndWhy) {
  const Scene scene =
      test_support::scene_with({"wall.law=neo-Hookean", "tether.stiffness=0", "wall.incompressible=true"});
  const Result result = lumped::LumpedTier().prepare(scene)->execute({});
  EXPECT_FALSE(result.record.converged);
  EXPECT_NE(result.record.failure.find("at t = "), std::string::npos) << result.record.failure;
  EXPECT_NE(result.record.failure.find("lumen stretch"), std::string::npos) << result.record.failure;
  const auto& time = test_support::column(result.observables, "time");
  ASSERT_GT(time.size(), 2U);
  const double failed_at = std::stod(result.record.failure.substr(7));
  EXPECT_GE(failed_at, time.back());
  EXPECT_LT(failed_at, time.back() + 2e-3) << "results are kept up to the failure";
  for (const auto& column : result.observables.columns())
    EXPECT_EQ(column.size(), time.size()) << column.name;
}

TEST(LumpedControl, InterruptionKeepsRowsAndProgressIsTold) {
  const Scene scene = test_support::scene_with({});
  int reports = 0;
  RunControl control;
  Progress last;
  control.report = [&](const Progress& progress) {
    ++reports;
    EXPECT_GE(progress.time, last.time);
    last = progress;
  };
  control.interrupted = [&] { return last.time >= 0.3; };
  const Result result = lumped::LumpedTier().prepare(scene)->execute(control);
  EXPECT_TRUE(result.record.interrupted);
  EXPECT_FALSE(result.record.converged);
  EXPECT_NEAR(test_support::column(result.observables, "time").back(), 0.3, 2e-3);
  EXPECT_GT(reports, 100);
  EXPECT_EQ(last.beat, 1);
  EXPECT_DOUBLE_EQ(last.end_time, 1.6);
}

TEST(LumpedTierItself, SuitsCylindersAndTakesBends) {
  const lumped::LumpedTier tier;
  EXPECT_EQ(tier.name(), "lumped");
  EXPECT_TRUE(tier.suits(test_support::scene_with({})));
  const Scene torus = test_support::scene_with({"geometry.kind=torus", "time.beats=1"});
  EXPECT_FALSE(tier.suits(torus));
  EXPECT_EQ(tier.refusal(torus), "");
  const Result result = run_lumped(torus);
  EXPECT_TRUE(std::any_of(result.record.remarks.begin(), result.record.remarks.end(),
                          [](const auto& remark) { return remark.find("bend") != std::string::npos; }));
}

}  // namespace
}  // namespace tunica
