// SPDX-License-Identifier: GPL-3.0-or-later
// Where a run of the 2D tier may begin: a steady state stays, and a limit cycle is the one that plain beats
// come to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/axisym_runs.hpp"

namespace tunica {
namespace {

using test_support::artery;
using test_support::run_axisym;
using test_support::values;

const char* const columns[] = {"outflow", "pressure", "outlet_pressure", "radial_displacement.P1",
                               "radial_displacement.P4"};
constexpr double period = 0.8;  // s

/// The rows of the last period, both ends included: 0.01 s apart.
std::vector<double> last_beat(const Result& result, const std::string& column) {
  const auto& all = values(result.observables, column);
  return {all.end() - 81, all.end()};
}

double range(const std::vector<double>& values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return *greatest - *least;
}

Scene beating(std::vector<std::string> overrides) {
  overrides.emplace_back("output.interval=0.01");
  return artery(overrides);
}

/// Greatest difference of two runs' last beats, relative to the range there, over the columns.
double difference(const Result& a, const Result& b) {
  double greatest = 0;
  for (const char* column : columns) {
    const auto x = last_beat(a, column), y = last_beat(b, column);
    for (std::size_t k = 0; k < x.size(); ++k)
      greatest = std::max(greatest, std::abs(x[k] - y[k]) / range(y));
  }
  return greatest;
}

/// Periods that the search for the limit cycle took.
int periods(const Result& result) {
  return result.record.resolution.at("periods_to_limit_cycle").get<int>();
}

class StaticStart : public testing::TestWithParam<std::string> {};

// Newton's method finds the steady state to 1e-5 of its tolerance in a step, which is 9e-6 here. What steps
// leave of theirs is a tenth of it, and is forgotten within a few R C.
TEST_P(StaticStart, Stays) {
  const Scene scene = beating({"wall.law=" + GetParam(), "inlet.waveform=constant", "time.start=static",
                               "time.beats=1", "accuracy.tolerance=0.003"});
  const Result result = run_axisym(scene);
  EXPECT_NEAR(values(result.observables, "inflow").front(), scene.number("inlet.flow"), 1e-9);
  for (const char* column : columns) {
    const auto& all = values(result.observables, column);
    for (const double value : all) ASSERT_NEAR(value / all.front(), 1, 1e-6) << column;
  }
}

INSTANTIATE_TEST_SUITE_P(, StaticStart, testing::Values("EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::erase_if(name, [](char c) { return c == '+' || c == '-'; });
                           return name;
                         });

TEST(StaticStarts, AreTheStaticStateOfTheFirstMoment) {
  const std::vector<std::string> cells{"mesh.wall_cells=3", "mesh.blood_cells=2", "mesh.axial_cells=16"};
  auto beats = cells, state = cells;
  beats.insert(beats.end(), {"time.start=static", "time.beats=1"});
  state.insert(state.end(), {"time.mode=static"});
  const Result begun = run_axisym(beating(beats)), still = run_axisym(artery(state));
  for (const char* column : columns)
    EXPECT_NEAR(values(begun.observables, column).front() / values(still.observables, column).front(), 1,
                1e-7)
        << column;
}

// The charge of the wall decays as exp(-t/RC), R C = 0.03 s: beat 10 from rest is periodic to rounding, and
// beat 2 all but. Runs differ by their steps' errors, which are to stay below the tolerance of 1 %; they are
// 0.1 %.
TEST(LimitCycle, OfTheDefaultCylinderIsBeat10) {
  const Result cycle = run_axisym(beating({"time.start=periodic", "time.beats=1"}));
  EXPECT_LE(periods(cycle), 3);
  EXPECT_LT(difference(cycle, run_axisym(beating({"time.beats=10"}))), 3e-3);
  for (const char* column : columns) {
    const auto beat = last_beat(cycle, column);
    EXPECT_NEAR((beat.back() - beat.front()) / range(beat), 0, 1e-3) << column;
  }
}

/// An outlet whose compliance holds R C = 2.8 s, three and a half periods.
std::vector<std::string> slow_outlet(std::vector<std::string> more) {
  more.insert(more.end(), {"outlet.kind=rcr", "outlet.proximal_resistance=1e5", "outlet.resistance=9.32e5",
                           "outlet.compliance=3e-6"});
  return more;
}

/// Mean pressure at the outlet over the last beat, relative to R times the mean flow: 1 for a limit cycle, as
/// the compliance then gives back what it takes.
double mean_of_ohm(const Result& result) {
  const auto mean = [](const std::vector<double>& v) {
    double sum = -0.5 * (v.front() + v.back());
    for (const double x : v) sum += x;
    return sum / static_cast<double>(v.size() - 1);
  };
  return mean(last_beat(result, "outlet_pressure")) / (1.032e6 * mean(last_beat(result, "inflow")));
}

TEST(LimitCycle, OfASlowOutletIsFoundInFewPeriods) {
  const Result cycle = run_axisym(beating(slow_outlet({"time.start=periodic", "time.beats=1"})));
  EXPECT_LE(periods(cycle), 8);
  // The range of the pressure is 6 % of its mean, the tolerance 1 % of that.
  EXPECT_NEAR(mean_of_ohm(cycle), 1, 6e-4);
  // Ten beats from rest still lack exp(-10/3.5) = 6 % of the charge; forty have it.
  EXPECT_LT(mean_of_ohm(run_axisym(beating(slow_outlet({"time.beats=10"})))), 0.95);
  EXPECT_LT(difference(cycle, run_axisym(beating(slow_outlet({"time.beats=40"})))), 1e-2);
}

// Under constant inflow the state under the mean load is the limit cycle, to Newton's tolerance in a step,
// 3e-5.
TEST(LimitCycle, OfConstantInflowIsTheSteadyState) {
  const Result cycle =
      run_axisym(beating({"inlet.waveform=constant", "time.start=periodic", "time.beats=1"}));
  EXPECT_LE(periods(cycle), 2);
  for (const char* column : columns) {
    const auto& all = values(cycle.observables, column);
    for (const double value : all) ASSERT_NEAR(value / all.front(), 1, 3e-5) << column;
  }
}

}  // namespace
}  // namespace tunica
