// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/inlet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/units.hpp"
#include "tests/support/lumped_runs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

using test_support::column;
using test_support::run_lumped;
using test_support::scene_with;

// The extremes of the carotid's flow over its mean, from its series (Baek et al. 2010): DESIGN,
// section 2, has the peak at 0.2112 s.
TEST(LumpedWaveform, CarotidHasItsPeakAndItsTrough) {
  const auto inlet = inlet_from_scene(scene_with({"time.ramp=0"}));
  double greatest = 0, least = 10, at_greatest = 0, at_least = 0, sum = 0;
  constexpr int samples = 80000;
  for (int k = 0; k < samples; ++k) {
    const double t = 0.8 * k / samples, value = inlet.shape_at(t);
    sum += value;
    if (value > greatest) greatest = value, at_greatest = t;
    if (value < least) least = value, at_least = t;
  }
  EXPECT_NEAR(greatest, 1.4354, 5e-5);
  EXPECT_NEAR(at_greatest, 0.2112, 5e-5);
  EXPECT_NEAR(least, 0.7723, 5e-5);
  EXPECT_NEAR(at_least, 0.018, 5e-4);
  EXPECT_NEAR(sum / samples, 1, 1e-12);
  EXPECT_NEAR(inlet.shape_at(0.3), inlet.shape_at(0.3 + 7 * 0.8), 1e-12);
  EXPECT_FALSE(inlet.is_pressure);
  EXPECT_EQ(inlet.scale_key, "inlet.flow");
}

TEST(LumpedWaveform, RampGrowsFromRestWithoutCorners) {
  const auto ramped = inlet_from_scene(scene_with({"time.ramp=0.05"}));
  const auto plain = inlet_from_scene(scene_with({"time.ramp=0"}));
  EXPECT_EQ(ramped.shape_at(0), 0);
  EXPECT_NEAR(ramped.shape_at(0.025), 0.5 * plain.shape_at(0.025), 1e-14);
  EXPECT_EQ(ramped.shape_at(0.05), plain.shape_at(0.05));
  const double h = 1e-6;
  EXPECT_NEAR(ramped.shape_at(h) / h, 0, 1e-2) << "no jump of the slope at the start";
  const auto periodic = inlet_from_scene(scene_with({"time.ramp=0.05", "time.start=periodic"}));
  EXPECT_EQ(periodic.shape_at(0.01), plain.shape_at(0.01)) << "a periodic start has no ramp";
}

// A natural test of the spline: its own waveform, sampled. Steps of 1 ms: (2 pi 7/800)^4/384 = 2e-8 of
// the seventh harmonic.
TEST(LumpedWaveform, SampledCarotidGivesTheSameRun) {
  const auto inlet = inlet_from_scene(scene_with({"time.ramp=0"}));
  const double mean = 255.0 / 60 * std::pow(0.033 / 0.195, 2);
  const test_support::TemporaryFolder folder;
  {
    std::ofstream file(folder.path() / "carotid.csv");
    file << "time[ms],flow[ml/s]\n";
    for (int k = 0; k <= 800; ++k)
      file << fmt::format("{},{:.17g}\n", k, mean * inlet.shape_at(1e-3 * (k % 800)));
  }
  const Result built_in = run_lumped({"accuracy.tolerance=1e-8"});
  const Result sampled = run_lumped({"accuracy.tolerance=1e-8", "inlet.waveform=carotid.csv"}, folder.path());
  for (const char* name : {"inflow", "outflow", "pressure", "transmural_pressure", "radial_displacement.P1",
                           "fiber_angle.P2", "von_mises.P3"}) {
    const auto &a = column(built_in.observables, name), &b = column(sampled.observables, name);
    ASSERT_EQ(a.size(), b.size());
    const double range = test_support::range(a);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-6 * range) << name << " row " << k;
  }
}

