// SPDX-License-Identifier: GPL-3.0-or-later
// Time of the paper's ring (EXP1+EXP2-FS): one equilibrium, the table of equilibria, one look-up in it.
#include <benchmark/benchmark.h>

#include <vector>

#include "core/radial/from_scene.hpp"
#include "core/radial/wall_curve.hpp"

namespace tunica {
namespace {

const std::vector<double> places{0, 1.0 / 3, 2.0 / 3, 1};

std::unique_ptr<const radial::RingModel> ring() {
  const Scene scene = parse_scene("[wall]\n", "benchmark.toml", ".");
  return radial::ring_model(scene, {});
}

/// At a lumen stretch below recruitment, and with a recruitment front within the wall.
void ring_respond(benchmark::State& state, double lumen_stretch) {
  const auto model = ring();
  for (auto _ : state) benchmark::DoNotOptimize(model->respond(lumen_stretch, places, false));
}
BENCHMARK_CAPTURE(ring_respond, below_recruitment, 1.2)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(ring_respond, recruiting, 1.6)->Unit(benchmark::kMicrosecond);

void wall_curve_built(benchmark::State& state) {
  long solves = 0;
  for (auto _ : state) {
    const radial::WallCurve curve(ring(), places);
    curve.prepare(1, 1.6);
    solves = curve.solves();
  }
  state.counters["equilibria"] = static_cast<double>(solves);
}
BENCHMARK(wall_curve_built)->Unit(benchmark::kMillisecond);

void wall_curve_pressure(benchmark::State& state) {
  const radial::WallCurve curve(ring(), places);
  curve.prepare(1, 1.6);
  double stretch = 1;
  for (auto _ : state) {
    stretch = stretch < 1.59 ? stretch + 1e-3 : 1.0;
    benchmark::DoNotOptimize(curve.pressure(stretch));
  }
}
BENCHMARK(wall_curve_pressure);

}  // namespace
}  // namespace tunica
