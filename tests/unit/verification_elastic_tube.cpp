// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "verification/studies/elastic_tube_runs.hpp"

namespace tunica::verification {
namespace {

TEST(ElasticTube, TracesAreLinearBetweenTheirTimes) {
  const TubeTrace trace{{0, 1, 3}, {0, 2, -2}};
  EXPECT_DOUBLE_EQ(trace.at(0.25), 0.5);
  EXPECT_DOUBLE_EQ(trace.at(1), 2);
  EXPECT_DOUBLE_EQ(trace.at(1.5), 1);
  EXPECT_DOUBLE_EQ(trace.at(-1), 0);
  EXPECT_DOUBLE_EQ(trace.at(7), -2);
}

TEST(ElasticTube, PeakOfAParabolaIsExactWhereverItIsSampled) {
  const auto parabola = [](double t) { return 3 - 2 * (t - 0.7) * (t - 0.7); };
  TubeTrace trace;
  for (const double t : {0.0, 0.3, 0.55, 0.82, 1.4}) {
    trace.time.push_back(t);
    trace.displacement.push_back(parabola(t));
  }
  const TubePeak peak = peak_of(trace);
  EXPECT_NEAR(peak.time, 0.7, 1e-14);
  EXPECT_NEAR(peak.displacement, 3, 1e-14);
}

TEST(ElasticTube, PeakOfASineIsRightToTheStepsFourthPower) {
  TubeTrace trace;
  const double step = 0.01;
  for (int k = 0; k < 300; ++k) {
    trace.time.push_back(step * k);
    trace.displacement.push_back(std::sin(trace.time.back()));
  }
  const TubePeak peak = peak_of(trace);
  // The sine departs from its parabola by s^4/24 at a distance s of at most 1.5 steps.
  EXPECT_NEAR(peak.displacement, 1, std::pow(1.5 * step, 4) / 24);
  EXPECT_NEAR(peak.time, std::acos(0.0), std::pow(step, 3));
}

TEST(ElasticTube, PeakAtAnEndIsNone) {
  EXPECT_THROW(peak_of({{0, 1, 2}, {0, 1, 2}}), std::logic_error);
  EXPECT_THROW(peak_of({{0, 1, 2}, {2, 1, 0}}), std::logic_error);
}

TEST(ElasticTube, GreatestDifferenceStopsAtTheGivenTime) {
  const TubeTrace ours{{0, 1, 2}, {0, 1, 2}}, theirs{{0, 0.5, 1, 2}, {0, 0.6, 0.7, 9}};
  EXPECT_DOUBLE_EQ(greatest_difference(ours, theirs, 1.5), 0.3);
  EXPECT_DOUBLE_EQ(greatest_difference(ours, theirs, 2), 7);
}

TEST(ElasticTube, RichardsonFindsLimitAndOrder) {
  const double limit = 0.159, factor = -4;
  for (const double order : {1.0, 1.56, 2.0, 3.0}) {
    const auto value = [&](double step) { return limit + factor * std::pow(step, order); };
    EXPECT_NEAR(extrapolated(value(0.1), value(0.05), order), limit, 1e-14);
    EXPECT_NEAR(observed_order(value(0.2), value(0.1), value(0.05)).value(), order, 1e-10);
  }
}

TEST(ElasticTube, ValuesThatTurnHaveNoOrder) {
  EXPECT_FALSE(observed_order(1, 2, 1.5).has_value());
  EXPECT_FALSE(observed_order(1, 2, 2).has_value());
  EXPECT_FALSE(observed_order(1, 1, 2).has_value());
  EXPECT_EQ(order_text(1, 2, 1.5), "not monotone");
  EXPECT_EQ(order_text(1, 2, 2), "converged");
  EXPECT_EQ(order_text(1, 2, 2.000001), "converged");
  EXPECT_EQ(order_text(0, 1, 1.25), "2.00");
}

/// What is published shows an order below 2, and the limit that the bars are for.
TEST(ElasticTube, PublishedLimitIsThatOfThePublishedSteps) {
  const auto peak = [](std::size_t k) { return published_tube.at(k).peak.displacement; };
  const double order = observed_order(peak(2), peak(3), peak(4)).value();
  EXPECT_NEAR(order, 1.56, 0.01);
  // The peaks are printed to 1e-4 mm.
  EXPECT_NEAR(extrapolated(peak(3), peak(4), order), published_limit.displacement, 1e-4);
}

}  // namespace
}  // namespace tunica::verification
