// SPDX-License-Identifier: GPL-3.0-or-later
// Time of one stress, and of one stress with its tangent, for every law of the catalog.
#include <benchmark/benchmark.h>

#include <array>
#include <string>

#include "core/frame.hpp"
#include "core/wall/catalog.hpp"
#include "core/wall/from_scene.hpp"

namespace tunica {
namespace {

const auto axes = frame::Radial::axes();

wall::Law<double> law_named(std::string_view name) {
  const Scene scene = parse_scene("[wall]\nlaw = \"" + std::string(name) + "\"\n", "benchmark.toml", ".");
  return wall::wall_from_scene(SeededScene<double>(scene)).front().law;
}

/// Deformations of a ring with fibres below, near and beyond recruitment, a little sheared so that no entry
/// is 0.
std::array<Tensor<double>, 64> deformations() {
  std::array<Tensor<double>, 64> all;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double stretch = 1.0 + 0.01 * static_cast<double>(k);
    all[k] = Tensor<double>::diagonal(0.99 / stretch - 1, stretch - 1, 0.01);
    for (double& entry : all[k].entries) entry += 1e-3;
  }
  return all;
}

void stress(benchmark::State& state, const wall::Law<double>& law) {
  const auto gradients = deformations();
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(wall::piola(law, gradients[k++ % gradients.size()], axes));
}

void stress_and_tangent(benchmark::State& state, const wall::Law<double>& law) {
  const auto gradients = deformations();
  std::size_t k = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(wall::stress_and_tangent(law, gradients[k++ % gradients.size()], axes));
}

/// As the ring needs it: the gradient diag(u', u/R, 0) and derivatives with respect to u and u'.
void radial_stress_and_tangent(benchmark::State& state, const wall::Law<double>& law) {
  using D = Dual<double, 2>;
  constexpr double radius = 0.038;
  double displacement = 0;
  for (auto _ : state) {
    displacement = displacement < 0.02 ? displacement + 3e-4 : 0.0;
    const auto gradient = frame::Radial::gradient(
        D::variable(displacement, 0), D::variable(-displacement / (radius + displacement), 1), D(radius));
    benchmark::DoNotOptimize(wall::piola(law, gradient, axes));
  }
}

const bool registered = [] {
  for (const wall::LawEntry& entry : wall::laws()) {
    const std::string name(entry.name);
    const auto law = law_named(entry.name);
    benchmark::RegisterBenchmark((name + "/stress").c_str(), stress, law);
    benchmark::RegisterBenchmark((name + "/stress+tangent 9x9").c_str(), stress_and_tangent, law);
    benchmark::RegisterBenchmark((name + "/radial stress+tangent 2x2").c_str(), radial_stress_and_tangent,
                                 law);
  }
  return true;
}();

}  // namespace
}  // namespace tunica
