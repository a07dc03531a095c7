// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities of a beat that is known in closed form, and their derivatives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/run/quantity.hpp"

using namespace tunica;
using run::Quantity;
using run::Statistic;

namespace {

constexpr double period = 0.8, step = 1e-3, phase = 0.3, mean = 5, amplitude = 2;
constexpr int rows_a_beat = 800;

double angle(double time) {
  return 2 * std::numbers::pi * time / period - phase;
}

/// Two beats of pressure = mean + amplitude cos(angle), with sensitivities by the amplitude ("a") and the
/// phase ("p"); fibres at P2 recruited from 0.2 to 0.5 s of each beat.
Result known_result() {
  Result result;
  result.observables = observables::standard_table();
  result.sensitivities.add("time", "s");
  result.sensitivities.add("d(pressure)/d(a)", "dyn/cm2");
  result.sensitivities.add("d(pressure)/d(p)", "dyn/cm2");
  for (int k = 0; k <= 2 * rows_a_beat; ++k) {
    observables::Sample row;
    row.time = k * step;
    row.pressure = mean + amplitude * std::cos(angle(row.time));
    row.outflow = 1 + 0.1 * row.time;
    for (int p = 0; p < observables::wall_points; ++p)
      row.wall[p].von_mises = (p == 2 ? 3 : 1) * row.pressure;
    const double in_beat = std::fmod(row.time, period);
    row.wall[1].recruitment = in_beat > 0.2 && in_beat < 0.5 ? 1 : 0;
    observables::append(result.observables, row);
    result.sensitivities[0].values.push_back(row.time);
    result.sensitivities[1].values.push_back(std::cos(angle(row.time)));
    result.sensitivities[2].values.push_back(amplitude * std::sin(angle(row.time)));
  }
  result.events = observables::event_table();
  result.event_sensitivities = observables::event_table();
  result.event_sensitivities.add("d(time)/d(a)", "s");
  for (const double time : {0.2, 0.5, 1.0, 1.3}) {
    const observables::Event event{time, 2, 1, time == 0.2 || time == 1.0};
    observables::append(result.events, event);
    observables::append(result.event_sensitivities, event);
    result.event_sensitivities[4].values.push_back(10 * time);
  }
  return result;
}

observables::Beat last_beat() {
  return {period, period, rows_a_beat, 2 * rows_a_beat, true};
}

double value(const std::string& name) {
  return run::answer_of(known_result(), last_beat(), {{run::parse_quantity(name)}, {}}).values[0];
}

std::vector<double> gradient(const std::string& name) {
  return run::answer_of(known_result(), last_beat(), {{run::parse_quantity(name)}, {"a", "p"}}).gradients[0];
}

}  // namespace

// The parabola through rows a distance h apart misses the vertex of a cosine of angular frequency w by less
// than (w h)^2 / 8 of an amplitude in height were it a row, and far less as a vertex: 1e-9 leaves room.
TEST(Quantities, OfAKnownBeat) {
  EXPECT_NEAR(value("pressure.max"), mean + amplitude, 1e-9);
  EXPECT_NEAR(value("pressure.min"), mean - amplitude, 1e-9);
  EXPECT_NEAR(value("pressure.change"), 2 * amplitude, 2e-9);
  EXPECT_NEAR(value("pressure.mean"), mean, 1e-12);
  const double top = phase * period / (2 * std::numbers::pi);
  EXPECT_NEAR(value("pressure.time_of_max"), top, 1e-8);
  EXPECT_NEAR(value("pressure.time_of_min"), top + period / 2, 1e-8);
  EXPECT_NEAR(value("pressure.drift"), 0, 1e-12);
  EXPECT_NEAR(value("outflow.drift"), 0.1 * period, 1e-12);
  // An extreme at an end of the beat.
  EXPECT_NEAR(value("outflow.max"), 1.16, 1e-12);
  EXPECT_EQ(value("outflow.time_of_max"), period);
}

TEST(Quantities, OfRecruitmentComeFromItsEvents) {
  EXPECT_NEAR(value("recruitment.P2.share"), 0.3 / period, 1e-12);
  EXPECT_NEAR(value("recruitment.P2.on"), 0.2, 1e-12);
  EXPECT_NEAR(value("recruitment.P2.off"), 0.5, 1e-12);
  EXPECT_TRUE(observables::is_none(value("recruitment.P1.on")));
  EXPECT_NEAR(gradient("recruitment.P2.on")[0], 10, 1e-12);
  EXPECT_NEAR(gradient("recruitment.P2.off")[0], 13, 1e-12);
}

TEST(Quantities, OverAllPoints) {
  EXPECT_NEAR(value("von_mises.max"), 3 * (mean + amplitude), 1e-8);
  EXPECT_EQ(value("von_mises.max_place"), 3);
}

TEST(Quantities, SayWhetherTheBeatRepeatsItself) {
  // The outflow rises by 0.08 of at most 1.16.
  EXPECT_EQ(value("beat.periodic"), 0);
  Result still = known_result();
  for (double& flow : still.observables[2].values) flow = 1;
  EXPECT_EQ(run::answer_of(still, last_beat(), {{run::parse_quantity("beat.periodic")}, {}}).values[0], 1);
}

TEST(Quantities, HaveTheDerivativesOfTheirBeat) {
  EXPECT_NEAR(gradient("pressure.max")[0], 1, 1e-9);
  // A parabola through a sine is off by at most 0.064 (w h)^3 of its amplitude, 6e-8.
  EXPECT_NEAR(gradient("pressure.max")[1], 0, 1e-7);
  EXPECT_NEAR(gradient("pressure.min")[0], -1, 1e-9);
  EXPECT_NEAR(gradient("pressure.change")[0], 2, 2e-9);
  EXPECT_NEAR(gradient("pressure.mean")[0], 0, 1e-12);
  // The parabola's second derivative is off by (w h)^2 / 12 of itself, 5e-6.
  EXPECT_NEAR(gradient("pressure.time_of_max")[0], 0, 1e-6);
  EXPECT_NEAR(gradient("pressure.time_of_max")[1], period / (2 * std::numbers::pi), 1e-5 * period);
  EXPECT_TRUE(observables::is_none(gradient("outflow.max")[0])) << "without sensitivities";
}

TEST(Quantities, AreReadByTheirNames) {
  for (const Quantity& quantity : run::known_quantities()) {
    const Quantity read = run::parse_quantity(quantity.name());
    EXPECT_EQ(read.observable, quantity.observable);
    EXPECT_EQ(read.statistic, quantity.statistic);
    EXPECT_FALSE(quantity.unit().empty());
  }
  EXPECT_EQ(run::parse_quantity("fiber_angle.P1.change").unit(), "deg");
  EXPECT_EQ(run::parse_quantity("von_mises.max").unit(), "dyn/cm2");
  try {
    run::parse_quantity("presure.max");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "\"presure.max\" is not a quantity; did you mean pressure.max?");
  }
}
