// SPDX-License-Identifier: GPL-3.0-or-later
// Starts: from rest, with and without a ramp, and on the limit cycle.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <numbers>

#include "core/units.hpp"
#include "tests/support/lumped_runs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

using test_support::column;
using test_support::joined;
using test_support::run_lumped;

/// Largest difference of any column between rows of two tables, relative to the column's range.
double largest_gap(const observables::Table& a, std::size_t first_a, const observables::Table& b,
                   std::size_t first_b) {
  double worst = 0;
  for (std::size_t c = 1; c < a.columns().size(); ++c) {
    const auto &x = a[c].values, &y = b[c].values;
    const double range = test_support::range(y);
    for (std::size_t k = 0; first_a + k < x.size() && first_b + k < y.size(); ++k) {
      EXPECT_EQ(observables::is_none(x[first_a + k]), observables::is_none(y[first_b + k]));
      if (range > 0) worst = std::max(worst, std::abs(x[first_a + k] - y[first_b + k]) / range);
    }
  }
  return worst;
}

class LimitCycle : public testing::TestWithParam<const char*> {};

// The limit cycle start agrees with beat 10 from rest to 1e-6. Every column of
// observables.csv, recruitment included, relative to its range; at the tolerance that is asked for
// results as fine as that.
TEST_P(LimitCycle, IsBeatTenFromRest) {
  for (const char* reading : {"normal", "reference"}) {
    const std::vector<std::string> base{std::string("wall.law=") + GetParam(),
                                        std::string("tether.traction=") + reading, "accuracy.tolerance=1e-9"};
    const Result periodic = run_lumped(joined(base, {"time.start=periodic", "time.beats=1"}));
    const Result rest = run_lumped(joined(base, {"time.start=rest", "time.beats=10"}));
    const double gap = largest_gap(periodic.observables, 0, rest.observables, 7200);
    std::cout << GetParam() << ", " << reading << ": limit cycle against beat 10: " << gap << "\n";
    EXPECT_LT(gap, 1e-6);
  }
}

TEST_P(LimitCycle, RepeatsItself) {
  const Result result =
      run_lumped({std::string("wall.law=") + GetParam(), "accuracy.tolerance=1e-8", "time.start=periodic"});
  EXPECT_LT(largest_gap(result.observables, 0, result.observables, 800), 1e-6);
}

TEST_P(LimitCycle, RampIsForgottenInTheSecondBeat) {
  const std::vector<std::string> base{std::string("wall.law=") + GetParam(), "accuracy.tolerance=1e-8"};
  const Result none = run_lumped(joined(base, {"time.ramp=0"}));
  const Result slow = run_lumped(joined(base, {"time.ramp=0.3"}));
  // RC is some 0.03 s, so that 0.5 s leave exp(-16).
  EXPECT_LT(largest_gap(none.observables, 800, slow.observables, 800), 1e-6);
  EXPECT_GT(largest_gap(none.observables, 0, slow.observables, 0), 1e-2) << "the first beat differs";
}

INSTANTIATE_TEST_SUITE_P(Lumped, LimitCycle, testing::ValuesIn(test_support::paper_laws),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::erase_if(name, [](char c) { return c == '+' || c == '-'; });
                           return name;
                         });

TEST(LumpedStart, LimitCycleOfEveryKindOfNetwork) {
  for (const std::vector<std::string>& overrides :
       {std::vector<std::string>{"outlet.kind=rcr"},
        {"lumped.compartments=3", "lumped.inertance=true"},
        {"lumped.compartments=40"},
        {"lumped.compartments=2", "outlet.kind=rcr", "lumped.inertance=true"}}) {
    SCOPED_TRACE(overrides[0]);
    const std::vector<std::string> base = joined({"accuracy.tolerance=1e-7"}, overrides);
    const Result periodic = run_lumped(joined(base, {"time.start=periodic", "time.beats=1"}));
    const Result rest = run_lumped(joined(base, {"time.start=rest", "time.beats=6"}));
    // Recruitment, a step as good as, is compared by its times elsewhere.
    for (const char* name : {"outflow", "pressure", "outlet_pressure", "radial_displacement.P4"}) {
      const auto &a = column(periodic.observables, name), &b = column(rest.observables, name);
      for (std::size_t k = 0; k < a.size(); k += 7)
        EXPECT_NEAR(a[k], b[4000 + k], 1e-6 * test_support::range(a)) << name << " row " << k;
    }
  }
}

// The flow's size is then known from the pressure in the file only.
TEST(LumpedStart, LimitCycleUnderAPressureFromAFile) {
  const test_support::TemporaryFolder folder;
  std::ofstream file(folder.path() / "pressure.csv");
  file << "time[s],pressure[mmHg]\n";
  constexpr int intervals = 40;
  for (int k = 0; k <= intervals; ++k)
    file << fmt::format("{},{}\n", 0.8 * k / intervals,
                        100 - 20 * std::cos(2 * std::numbers::pi * k / intervals));
  file.close();
  const std::vector<std::string> base{"inlet.waveform=pressure.csv", "lumped.inertance=true",
                                      "time.start=periodic", "time.beats=1"};
  const Result result = run_lumped(base, folder.path().string());
  const auto& pressure = column(result.observables, "pressure");
  EXPECT_NEAR(pressure.back(), pressure.front(), 1e-6 * test_support::range(pressure));
  // Poiseuille and inertia take about 1 % of the pressure on the way to the middle.
  EXPECT_NEAR(*std::max_element(pressure.begin(), pressure.end()) / mmhg, 120, 2);
}

TEST(LumpedStart, AtRestNothingIsLoaded) {
  const Result result = run_lumped({"time.beats=1"});
  EXPECT_EQ(column(result.observables, "inflow")[0], 0);
  EXPECT_NEAR(column(result.observables, "radial_displacement.P1")[0], 0, 1e-10);
  // Unrecruited fibres keep 1e-6 of their stress under smooth recruitment: less than 1 dyn/cm2.
  EXPECT_NEAR(column(result.observables, "pressure")[0], 0, 1);
}

}  // namespace
}  // namespace tunica
