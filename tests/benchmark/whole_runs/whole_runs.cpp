// SPDX-License-Identifier: GPL-3.0-or-later
// whole_runs SCENE COUNT: processor time of whole 0D runs through the library, each read, prepared and
// executed, over the ranges that tools/bench-sweep sweeps. It uses nothing but what the library has had from
// its first commits.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "core/scene/scene.hpp"
#include "lumped/lumped_tier.hpp"

int main(int count, char** arguments) {
  if (count != 3) return 2;
  const int runs = std::atoi(arguments[2]);
  const std::clock_t start = std::clock();
  for (int k = 0; k < runs; ++k) {
    // An additive sequence fills the box evenly (Roberts' R3).
    const auto within = [k](double lower, double upper, double step) {
      return std::to_string(lower + (upper - lower) * std::fmod(0.5 + k * step, 1.0));
    };
    const tunica::Scene scene =
        tunica::read_scene(arguments[1], {"accuracy.tolerance=1e-3", "output.field_interval=0",
                                          "outlet.resistance=" + within(5e5, 2e6, 0.8191725134),
                                          "tether.stiffness=" + within(3e6, 3e7, 0.6710436067),
                                          "wall.activation_stretch=" + within(1.2, 1.7, 0.5497004779)});
    const tunica::Result result = tunica::lumped::LumpedTier().prepare(scene)->execute({});
    if (!result.record.converged) return 3;
  }
  std::printf("%.6g\n", static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / runs);
}
