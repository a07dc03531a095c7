// SPDX-License-Identifier: GPL-3.0-or-later
// Shear stress of EXP1 in simple shear s, beside its closed form alpha s exp(gamma s^2).
#include <cmath>
#include <iostream>

#include "core/kinematics.hpp"
#include "core/wall/from_scene.hpp"

int main() {
  const tunica::Scene scene = tunica::parse_scene("[wall]\nlaw = 'EXP1'\n", "consumer", ".");
  const auto wall = tunica::wall::wall_from_scene(tunica::SeededScene<double>(scene));
  tunica::Tensor<double> shear;
  shear(0, 1) = 0.3;
  const auto piola = tunica::wall::piola(wall.front().law, shear, {{1, 0, 0}, {0, 0, 1}});
  const double stress = tunica::cauchy_stress(piola, shear)(0, 1);
  const double expected = 7.6350e4 * 0.3 * std::exp(0.7410 * 0.3 * 0.3);
  std::cout << stress << " dyn/cm2, closed form " << expected << '\n';
  return std::abs(stress - expected) < 1e-12 * expected ? 0 : 1;
}
