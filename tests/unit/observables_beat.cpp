// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/observables/beat.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/units.hpp"
#include "tests/support/synthetic.hpp"

using namespace tunica;
using namespace tunica::observables;
using tunica::test_support::synthetic_run;

namespace {

/// Share of a beat in which (1 - cos)/2 is above a threshold.
double share_above(double threshold) {
  return std::acos(2 * threshold - 1) / std::numbers::pi;
}

}  // namespace

TEST(Beat, LastBeatIsTheLastWholeOne) {
  StoredResult run = synthetic_run({.beats = 3});
  Beat beat = last_beat(run);
  EXPECT_NEAR(beat.start, 1.6, 1e-12);
  EXPECT_NEAR(beat.period, 0.8, 1e-12);
  EXPECT_EQ(beat.first, 1600u);
  EXPECT_EQ(beat.last, 2400u);
  EXPECT_TRUE(beat.whole);

  // Stopped in the third of five beats: the second is the last whole one.
  run.record["scene"]["time.beats"] = 5;
  run.record["failure"] = "no equilibrium";
  for (std::size_t column = 0; column < run.result.observables.columns().size(); ++column)
    run.result.observables[column].values.resize(2001);
  beat = last_beat(run);
  EXPECT_NEAR(beat.start, 0.8, 1e-12);
  EXPECT_NEAR(beat.period, 0.8, 1e-12);
}

TEST(Beat, ARunWithoutAWholeBeatIsTakenAsItIs) {
  StoredResult run = synthetic_run({});
  run.record["interrupted"] = true;
  for (std::size_t column = 0; column < run.result.observables.columns().size(); ++column)
    run.result.observables[column].values.resize(301);
  const Beat beat = last_beat(run);
  EXPECT_FALSE(beat.whole);
  EXPECT_NEAR(beat.end(), 0.3, 1e-12);
  EXPECT_EQ(beat.last, 300u);
}

TEST(Beat, NoRowsIsAnError) {
  StoredResult run = synthetic_run({});
  run.result.observables = standard_table();
  EXPECT_THROW(last_beat(run), InvalidInput);
}

TEST(Beat, RangeCoversTheLastBeatOnly) {
  const StoredResult run = synthetic_run({.lowest_pressure = 70, .highest_pressure = 120});
  const Table& table = run.result.observables;
  const Range pressure = range(table, "pressure", last_beat(run));
  // Rows are 1 ms apart, the extremes lie up to half of that beside them.
  EXPECT_NEAR(pressure.lowest / mmhg, 70, 1e-3);
  EXPECT_NEAR(pressure.highest / mmhg, 120, 1e-3);
  EXPECT_TRUE(is_none(range(table, "no_such_column", last_beat(run)).lowest));
  const StoredResult isotropic = synthetic_run({.law = "EXP1"});
  EXPECT_TRUE(is_none(range(isotropic.result.observables, "fiber_angle.P1", last_beat(isotropic)).highest));
}

TEST(Beat, PeakIsFoundBetweenRows) {
  const StoredResult run = synthetic_run({.interval = 0.01});
  EXPECT_NEAR(peak_time(run.result.observables, "inflow", last_beat(run)), 0.8 + 0.2112, 2e-6);
  EXPECT_TRUE(is_none(peak_time(run.result.observables, "no_such_column", last_beat(run))));
}

TEST(Beat, ValueIsLinearBetweenRowsAndNothingOutside) {
  StoredResult run = synthetic_run({});
  Table& table = run.result.observables;
  table[1].values[500] = 2;
  table[1].values[501] = 4;
  EXPECT_NEAR(value_at(table, "inflow", 0.50025), 2.5, 1e-9);
  EXPECT_NEAR(value_at(table, "inflow", 0.5), 2, 1e-9);
  EXPECT_EQ(value_at(table, "inflow", 0), table[1].values.front());
  EXPECT_EQ(value_at(table, "inflow", 1.6), table[1].values.back());
  EXPECT_TRUE(is_none(value_at(table, "inflow", 1.7)));
  EXPECT_TRUE(is_none(value_at(table, "inflow", -0.1)));
}

