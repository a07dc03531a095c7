// SPDX-License-Identifier: GPL-3.0-or-later
// Forward sensitivities against central differences of whole runs.
#include <fmt/format.h>

#include <array>
#include <iostream>

#include "tests/support/lumped_runs.hpp"

namespace tunica {
namespace {

using test_support::column;
using test_support::joined;
using test_support::run_lumped;

struct Case {
  const char* key;
  const char* start;
};

/// A run with `key` changed from its value by a relative step.
struct Changed {
  std::vector<std::string> base;
  std::string key;
  double value, step;
  Result at(double steps) const {
    return run_lumped(joined(base, {fmt::format("{}={:.17g}", key, value + steps * step)}));
  }
};

/// Differences of sixth order with the relative step h, which leave h^6/140 of the seventh derivative out,
/// while the runs' own errors of some 1e-10 are divided by h.
struct Stencil {
  std::array<Result, 6> runs;  ///< at -3, -2, -1, 1, 2, 3 steps
  double step;
  template <class Value>
  double difference(Value&& of) const {
    return (45 * (of(runs[3]) - of(runs[2])) - 9 * (of(runs[4]) - of(runs[1])) + of(runs[5]) - of(runs[0])) /
           (60 * step);
  }
};

Stencil stencil(const Changed& changed) {
  return {{changed.at(-3), changed.at(-2), changed.at(-1), changed.at(1), changed.at(2), changed.at(3)},
          changed.step};
}

/// Relative step: wider for parameters that the results hardly depend on, for which the runs' own
/// errors would else be all that is seen.
double relative_step(std::string_view key) {
  if (key == "blood.viscosity" || key == "blood.density") return 0.3;
  if (key == "wall.bulk_modulus") return 0.06;
  if (key == "geometry.thickness") return 1e-2;
  // Points are recruited one after the other: between two the times are smooth.
  if (key == "wall.activation_stretch") return 5e-4;
  return 2e-3;
}

class Sensitivities : public testing::TestWithParam<Case> {
 protected:
  Sensitivities() {
    base_ = {std::string("time.start=") + GetParam().start, "accuracy.tolerance=1e-9",
             "output.interval=2e-3"};
    if (std::string_view(GetParam().key).starts_with("inlet."))
      base_ = joined(base_, {"inlet.flow=0.1217"});  // set, so that the radius does not scale it
    const Scene scene = test_support::scene_with(base_);
    value_ = scene.number(GetParam().key);
    // The outlet's pressure, 0 by default, is changed by steps of 300 dyn/cm2.
    changed_ = {base_, GetParam().key, value_,
                value_ != 0 ? relative_step(GetParam().key) * std::abs(value_) : 300};
  }
  std::vector<std::string> base_;
  double value_ = 0;
  Changed changed_;
};

// Sensitivities agree with central differences to 1e-5 of the column's largest magnitude; rows within 5 ms
// of an event, whose time itself moves, are left out.
TEST_P(Sensitivities, AgreeWithCentralDifferences) {
  const std::string key = GetParam().key;
  const Result result = run_lumped(joined(base_, {fmt::format("sensitivity.parameters=['{}']", key)}));
  const Stencil runs = stencil(changed_);
  const auto& time = column(result.observables, "time");
  const auto& events = column(result.events, "time");
  const auto near_event = [&](double t) {
    return std::any_of(events.begin(), events.end(), [&](double e) { return std::abs(e - t) < 5e-3; });
  };
  double worst = 0;
  std::string worst_column;
  int columns = 0;
  for (const auto& sensitivity : result.sensitivities.columns()) {
    if (sensitivity.name == "time") continue;
    const std::string quantity = sensitivity.name.substr(2, sensitivity.name.find(')') - 2);
    ASSERT_EQ(sensitivity.values.size(), time.size());
    double largest = 0, gap = 0;
    for (std::size_t k = 0; k < time.size(); ++k) {
      const double by_difference =
          runs.difference([&](const Result& run) { return column(run.observables, quantity)[k]; });
      largest = std::max(largest, std::abs(by_difference));
      if (!near_event(time[k])) gap = std::max(gap, std::abs(sensitivity.values[k] - by_difference));
    }
    // A column that does not depend on the parameter (the inflow, unless it is the parameter) is 0 but for
    // the runs' errors.
    const double scale = test_support::range(column(result.observables, quantity)) / changed_.step * 1e-3;
    if (largest < 1e-6 * scale) {
      EXPECT_LT(gap, 1e-6 * scale) << sensitivity.name;
      continue;
    }
    ++columns;
    EXPECT_LT(gap / largest, 1e-5) << sensitivity.name;
    if (gap / largest > worst) worst = gap / largest, worst_column = sensitivity.name;
  }
  EXPECT_GE(columns, 8);
  std::cout << key << ", start " << GetParam().start << ": largest deviation " << worst << " in "
            << worst_column << "\n";
}

TEST_P(Sensitivities, OfRecruitmentTimes) {
  const std::string key = GetParam().key;
  const Result result = run_lumped(joined(base_, {fmt::format("sensitivity.parameters=['{}']", key)}));
  const Stencil runs = stencil(changed_);
  const auto& derivative = column(result.event_sensitivities, fmt::format("d(time)/d({})", key));
  ASSERT_FALSE(derivative.empty());
  for (const Result& run : runs.runs)
    ASSERT_EQ(run.events.rows(), derivative.size()) << "the step changes which points are recruited";
  double largest = 0, gap = 0;
  for (std::size_t k = 0; k < derivative.size(); ++k) {
    const double by_difference =
        runs.difference([&](const Result& run) { return column(run.events, "time")[k]; });
    largest = std::max(largest, std::abs(by_difference));
    gap = std::max(gap, std::abs(derivative[k] - by_difference));
  }
  std::cout << key << ", start " << GetParam().start << ": recruitment times deviate by " << gap / largest
            << "\n";
  EXPECT_LT(gap / largest, 1e-5);

  const auto name = fmt::format("d(recruited_time)/d({})", key);
  const auto& total = column(result.recruited_time, name);
  const auto at = [&](const Result& run, std::size_t k) {
    return column(run.recruited_time, "recruited_time")[k];
  };
  double largest_total = 0, gap_total = 0;
  for (std::size_t k = 0; k < total.size(); ++k) {
    const double by_difference = runs.difference([&](const Result& run) { return at(run, k); });
    largest_total = std::max(largest_total, std::abs(by_difference));
    gap_total = std::max(gap_total, std::abs(total[k] - by_difference));
  }
  if (largest_total > 0) {
    EXPECT_LT(gap_total / largest_total, 1e-5) << name;
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* start : {"rest", "periodic"})
    for (const char* key :
         {"outlet.resistance", "tether.stiffness", "wall.activation_stretch", "wall.bulk_modulus",
          "geometry.thickness", "geometry.radius", "inlet.flow", "blood.viscosity", "outlet.pressure"})
      all.push_back({key, start});
  // The derivatives of the static start itself have their own test: these are carried on from there.
  for (const char* key : {"outlet.resistance", "wall.activation_stretch", "geometry.radius"})
    all.push_back({key, "static"});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Lumped, Sensitivities, testing::ValuesIn(cases()), [](const auto& instance) {
  std::string name = std::string(instance.param.key) + "_" + instance.param.start;
  for (char& c : name)
    if (c == '.') c = '_';
  return name;
});

/// Parameters that only other networks have. The wall has no fibres, so that no row is near an event.
void expect_sensitivities(const std::vector<std::string>& network, const std::vector<std::string>& keys) {
  const std::vector<std::string> base =
      joined({"wall.law=EXP1", "accuracy.tolerance=1e-9", "time.beats=1", "output.interval=5e-3"}, network);
  const Scene scene = test_support::scene_with(base);
  for (const auto& key : keys) {
    const Result result = run_lumped(joined(base, {fmt::format("sensitivity.parameters=['{}']", key)}));
    const double value = scene.number(key);
    const Stencil runs = stencil({base, key, value, std::max(0.02, relative_step(key)) * value});
    for (const char* quantity : {"pressure", "outflow", "radial_displacement.P2"}) {
      const auto& derivative = column(result.sensitivities, fmt::format("d({})/d({})", quantity, key));
      double largest = 0, gap = 0;
      for (std::size_t k = 0; k < derivative.size(); ++k) {
        const double by_difference =
            runs.difference([&](const Result& run) { return column(run.observables, quantity)[k]; });
        largest = std::max(largest, std::abs(by_difference));
        gap = std::max(gap, std::abs(derivative[k] - by_difference));
      }
      EXPECT_LT(gap / largest, 1e-5) << "d(" << quantity << ")/d(" << key << ")";
    }
  }
}

TEST(LumpedSensitivities, OfAChainWithAnRcrOutlet) {
  expect_sensitivities({"outlet.kind=rcr", "lumped.compartments=3"},
                       {"outlet.proximal_resistance", "outlet.resistance", "outlet.compliance",
                        "geometry.length", "wall.stiffness"});
}

TEST(LumpedSensitivities, OfInertance) {
  expect_sensitivities({"lumped.inertance=true"}, {"blood.density", "outlet.resistance"});
}

TEST(LumpedSensitivities, ColumnsCarryNamesAndUnits) {
  const Result result = run_lumped({"sensitivity.parameters=['outlet.resistance','wall.activation_stretch']",
                                    "time.beats=1", "output.interval=0.1"});
  const auto* pressure = result.sensitivities.find("d(pressure)/d(outlet.resistance)");
  ASSERT_TRUE(pressure);
  EXPECT_EQ(pressure->unit, "(dyn/cm2)/(dyn s/cm5)");
  EXPECT_EQ(result.sensitivities[0].name, "time");
  EXPECT_TRUE(result.sensitivities.find("d(fiber_angle.P4)/d(wall.activation_stretch)"));
  EXPECT_EQ(result.sensitivities.rows(), result.observables.rows());
}

TEST(LumpedSensitivities, DoNotChangeTheSolution) {
  const std::vector<std::string> base{"accuracy.tolerance=1e-8"};
  const Result with = run_lumped(joined(base, {"sensitivity.parameters=['tether.stiffness']"}));
  const Result without = run_lumped(base);
  for (const char* name : {"pressure", "outflow", "radial_displacement.P1", "von_mises.P1"}) {
    const auto &a = column(with.observables, name), &b = column(without.observables, name);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-6 * test_support::range(b)) << name;
  }
}

}  // namespace
}  // namespace tunica
