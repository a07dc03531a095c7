// SPDX-License-Identifier: GPL-3.0-or-later
// Balances and waves of the 0D tier with the real, nonlinear wall.
#include <fmt/format.h>

#include <fstream>

#include "core/error.hpp"
#include "core/radial/wall_curve.hpp"
#include "core/units.hpp"
#include "tests/support/lumped_runs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

using test_support::column;
using test_support::joined;
using test_support::run_lumped;

constexpr double pi = 3.14159265358979323846;
constexpr double inner = 0.033, length = 0.66;

// What flows in and not out is in the lumen: pi R0^2 L (s^2 - 1), s from the displacement of P1.
TEST(LumpedNetwork, MassIsConserved) {
  for (const char* law : test_support::paper_laws) {
    for (const char* outlet : {"resistance", "rcr"}) {
      SCOPED_TRACE(testing::Message() << law << ", " << outlet);
      const Result result = run_lumped({std::string("wall.law=") + law, std::string("outlet.kind=") + outlet,
                                        "accuracy.tolerance=1e-8", "output.interval=5e-4"});
      const auto& in = column(result.observables, "inflow");
      const auto& out = column(result.observables, "outflow");
      const auto& u = column(result.observables, "radial_displacement.P1");
      std::vector<double> net(in.size());
      for (std::size_t k = 0; k < in.size(); ++k) net[k] = in[k] - out[k];
      const auto volume = [&](std::size_t row) {
        const double s = 1 + u[row] / inner;
        return pi * inner * inner * length * s * s;
      };
      // The outflow bends at recruitment and where the ramp ends, which costs Simpson's rule its order:
      // 1e-6 of a stroke volume of 0.097 cm3.
      const std::size_t second = (in.size() - 1) / 2;
      EXPECT_NEAR(test_support::integral(net, 0, 5e-4), volume(in.size() - 1) - volume(0), 1e-7);
      EXPECT_NEAR(test_support::integral(net, second, 5e-4), volume(in.size() - 1) - volume(second), 1e-7);
    }
  }
}

// Before the loads grow nothing moves, so that there is no blow from the vessels beyond; later they are all
// there: under steady flow the outlet's pressure is that beyond plus R Q.
TEST(LumpedNetwork, ThePressureBeyondTheOutletGrowsWithTheInlet) {
  constexpr double beyond = 40 * mmhg;
  for (const char* outlet : {"resistance", "rcr"}) {
    const Result result = run_lumped({std::string("outlet.kind=") + outlet, "outlet.pressure=40 mmHg",
                                      "inlet.waveform=constant", "inlet.flow=0.05", "time.beats=6"});
    const auto& pressure = column(result.observables, "outlet_pressure");
    // The wall's curve has its zero to round-off of its stiffness.
    EXPECT_NEAR(pressure.front() / beyond, 0, 1e-5);
    EXPECT_NEAR(column(result.observables, "outflow").front() / 0.05, 0, 1e-4);
    const double resistance = 1.032e6 + (std::string(outlet) == "rcr" ? 1e5 : 0);
    // Six beats of 0.8 s are some hundred time constants R C = 0.03 s.
    EXPECT_NEAR(pressure.back() / (beyond + resistance * 0.05), 1, 1e-6);
  }
}

TEST(LumpedNetwork, OutflowOfABeatIsTheInflowOnTheLimitCycle) {
  for (const int compartments : {1, 3}) {
    const Result result =
        run_lumped({"time.start=periodic", "time.beats=1", "accuracy.tolerance=1e-6",
                    fmt::format("lumped.compartments={}", compartments), "lumped.inertance=true"});
    const auto& in = column(result.observables, "inflow");
    const double inflow = test_support::integral(in, 0, 1e-3);
    EXPECT_NEAR(test_support::integral(column(result.observables, "outflow"), 0, 1e-3) / inflow, 1, 1e-6);
    EXPECT_NEAR(inflow / 0.8, 255.0 / 60 * std::pow(inner / 0.195, 2), 1e-9) << "the carotid's flow by area";
  }
}

