// SPDX-License-Identifier: GPL-3.0-or-later
// Norms of differences and their limits, for curves whose differences are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/synthetic.hpp"
#include "verification/difference.hpp"

using namespace tunica;
using namespace tunica::verification;
using test_support::synthetic_run;
using test_support::synthetic_thresholds;

namespace {

constexpr double period = 0.8, peak = 0.2112;

BeatRun beat_run(const StoredResult& stored) {
  return {&stored, observables::last_beat(stored)};
}

const Quantity& quantity(const std::string& label) {
  for (const Quantity& one : compared_quantities())
    if (one.label == label) return one;
  throw std::runtime_error("no quantity " + label);
}

/// The synthetic run with a column made anew of time.
template <class F>
StoredResult with_column(StoredResult stored, const char* column, const F& value) {
  auto& table = stored.result.observables;
  for (std::size_t k = 0; k < table.columns().size(); ++k)
    if (table[k].name == column)
      for (std::size_t row = 0; row < table.rows(); ++row)
        table[k].values[row] = value(table.find("time")->values[row]);
  return stored;
}

StoredResult with_events_moved(StoredResult stored, double shift) {
  for (double& time : stored.result.events[0].values) time += shift;
  return stored;
}

}  // namespace

TEST(Difference, OfCurvesIsRelativeToTheRangeOfTheReference) {
  const StoredResult reference = synthetic_run({.displacement_scale = 0.0200});
  const StoredResult run = synthetic_run({.displacement_scale = 0.0204});
  const BeatRun a = beat_run(run), b = beat_run(reference);
  const Quantity& displacement = quantity("displacement P1");
  const Yardstick by = yardstick(displacement, b, a, 0.01);
  // u = 0.02 (0.6 + 0.4 s), s from 0 to 1: range 0.008; rows miss the peak of s by up to half a step.
  EXPECT_NEAR(by.scale, 0.008, 1e-7);
  EXPECT_EQ(by.limit, 0.01);
  const Difference found = difference(displacement, a, b, by.scale);
  EXPECT_NEAR(found.largest, 0.0004 / 0.008, 1e-5);
  EXPECT_NEAR(found.at, peak, 1e-3);
  // The mean of (0.6 + 0.4 s)^2 over a beat is 0.66, as s has mean 1/2 and mean square 3/8.
  EXPECT_NEAR(found.rms, 0.05 * std::sqrt(0.66), 1e-5);
}

TEST(Difference, OfAnglesIsInDegrees) {
  const StoredResult reference = synthetic_run({});
  const auto run = with_column(reference, "fiber_angle.P2", [&](double time) {
    return observables::value_at(reference.result.observables, "fiber_angle.P2", time) - 0.2;
  });
  const BeatRun a = beat_run(run), b = beat_run(reference);
  const Yardstick by = yardstick(quantity("fibre angle P2"), b, a, 0.01);
  // A circumferential stretch 1 % too large turns a fibre at 45 degrees by atan(1/1.01) - 45 degrees.
  EXPECT_NEAR(by.limit, 45 - std::atan(1 / 1.01) * 180 / std::numbers::pi, 2e-3);
  const Difference found = difference(quantity("fibre angle P2"), a, b, by.scale);
  EXPECT_NEAR(found.largest, 0.2, 1e-12);
  EXPECT_NEAR(found.rms, 0.2, 1e-12);
}

TEST(Difference, OfPeaksIsTakenRoundTheBeat) {
  const auto wave = [](double shift) {
    return with_column(synthetic_run({}), "outflow", [=](double time) {
      return 1 - 0.5 * std::cos(2 * std::numbers::pi * (time - shift + period / 2) / period);
    });
  };
  const Quantity& of_peak = quantity("peak of outflow");
  const StoredResult reference = wave(0.2), later = wave(0.2037);
  const Yardstick by = yardstick(of_peak, beat_run(reference), beat_run(later), 0.01);
  EXPECT_NEAR(by.limit, 4, 0.02) << "a hundredth of the half beat in which it rises";
  EXPECT_NEAR(difference(of_peak, beat_run(later), beat_run(reference), 1).largest, 3.7, 1e-3);
  // 1 ms before the end of the beat and 1 ms after its start. There a peak is found to half a row.
  const StoredResult start = wave(0.001), end = wave(-0.001);
  EXPECT_NEAR(difference(of_peak, beat_run(start), beat_run(end), 1).largest, 2, 0.6);
}

