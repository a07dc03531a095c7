// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "core/frame.hpp"
#include "core/radial/ring.hpp"

/// The motion of a ring by the area that moves past its circles: v(R) = (r^2 - R^2)/2, in cm2 per radian.
namespace tunica::radial {

/// v_i at a lumen stretch.
template <class P>
P inner_area(const Ring<P>& ring, LumenStretch lumen_stretch) {
  return 0.5 * lumen_stretch.strain() * (2 + lumen_stretch.strain()) *
         (ring.inner_radius * ring.inner_radius);
}

/// Displacement and its slope where v = (r^2 - R^2)/2 and dv/dR are known: no difference of r and R is taken.
template <class S, class P>
WallState<S> motion(const S& area, const S& area_slope, const P& radius) {
  using std::sqrt;
  const S current = sqrt(radius * radius + 2.0 * area);
  const S displacement = 2.0 * area / (current + radius);
  return {displacement, S((area_slope - displacement) / current), S(0.0)};
}

/// What the weak form integrates: tau_RR/J, the radial Cauchy stress, and R (tau_TT - tau_RR)/r^2.
template <class S>
struct Fluxes {
  S radial_stress, hoop_excess;
};

/// S carries derivatives of the motion or, as P, of the parameters.
template <class P, class S>
Fluxes<S> fluxes(const wall::Law<P>& law, const S& area, const S& area_slope, const P& radius) {
  const WallState<S> m = motion(area, area_slope, radius);
  const S place(radius);
  const S current = place + m.displacement;
  const S per_area = place / (current * current);
  return std::visit(
      [&](const auto& l) -> Fluxes<S> {
        if constexpr (wall::HasFamilies<std::decay_t<decltype(l)>>) {
          const Tensor<S> kirchhoff = l.isochoric_kirchhoff(
              frame::Radial::kinematics(m.displacement, m.radial_slope, place), frame::Radial::axes());
          const S change = area_slope / place;
          return {S(kirchhoff(0, 0) / (1.0 + change) + l.volumetric.slope(change)),
                  S((kirchhoff(1, 1) - kirchhoff(0, 0)) * per_area)};
        } else {
          const Tensor<S> gradient = frame::Radial::gradient(m.displacement, m.radial_slope, place);
          const Tensor<S> piola = l.piola(gradient, frame::Radial::axes());
          return {
              S(piola(0, 0) / (1.0 + gradient(1, 1))),
              S((piola(1, 1) * (1.0 + gradient(1, 1)) - piola(0, 0) * (1.0 + gradient(0, 0))) * per_area)};
        }
      },
      law);
}

}  // namespace tunica::radial