// The equations of one compartment and an rcr outlet, integrated by the classical method of
// Runge and Kutta with small equal steps.
TEST(LumpedNetwork, RcrAgreesWithAnotherIntegration) {
  const Result result = run_lumped({"outlet.kind=rcr", "outlet.proximal_resistance=2e5",
                                    "outlet.resistance=8e5", "outlet.compliance=3e-8", "outlet.pressure=5e3",
                                    "inlet.waveform=constant", "inlet.flow=0.1", "time.ramp=0.1",
                                    "time.beats=1", "wall.law=EXP1", "accuracy.tolerance=1e-9"});
  const radial::WallCurve curve(test_support::model_with({"wall.law=EXP1"}), {});
  const auto rate = [&](double t, const std::array<double, 2>& y) {
    const double s = std::sqrt(y[0]), r = inner * s;
    const double growth = t < 0.1 ? 0.5 * (1 - std::cos(pi * t / 0.1)) : 1.0, inflow = 0.1 * growth;
    // Half the artery's Poiseuille resistance lies between its middle and the outlet.
    const double half = 4 * 0.035 * length / (pi * r * r * r * r);
    const double outflow = (curve.pressure(s) - y[1]) / (half + 2e5);
    return std::array{(inflow - outflow) / (pi * inner * inner * length),
                      (outflow - (y[1] - growth * 5e3) / 8e5) / 3e-8};
  };
  std::array<double, 2> y{1, 0};
  const double h = 1e-5;
  const auto& pressure = column(result.observables, "pressure");
  double worst = 0;
  for (int step = 0; step < 80000; ++step) {
    if (step % 1000 == 0)
      worst = std::max(worst, std::abs(pressure[step / 100] - curve.pressure(std::sqrt(y[0]))));
    const double t = h * step;
    const auto shifted = [&](const std::array<double, 2>& k, double by) {
      return std::array{y[0] + by * k[0], y[1] + by * k[1]};
    };
    const auto k1 = rate(t, y), k2 = rate(t + h / 2, shifted(k1, h / 2)),
               k3 = rate(t + h / 2, shifted(k2, h / 2)), k4 = rate(t + h, shifted(k3, h));
    for (int i = 0; i < 2; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  // 1e-7 of the pressure: hundreds of steps of 1e-11 each, stiffened by the slope of the wall.
  EXPECT_LT(worst, 1e-7 * 1e5);
}

TEST(LumpedNetwork, InertanceLeavesTheSteadyStateAlone) {
  const std::vector<std::string> steady{"inlet.waveform=constant", "inlet.flow=0.1217", "time.beats=2",
                                        "accuracy.tolerance=1e-8", "lumped.compartments=4"};
  const Result with = run_lumped(joined(steady, {"lumped.inertance=true"}));
  const Result without = run_lumped(joined(steady, {"lumped.inertance=false"}));
  for (const char* name :
       {"pressure", "outflow", "outlet_pressure", "radial_displacement.P4", "von_mises.P2"})
    EXPECT_NEAR(column(with.observables, name).back() / column(without.observables, name).back(), 1, 1e-7)
        << name;
}

// A wave of small amplitude in a matched artery: it arrives after L/c with c^2 = (A/rho') dp/dA, and
// rho' = 4/3 rho, since a parabolic profile carries its momentum so. Without the factor the delay
// would be 13 % shorter. 16 compartments
// and a wave of 7 transit times resolve it to some 1e-4; after 10 periods the start is forgotten.
TEST(LumpedNetwork, WavesTravelAtTheirSpeed) {
  const double period = 0.01, mean_pressure = 1e5;
  const radial::WallCurve curve(test_support::model_with({"wall.law=EXP1"}), {});
  const double s = curve.stretch_at(mean_pressure);
  const double area = pi * inner * inner * s * s;
  const double dp_da = curve.pressure_slope(s) / (2 * pi * inner * inner * s);
  const double density = 4.0 / 3, speed = std::sqrt(area / density * dp_da);
  const double impedance = density * speed / area;

  const test_support::TemporaryFolder folder;
  {
    std::ofstream file(folder.path() / "wave.csv");
    file << "time[s],flow[cm3/s]\n";
    for (int k = 0; k <= 200; ++k)
      file << fmt::format("{:.17g},{:.17g}\n", period * k / 200, 5e-3 * std::cos(2 * pi * k / 200));
  }
  const Result result =
      run_lumped({"wall.law=EXP1", "inlet.waveform=wave.csv", "blood.viscosity=0", "lumped.inertance=true",
                  "lumped.compartments=16", fmt::format("outlet.resistance={:.17g}", impedance),
                  "outlet.pressure=1e5", "time.ramp=0", "time.beats=10", "output.interval=5e-5",
                  "output.profile_times=[]", "accuracy.tolerance=1e-6"},
                 folder.path());
  const std::size_t last = result.observables.rows() - 201;  // one period
  const auto in = test_support::harmonic(column(result.observables, "inflow"), last);
  const auto out = test_support::harmonic(column(result.observables, "outflow"), last);
  const double delay = (out.phase() - in.phase()) * period / (2 * pi);
  EXPECT_NEAR(delay / (length / speed), 1, 5e-3) << "speed " << speed << " cm/s";
  EXPECT_NEAR(out.amplitude() / in.amplitude(), 1, 5e-3) << "a matched end does not reflect";
  // The scales of the paper's cylinder (DESIGN, section 2): 400 to 490 cm/s without the factor 4/3.
  EXPECT_GT(speed * std::sqrt(density), 300);
  EXPECT_LT(speed * std::sqrt(density), 700);
}

TEST(LumpedNetwork, MoreCompartmentsConverge) {
  const auto peak = [](int compartments) {
    const Result result = run_lumped({fmt::format("lumped.compartments={}", compartments), "time.beats=1",
                                      "accuracy.tolerance=1e-8", "wall.law=EXP1"});
    const auto& p = column(result.observables, "pressure");
    return *std::max_element(p.begin(), p.end());
  };
  // Compartments are cells with their pressure in the middle: second order, a factor 4 per doubling
  // (odd numbers have the middle of the artery in the middle of a cell).
  const double coarse = peak(3), medium = peak(6), fine = peak(12), finest = peak(24);
  EXPECT_NEAR((coarse - medium) / (medium - fine), 4, 1.5);
  EXPECT_NEAR((medium - fine) / (fine - finest), 4, 1.5);
  EXPECT_LT(std::abs(fine - finest), 1e-4 * finest);
}

TEST(LumpedNetwork, PressureAtTheInletDrivesTheFlow) {
  const Result result = run_lumped({"inlet.waveform=pressure", "inlet.pressure=100 mmHg", "time.ramp=0.05",
                                    "time.beats=1", "lumped.compartments=3", "accuracy.tolerance=1e-8"});
  const auto& inflow = column(result.observables, "inflow");
  const double flow = column(result.observables, "outflow").back();
  EXPECT_NEAR(inflow.back() / flow, 1, 1e-7);
  const double radius = inner + column(result.observables, "radial_displacement.P1").back();
  const double poiseuille = 8 * 0.035 * length / (pi * std::pow(radius, 4));
  // The lumen narrows a little along the artery: its middle stands for its mean to some 1e-4 of 1 %.
  EXPECT_NEAR(flow * (1.032e6 + poiseuille) / (100 * mmhg), 1, 1e-5);
  EXPECT_NEAR(column(result.observables, "pressure").back() / (100 * mmhg), 1 - 0.5 * poiseuille / 1.032e6,
              2e-4);
  EXPECT_GT(*std::max_element(inflow.begin(), inflow.end()), 1.2 * flow) << "filling the lumen takes flow";
}

TEST(LumpedNetwork, WithoutAnyResistanceIsRefused) {
  const auto prepare = [](const std::vector<std::string>& overrides) {
    const Scene scene = test_support::scene_with(overrides);
    lumped::LumpedTier().prepare(scene);
  };
  EXPECT_THROW(prepare({"blood.viscosity=0", "lumped.compartments=2"}), InvalidInput);
  EXPECT_THROW(prepare({"blood.viscosity=0", "outlet.resistance=0"}), InvalidInput);
  EXPECT_THROW(prepare({"outlet.kind=rcr", "outlet.resistance=0"}), InvalidInput);
  EXPECT_THROW(prepare({"output.profile_times=[0.9]"}), InvalidInput);
  EXPECT_THROW(prepare({"sensitivity.parameters=['wall.density']"}), InvalidInput);
  EXPECT_NO_THROW(prepare({"blood.viscosity=0", "lumped.compartments=2", "lumped.inertance=true"}));
}

}  // namespace
}  // namespace tunica