TEST(Difference, AQuantityThatHardlyMovesHasNoPeakAndIsMeasuredByItsSize) {
  const auto flat = [](double size) {
    return with_column(synthetic_run({}), "pressure",
                       [=](double time) { return size + 1e-3 * std::sin(50 * time); });
  };
  const StoredResult reference = flat(100), run = flat(101);
  const BeatRun a = beat_run(run), b = beat_run(reference);
  EXPECT_TRUE(observables::is_none(yardstick(quantity("peak of pressure"), b, a, 0.01).limit));
  const Yardstick by = yardstick(quantity("pressure"), b, a, 0.01);
  EXPECT_NEAR(difference(quantity("pressure"), a, b, by.scale).largest, 0.01, 1e-6);
}

TEST(Difference, OfRecruitmentIsTheTimeThatRunsDisagree) {
  const StoredResult reference = synthetic_run({}), run = with_events_moved(reference, 0.0015);
  const BeatRun a = beat_run(run), b = beat_run(reference);
  for (int point = 1; point <= 4; ++point) {
    const Quantity& recruitment = quantity("recruitment P" + std::to_string(point));
    EXPECT_NEAR(difference(recruitment, a, b, 1).largest, 3, 1e-9) << "1.5 ms at either end";
    // Stretch goes with s and is recruited at s = x, so t percent of its range are t percent of s, and
    // ds/dt = (pi/T) sin(phi) with cos(phi) = 1 - 2 x.
    const double x = synthetic_thresholds[point - 1];
    const double slope = std::numbers::pi / period * 2 * std::sqrt(x * (1 - x));
    const Yardstick by = yardstick(recruitment, b, a, 0.005);
    EXPECT_NEAR(by.limit, 1e3 * 2 * 0.005 / slope, 0.02 * by.limit) << "P" << point;
  }
}

TEST(Difference, OfARunThatIsRecruitedAllTheTimeToOneThatNeverIsIsTheBeat) {
  StoredResult always = with_column(synthetic_run({}), "recruitment.P1", [](double) { return 1.0; });
  StoredResult never = with_column(synthetic_run({}), "recruitment.P1", [](double) { return 0.0; });
  always.result.events = never.result.events = observables::event_table();
  const BeatRun a = beat_run(always), b = beat_run(never);
  const Quantity& recruitment = quantity("recruitment P1");
  EXPECT_NEAR(difference(recruitment, a, b, 1).largest, 1e3 * period, 1e-6);
  EXPECT_EQ(yardstick(recruitment, b, a, 0.01).limit, 0);
  EXPECT_EQ(difference(recruitment, a, a, 1).largest, 0);
}

TEST(Difference, WhatALawHasNotIsNotCompared) {
  const StoredResult isotropic = synthetic_run({.law = "EXP1"}), fibers = synthetic_run({});
  const BeatRun a = beat_run(isotropic), b = beat_run(fibers);
  for (const Quantity& one : compared_quantities()) {
    const bool of_fibers = one.column.starts_with("fiber");
    EXPECT_EQ(observables::is_none(yardstick(one, a, a, 0.01).limit), of_fibers) << one.label;
    EXPECT_EQ(observables::is_none(difference(one, a, b, 1).largest), of_fibers) << one.label;
  }
}

TEST(Difference, OfRunsWithOtherOutputTimesIsTakenAtTheReferences) {
  const StoredResult coarse = synthetic_run({.interval = 0.002}), fine = synthetic_run({.interval = 0.0008});
  // Linear between rows 2 ms apart: (pi/T)^2/2 of the range times h^2/8 per unit of range.
  const double interpolation = std::pow(std::numbers::pi / period, 2) * 2 * 0.002 * 0.002 / 8;
  const Quantity& pressure = quantity("pressure");
  const BeatRun a = beat_run(coarse), b = beat_run(fine);
  const double largest = difference(pressure, a, b, yardstick(pressure, b, a, 0.01).scale).largest;
  EXPECT_LT(largest, 1.1 * interpolation);
  EXPECT_GT(largest, 0.2 * interpolation);
}
