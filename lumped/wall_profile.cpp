// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/wall_profile.hpp"

#include <numbers>

#include "core/frame.hpp"
#include "core/radial/fronts.hpp"

namespace tunica::lumped {

using frame::Radial;

std::vector<observables::ProfilePoint> wall_profile(const radial::RingModel& model,
                                                    radial::LumenStretch lumen_stretch,
                                                    std::span<const double> places) {
  constexpr double degrees = 180 / std::numbers::pi;
  const auto& ring = model.ring();
  const auto boundaries = radial::layer_boundaries(ring);
  const auto response = model.respond(lumen_stretch, places, false);
  std::vector<observables::ProfilePoint> points(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto& state = response.states[k];
    observables::ProfilePoint& point = points[k];
    point.reference_radius = ring.radius(places[k]);
    point.radial_displacement = state.displacement;
    point.radial_stretch = 1 + state.radial_slope;
    point.circumferential_stretch = 1 + state.displacement / point.reference_radius;
    const auto gradient = Radial::gradient(state.displacement, state.radial_slope, point.reference_radius);
    point.volume_change = volume_change(gradient);

    const auto& law = ring.layers[radial::layer_at(boundaries, places[k])].law;
    const auto& families = wall::families(law);
    if (!families.empty()) {
      const auto fiber = wall::fiber_state(families.front(), gradient, Radial::axes());
      point.fiber_stretch = fiber.stretch;
      point.fiber_angle = fiber.angle * degrees;
      point.recruitment = fiber.recruitment;
    }
    // The law gives the stress up to the pressure that equilibrium adds to incompressible tissue: the
    // radial stress, known either way, fixes it.
    const Tensor<double> cauchy = cauchy_stress(wall::piola(law, gradient, Radial::axes()), gradient);
    const double correction = state.radial_stress - cauchy(0, 0);
    point.radial_stress = state.radial_stress;
    point.circumferential_stress = cauchy(1, 1) + correction;
    point.axial_stress = cauchy(2, 2) + correction;
    point.von_mises = von_mises_stress(cauchy);
  }
  return points;
}

}  // namespace tunica::lumped