TEST(LumpedWaveform, PressureFromAFile) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.path() / "p.csv") << "time[s],pressure[mmHg]\n0,80\n0.1,120\n0.3,100\n0.5,80\n";
  const auto inlet = inlet_from_scene(scene_with({"inlet.waveform=p.csv", "time.ramp=0"}, folder.path()));
  EXPECT_TRUE(inlet.is_pressure);
  EXPECT_EQ(inlet.period, 0.5);
  EXPECT_EQ(inlet.scale_key, "");
  EXPECT_NEAR(inlet.shape_at(0.1), 120 * mmhg, 1e-6);
  EXPECT_NEAR(inlet.shape_at(1.3), 100 * mmhg, 1e-6);
}

// A published inflow whose diastole without flow is told by its two ends: blood never flows back, and no step
// passes over an ejection, however quiet it was before.
TEST(LumpedWaveform, EjectionThenNothing) {
  const test_support::TemporaryFolder folder;
  {
    std::ofstream file(folder.path() / "ejection.csv");
    file << "time[s],flow[ml/s]\n";
    for (int k = 0; k < 15; ++k)
      file << fmt::format("{:.2f},{:.6f}\n", 0.02 * k, 400 * std::sin(M_PI * k / 15));
    file << "0.30,0.000000\n1.00,0\n";
  }
  const Result run = run_lumped(
      {"inlet.waveform=ejection.csv", "geometry.radius=1.2", "geometry.thickness=0.2", "geometry.length=5",
       "outlet.kind=rcr", "outlet.proximal_resistance=100", "outlet.resistance=1650",
       "outlet.compliance=1e-3", "time.start=periodic", "time.beats=3", "output.field_interval=0"},
      folder.path());
  const auto &inflow = column(run.observables, "inflow"), &pressure = column(run.observables, "pressure");
  EXPECT_EQ(*std::min_element(inflow.begin(), inflow.end()), 0);
  EXPECT_NEAR(*std::max_element(inflow.begin(), inflow.end()), 400, 0.1);
  // 400 x 2/pi x 0.3 ml in a beat, but for the corners at both ends of the ejection, which the curve rounds
  // off.
  EXPECT_NEAR(test_support::integral(inflow, inflow.size() - 1001, 1e-3), 240 / M_PI, 0.3);
  for (std::size_t k = 0; k + 1000 < pressure.size(); ++k)
    EXPECT_NEAR(pressure[k + 1000], pressure[k], 1e-6 * pressure[k]) << k;
}

// The artery forgets a pulse of 3 ms within some 0.1 s, so that all beats are alike. Nothing happens between
// pulses: steps are as long as they may be when the next one comes.
TEST(LumpedWaveform, EveryPulseIsMet) {
  for (const char* start : {"rest", "periodic"}) {
    SCOPED_TRACE(start);
    const Result run =
        run_lumped({std::string("time.start=") + start, "wall.law=EXP1", "inlet.waveform=pulse",
                    "inlet.pressure='10 mmHg'", "inlet.period=1", "inlet.duration=0.003",
                    "outlet.resistance=1e5", "time.beats=3", "time.ramp=0",
                    "sensitivity.parameters=['inlet.pressure']", "accuracy.tolerance=1e-6"});
    const auto& time = column(run.observables, "time");
    for (const char* name : {"pressure", "outflow"}) {
      const auto& values = column(run.observables, name);
      const auto& derivatives = column(run.sensitivities, fmt::format("d({})/d(inlet.pressure)", name));
      const double greatest = *std::max_element(values.begin(), values.end());
      const double steepest = *std::max_element(derivatives.begin(), derivatives.end());
      EXPECT_GT(greatest, 0);
      for (std::size_t k = 0; k + 1000 < time.size(); ++k) {
        EXPECT_NEAR(values[k + 1000], values[k], 1e-6 * greatest) << name << " at " << time[k];
        EXPECT_NEAR(derivatives[k + 1000], derivatives[k], 1e-5 * steepest) << name << " at " << time[k];
      }
    }
  }
}

}  // namespace
}  // namespace tunica
