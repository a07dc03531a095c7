// SPDX-License-Identifier: GPL-3.0-or-later
// A static tube whose ends slide, by the 2D tier, beside the thick ring that it is.
#include <cmath>
#include <iostream>

#include "axisym/axisym_tier.hpp"
#include "core/radial/from_scene.hpp"
#include "core/radial/wall_curve.hpp"

int main() {
  const tunica::Scene scene = tunica::parse_scene(
      "[geometry]\nends = 'sliding'\n[wall]\nlaw = 'EXP1'\n[time]\nmode = 'static'\n"
      "[inlet]\nwaveform = 'pressure'\npressure = '100 mmHg'\n[output]\nfield_interval = 0\n",
      "consumer", ".");
  const tunica::Result result = tunica::axisym::AxisymTier().prepare(scene)->execute({});
  const double displacement = result.observables.find("radial_displacement.P1")->values.at(0);
  const tunica::radial::WallCurve ring(tunica::radial::ring_model(scene, {}), {0.0});
  const double expected =
      scene.number("geometry.radius") * (ring.stretch_at(scene.number("inlet.pressure")) - 1);
  std::cout << displacement << " cm, thick ring " << expected << '\n';
  return std::abs(displacement - expected) < 1e-5 * expected ? 0 : 1;
}
