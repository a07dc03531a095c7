// SPDX-License-Identifier: GPL-3.0-or-later
// The start from the steady state of the inlet's value at time 0.
#include <fmt/format.h>

#include <functional>
#include <iostream>
#include <numbers>

#include "core/error.hpp"
#include "lumped/network.hpp"
#include "lumped/steady_state.hpp"
#include "tests/support/lumped_runs.hpp"

namespace tunica {
namespace {

using test_support::column;
using test_support::joined;
using test_support::run_lumped;
using test_support::scene_with;

constexpr double length = 0.66;

struct NetworkCase {
  const char* name;
  std::vector<std::string> overrides;
  bool is_pressure = false;
};

std::ostream& operator<<(std::ostream& out, const NetworkCase& network) {
  return out << network.name;
}

class StaticStart : public testing::TestWithParam<NetworkCase> {
 protected:
  std::vector<std::string> scene(const std::vector<std::string>& more) const {
    return joined(joined({"time.start=static", "accuracy.tolerance=1e-8"}, GetParam().overrides), more);
  }
};

INSTANTIATE_TEST_SUITE_P(
    Lumped, StaticStart,
    testing::Values(
        NetworkCase{"one", {}}, NetworkCase{"exp2", {"wall.law=EXP2"}},
        NetworkCase{"chain", {"lumped.compartments=40"}},
        NetworkCase{"inertance", {"lumped.compartments=3", "lumped.inertance=true"}},
        NetworkCase{"rcr", {"outlet.kind=rcr", "outlet.pressure=5000"}},
        // A Windkessel that takes ten times the beat to charge.
        NetworkCase{
            "slow_rcr",
            {"outlet.kind=rcr", "outlet.compliance=8e-6", "lumped.compartments=2", "lumped.inertance=true"}},
        // Poiseuille's loss is most of the pressure.
        NetworkCase{"viscous", {"blood.viscosity=2", "outlet.resistance=2e5", "lumped.compartments=10"}},
        NetworkCase{"pressure",
                    {"inlet.waveform=pressure", "inlet.pressure='100 mmHg'", "lumped.compartments=4"},
                    true},
        NetworkCase{"pressure_rcr_inertance",
                    {"inlet.waveform=pressure", "inlet.pressure='100 mmHg'", "lumped.compartments=3",
                     "outlet.kind=rcr", "lumped.inertance=true"},
                    true}),
    [](const auto& instance) { return std::string(instance.param.name); });

// The equations of steady flow, written down anew: one flow through all, Poiseuille's law from compartment
// to compartment, the outlet's resistances in series, and the ring at each compartment's pressure.
TEST_P(StaticStart, IsSteadyFlow) {
  // Two compartments at least, so that compartments.csv is written.
  std::vector<std::string> more{"time.beats=1"};
  const bool single = scene_with(scene(more)).integer("lumped.compartments") == 1;
  if (single) more.emplace_back("lumped.compartments=2");
  const Scene given = scene_with(scene(more));
  const Result run = run_lumped(given);
  const auto count = static_cast<int>(given.integer("lumped.compartments"));
  const auto first = [&](const char* name) { return column(run.observables, name)[0]; };
  const auto at = [&](const char* name, int i) {
    return column(run.compartments, fmt::format("{}.C{}", name, i))[0];
  };

  const double flow = first("inflow");
  if (!GetParam().is_pressure) {
    EXPECT_NEAR(flow, given.number("inlet.flow") * inlet_from_scene(given).shape_at(0), 1e-12 * flow);
  }
  EXPECT_GT(flow, 0);
  EXPECT_NEAR(first("outflow"), flow, 1e-9 * flow);
  double outlet = given.number("outlet.resistance");
  if (given.text("outlet.kind") == "rcr") outlet += given.number("outlet.proximal_resistance");
  double pressure = given.number("outlet.pressure") + outlet * flow;
  EXPECT_NEAR(first("outlet_pressure"), pressure, 1e-9 * pressure);

  const radial::WallCurve curve(test_support::model_with(GetParam().overrides), {0.0});
  const double half = length / (2 * count), mu = given.number("blood.viscosity");
  const auto loss = [&](int i) {
    return 8 * mu * half * flow / (std::numbers::pi * std::pow(at("lumen_radius", i), 4));
  };
  for (int i = count; i >= 1; --i) {
    pressure += loss(i);
    EXPECT_NEAR(at("pressure", i), pressure, 1e-9 * pressure) << i;
    EXPECT_NEAR(at("lumen_radius", i), 0.033 * curve.stretch_at(pressure), 1e-9) << i;
    EXPECT_NEAR(at("outflow", i), flow, 1e-9 * flow) << i;
    pressure += loss(i);
  }
  if (GetParam().is_pressure) {
    EXPECT_NEAR(pressure, given.number("inlet.pressure"), 1e-9 * pressure);
  }
}

lumped::System system_of(const lumped::Network& network) {
  lumped::System system;
  system.unknowns = network.unknowns();
  system.bandwidth = network.bandwidth();
  system.scales = network.scales();
  system.magnitudes = [&](const double* y, double* result) { network.magnitudes(y, result); };
  system.rate = [&](double t, const double* y, double* rate) { network.rate(t, y, rate); };
  system.rate_derivative = [&](double t, const double* y, const double* dy, int k, double* result) {
    network.rate_derivative(t, y, dy, k, result);
  };
  return system;
}

lumped::SteadyState start_of(const lumped::Network& network) {
  std::vector<lumped::Sensitivity> parameters;
  for (int k = 0; k < network.parameters(); ++k) parameters.push_back({k, 1.0});
  return lumped::find_steady_state(system_of(network), network.rest(), 0, network.inlet().period, parameters);
}

// Rates of the state relative to that of an empty artery being filled.
TEST_P(StaticStart, HasNoRates) {
  const lumped::Network network(scene_with(scene({})), {});
  const lumped::SteadyState steady = start_of(network);
  const std::vector<double> scales = network.scales();
  std::vector<double> filling(network.unknowns()), rates(network.unknowns());
  network.rate(0, network.rest().data(), filling.data());
  network.rate(0, steady.state.data(), rates.data());
  double greatest = 0, remaining = 0;
  for (int i = 0; i < network.unknowns(); ++i) {
    greatest = std::max(greatest, std::abs(filling[i]) / scales[i]);
    remaining = std::max(remaining, std::abs(rates[i]) / scales[i]);
  }
  std::cout << GetParam().name << ": rates fall by " << remaining / greatest << ", "
            << steady.statistics.steps << " steps, " << steady.statistics.newton_iterations
            << " Newton iterations\n";
  // Round-off of differences between pressures of neighbours, whose Poiseuille resistance is small.
  EXPECT_LT(remaining, 1e-9 * greatest);
}

// Against differences of sixth order between starts. A step of 0.1 % leaves 1e-18 of the seventh derivative
// out and divides round-off, relative to the unknown's scale, by itself.
TEST_P(StaticStart, HasDerivatives) {
  const Scene given = scene_with(scene({}));
  std::vector<std::string> keys{"outlet.resistance", "tether.stiffness",   "wall.bulk_modulus",
                                "geometry.radius",   "geometry.thickness", "geometry.length",
                                "blood.viscosity"};
  if (given.text("wall.law") == "EXP1+EXP2-FS") keys.emplace_back("wall.activation_stretch");
  if (given.text("outlet.kind") == "rcr") keys.emplace_back("outlet.proximal_resistance");
  if (given.number("outlet.pressure") != 0) keys.emplace_back("outlet.pressure");
  keys.emplace_back(GetParam().is_pressure ? "inlet.pressure" : "inlet.flow");
  const lumped::Network network(given, keys);
  const lumped::SteadyState steady = start_of(network);
  double worst = 0;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const double value = given.number(keys[k]), step = 1e-3 * value;
    std::vector<std::vector<double>> at;
    for (const int steps : {-3, -2, -1, 1, 2, 3}) {
      const Scene changed = scene_with(scene({fmt::format("{}={:.17g}", keys[k], value + steps * step)}));
      at.push_back(start_of(lumped::Network(changed, {})).state);
    }
    for (int i = 0; i < network.unknowns(); ++i) {
      const double expected =
          (45 * (at[3][i] - at[2][i]) - 9 * (at[4][i] - at[1][i]) + at[5][i] - at[0][i]) / 60 / 1e-3;
      const double actual = steady.derivatives[k][i] * value;
      worst = std::max(worst, std::abs(actual - expected) / network.scales()[i]);
      EXPECT_NEAR(actual, expected, 1e-9 * network.scales()[i]) << keys[k] << ", unknown " << i;
    }
  }
  std::cout << GetParam().name << ": derivatives deviate by " << worst << "\n";
}

// Under a constant inlet nothing changes, and this is the limit cycle too.
TEST_P(StaticStart, StaysUnderAConstantInlet) {
  std::vector<std::string> more{"time.beats=2"};
  if (!GetParam().is_pressure) more.insert(more.end(), {"inlet.waveform=constant", "inlet.flow=0.1"});
  const Result run = run_lumped(scene(more));
  const Result cycle = run_lumped(joined(scene(more), {"time.start=periodic"}));
  for (const char* name : {"pressure", "outflow", "outlet_pressure", "radial_displacement.P1"}) {
    const auto &values = column(run.observables, name), &others = column(cycle.observables, name);
    const double size = std::abs(values[0]);
    EXPECT_LT(test_support::range(values), 1e-9 * size) << name;
    // The limit cycle is known to ten local errors of 1e-10, which the flow feels as pressure over
    // resistance.
    EXPECT_NEAR(others[0], values[0], 1e-7 * size) << name;
  }
}

TEST(LumpedStaticStart, HasNoRamp) {
  const Result run = run_lumped({"time.start=static", "time.beats=1"});
  const Inlet inlet = inlet_from_scene(scene_with({"time.start=periodic"}));
  const auto &time = column(run.observables, "time"), &inflow = column(run.observables, "inflow");
  const double scale = inflow[0] / inlet.shape_at(0);
  for (std::size_t k = 0; k < time.size(); ++k)
    EXPECT_NEAR(inflow[k], scale * inlet.shape_at(time[k]), 1e-12);
}

lumped::System scalar_system(const std::function<double(double y)>& rate,
                             const std::function<double(double y)>& slope) {
  lumped::System system;
  system.unknowns = 1;
  system.scales = {1};
  system.magnitudes = [](const double* y, double* result) { *result = 0.01 + std::abs(*y); };
  system.rate = [=](double, const double* y, double* result) { *result = rate(*y); };
  // Parameter 0 adds to the rate.
  system.rate_derivative = [=](double, const double* y, const double* dy, int k, double* result) {
    *result = slope(*y) * *dy + (k == 0 ? 1 : 0);
  };
  return system;
}

// Newton's method on arctan only converges within 1.4 of the zero: the approach must come so close first.
TEST(LumpedStaticStart, ApproachesFromAfar) {
  const auto system = scalar_system([](double y) { return -std::atan(y - 3); },
                                    [](double y) { return -1 / (1 + (y - 3) * (y - 3)); });
  const auto steady = lumped::find_steady_state(system, {100}, 0, 1, {{0, 1.0}});
  EXPECT_NEAR(steady.state[0], 3, 1e-14);
  EXPECT_NEAR(steady.derivatives[0][0], 1, 1e-14);
}

TEST(LumpedStaticStart, GivesUpWhereNothingIsSteady) {
  const auto system = scalar_system([](double) { return 1.0; }, [](double) { return 0.0; });
  EXPECT_THROW(lumped::find_steady_state(system, {0}, 0, 1, {}), SolverFailure);
}

// Neo-Hookean tissue has a limit pressure, which a flow of 1 cm3/s at the outlet's resistance is beyond.
TEST(LumpedStaticStart, GivesUpWhereTheWallCannotCarryTheLoad) {
  const Scene scene =
      scene_with({"time.start=static", "wall.law=neo-Hookean", "tether.stiffness=0", "inlet.flow=1"});
  const Result run = lumped::LumpedTier().prepare(scene)->execute({});
  EXPECT_FALSE(run.record.converged);
  EXPECT_NE(run.record.failure.find("at t = 0 s (beat 1): the wall has no equilibrium at"), std::string::npos)
      << run.record.failure;
}

}  // namespace
}  // namespace tunica
