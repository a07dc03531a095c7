// SPDX-License-Identifier: GPL-3.0-or-later
// Twelve walls of two hundred drawn at random that 0D once said to give way at pressures of 8 to 99 mmHg, or
// did not find the equilibria of: both tiers compute them.
#include <algorithm>
#include <iostream>

#include "lumped/lumped_tier.hpp"
#include "tests/support/axisym_runs.hpp"

namespace tunica {
namespace {

using test_support::values;

double greatest(const Result& run, const char* column) {
  const auto& all = values(run.observables, column);
  return *std::max_element(all.begin(), all.end());
}

const std::vector<std::string> walls[]{
    {"wall.law=EXP1+EXP2-FS", "wall.stiffness=5976", "wall.stiffening=1.093",
     "wall.fiber_stiffness=8.167e+05", "wall.fiber_stiffening=0.2005", "wall.fiber_angle=0.35",
     "wall.activation_stretch=2.486", "geometry.thickness=0.044", "wall.bulk_modulus=8.074e+08",
     "tether.stiffness=1.597e+06", "tether.traction=reference"},
    {"wall.law=EXP1+EXP2-FS", "wall.stiffness=5.227e+04", "wall.stiffening=0.1659",
     "wall.fiber_stiffness=6.647e+04", "wall.fiber_stiffening=4.29", "wall.fiber_angle=24.64",
     "wall.activation_stretch=1.483", "geometry.thickness=0.01349", "wall.bulk_modulus=1.739e+07",
     "tether.stiffness=3.361e+06"},
    {"wall.law=EXP1+EXP2-ZS", "wall.stiffness=8437", "wall.stiffening=2.368", "wall.fiber_stiffness=4813",
     "wall.fiber_stiffening=0.2736", "wall.fiber_angle=88.23", "geometry.thickness=0.01439",
     "wall.bulk_modulus=1.065e+07", "tether.stiffness=1.345e+05"},
    {"wall.law=EXP1+EXP2-FS", "wall.stiffness=5693", "wall.stiffening=1.917",
     "wall.fiber_stiffness=1.949e+05", "wall.fiber_stiffening=0.6597", "wall.fiber_angle=4.60",
     "wall.activation_stretch=2.060", "geometry.thickness=0.02421", "wall.bulk_modulus=5.171e+08",
     "tether.stiffness=9.459e+05"},
    {"wall.law=EXP1+EXP2-FS", "wall.stiffness=3.852e+04", "wall.stiffening=0.06657",
     "wall.fiber_stiffness=4.215e+05", "wall.fiber_stiffening=4.828", "wall.fiber_angle=64.20",
     "wall.activation_stretch=1.623", "geometry.thickness=0.08774", "wall.bulk_modulus=1.22e+08",
     "tether.stiffness=1.066e+07"},
    {"wall.law=EXP1+EXP2-FS", "wall.stiffness=3.958e+04", "wall.stiffening=2.505",
     "wall.fiber_stiffness=2.37e+06", "wall.fiber_stiffening=1.659", "wall.fiber_angle=80.53",
     "wall.activation_stretch=1.561", "geometry.thickness=0.07629", "wall.bulk_modulus=6.523e+09",
     "tether.stiffness=1.768e+05"},
    {"wall.law=EXP1+EXP2-FS", "wall.stiffness=6755", "wall.stiffening=0.09032",
     "wall.fiber_stiffness=5.367e+04", "wall.fiber_stiffening=0.4866", "wall.fiber_angle=27.32",
     "wall.activation_stretch=1.718", "geometry.thickness=0.07826", "wall.bulk_modulus=1.295e+08",
     "tether.stiffness=1.116e+07"},
    {"wall.law=EXP1+EXP2-FS", "wall.stiffness=8.305e+04", "wall.stiffening=0.4928",
     "wall.fiber_stiffness=2.033e+04", "wall.fiber_stiffening=0.1002", "wall.fiber_angle=65.70",
     "wall.activation_stretch=1.554", "geometry.thickness=0.06491", "wall.bulk_modulus=1.85e+09",
     "tether.stiffness=3.328e+06"},
    {"wall.law=EXP1+EXP2-FS", "wall.stiffness=4117", "wall.stiffening=0.06448", "wall.fiber_stiffness=4275",
     "wall.fiber_stiffening=1.748", "wall.fiber_angle=87.01", "wall.activation_stretch=1.534",
     "geometry.thickness=0.01173", "wall.bulk_modulus=6.568e+06", "tether.stiffness=8.232e+07"},
    {"wall.law=EXP1+EXP2-FS", "wall.stiffness=8076", "wall.stiffening=3.282",
     "wall.fiber_stiffness=2.479e+06", "wall.fiber_stiffening=7.235", "wall.fiber_angle=85.03",
     "wall.activation_stretch=1.378", "geometry.thickness=0.07058", "wall.bulk_modulus=1.355e+08",
     "tether.stiffness=7.735e+05"},
    {"wall.law=EXP1+EXP2-FS", "wall.stiffness=2.778e+04", "wall.stiffening=3.123",
     "wall.fiber_stiffness=1391", "wall.fiber_stiffening=0.1412", "wall.fiber_angle=18.38",
     "wall.activation_stretch=1.191", "geometry.thickness=0.05724", "wall.bulk_modulus=9.907e+06",
     "tether.stiffness=4.759e+05"},
    {"wall.law=EXP1+EXP2-FS", "wall.stiffness=2.733e+04", "wall.stiffening=0.5507",
     "wall.fiber_stiffness=5498", "wall.fiber_stiffening=9.37", "wall.fiber_angle=4.21",
     "wall.activation_stretch=1.398", "geometry.thickness=0.08709", "wall.bulk_modulus=5.628e+07",
     "tether.stiffness=3.075e+05"},
};

class RandomWall : public testing::TestWithParam<std::vector<std::string>> {};

// What 0D leaves out, the clamped ends above all, is worth a few per cent.
TEST_P(RandomWall, IsComputedAlikeByBothTiers) {
  std::vector<std::string> overrides = GetParam();
  overrides.insert(overrides.end(), {"time.beats=1", "accuracy.tolerance=3%"});
  const Scene scene = test_support::artery(overrides);
  const Result along = test_support::run_axisym(scene);
  const Result lumped = lumped::LumpedTier().prepare(scene)->execute({});
  EXPECT_EQ(lumped.record.failure, "");
  for (const char* column : {"pressure", "radial_displacement.P1"}) {
    const double ratio = greatest(along, column) / greatest(lumped, column);
    std::cout << column << ": 2D over 0D " << ratio << "\n";
    EXPECT_NEAR(ratio, 1, 0.04) << column;
  }
}
INSTANTIATE_TEST_SUITE_P(, RandomWall, testing::ValuesIn(walls),
                         [](const auto& instance) { return "number_" + std::to_string(instance.index + 1); });

}  // namespace
}  // namespace tunica