TEST(Beat, RecruitedShareUsesExactEvents) {
  const StoredResult run = synthetic_run({.interval = 0.02});
  for (int point = 1; point <= wall_points; ++point)
    EXPECT_NEAR(recruited_share(run.result, point, last_beat(run)),
                share_above(test_support::synthetic_thresholds[point - 1]), 1e-9)
        << "P" << point;
}

TEST(Beat, RecruitedShareFallsBackOnRows) {
  StoredResult run = synthetic_run({});
  run.result.events = Table{};
  for (int point = 1; point <= wall_points; ++point)
    EXPECT_NEAR(recruited_share(run.result, point, last_beat(run)),
                share_above(test_support::synthetic_thresholds[point - 1]), 2e-3)
        << "P" << point;
}

// As in tissue whose stress jumps: it lingers at the threshold and H wavers about 1/2.
TEST(Beat, EventsGoBeforeRowsThatWaver) {
  StoredResult run = synthetic_run({});
  const double share = recruited_share(run.result, 1, last_beat(run));
  const std::size_t intervals = recruited_intervals(run.result, 1, 0, 1.6).size();
  const auto& columns = run.result.observables.columns();
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [](const Column& column) { return column.name == "recruitment.P1"; });
  auto& recruitment = run.result.observables[static_cast<std::size_t>(found - columns.begin())].values;
  for (std::size_t row = 2; row < recruitment.size(); row += 7) recruitment[row] = 1 - recruitment[row];
  EXPECT_EQ(recruited_share(run.result, 1, last_beat(run)), share);
  EXPECT_EQ(recruited_intervals(run.result, 1, 0, 1.6).size(), intervals);
}

TEST(Beat, IntervalsAreClippedAndOrdered) {
  const StoredResult run = synthetic_run({});
  const auto all = recruited_intervals(run.result, 1, 0, 1.6);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[2].second, 1.6);
  const auto middle = recruited_intervals(run.result, 1, 0.3, 0.4);
  ASSERT_EQ(middle.size(), 1u);
  EXPECT_EQ(middle[0], (std::pair{0.3, 0.4}));
}

TEST(Beat, FibresOnTheThresholdAtRestCountOnceTheyAreStretched) {
  StoredResult run = synthetic_run({});
  const auto& columns = run.result.observables.columns();
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [](const Column& column) { return column.name == "recruitment.P1"; });
  Column& recruitment = run.result.observables[static_cast<std::size_t>(found - columns.begin())];
  recruitment.values.assign(recruitment.values.size(), 1.0);
  recruitment.values[0] = 0.5;
  run.result.events = event_table();
  EXPECT_NEAR(recruited_share(run.result, 1, last_beat(run)), 1, 1e-12);
}

TEST(Beat, ALawWithoutFibresHasNoShare) {
  const StoredResult run = synthetic_run({.law = "EXP1"});
  EXPECT_TRUE(is_none(recruited_share(run.result, 1, last_beat(run))));
  EXPECT_TRUE(recruited_intervals(run.result, 1, 0, 1.6).empty());
}

TEST(Beat, ASingleRowHasItsFibresRecruitedOrNot) {
  StoredResult run = synthetic_run({.law = "EXP1+EXP2-FS"});
  // At s = 1/2 of the made-up curves: above the thresholds of P1 and P2, below those of P3 and P4.
  const std::size_t row = 800 + 11;
  for (std::size_t column = 0; column < run.result.observables.columns().size(); ++column) {
    auto& values = run.result.observables[column].values;
    values = {values[row]};
  }
  run.result.observables[0].values = {0};
  run.result.events = event_table();
  const Beat beat = last_beat(run);
  EXPECT_FALSE(beat.whole);
  for (const auto& [point, share] : {std::pair{1, 1.0}, {2, 1.0}, {3, 0.0}, {4, 0.0}})
    EXPECT_EQ(recruited_share(run.result, point, beat), share) << point;
  const StoredResult isotropic = synthetic_run({.law = "EXP1"});
  EXPECT_TRUE(is_none(recruited_share(isotropic.result, 1, last_beat(isotropic))));
}
