// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "core/wall/law.hpp"

namespace tunica::physics {

/// Momentum of the wall: int [ rho a . phi + P : dphi/dX ] dX, `density` that of the unloaded tissue.
template <class S>
Vector<S> wall_inertia(double density, const Vector<S>& acceleration) {
  return {density * acceleration[0], density * acceleration[1], density * acceleration[2]};
}

/// Share of the volumetric stress that is taken at each point when the rest is interpolated on its own. It
/// keeps the volume change within a cell bounded where strain is singular, as at the corners of clamped ends,
/// and is too small to lock: a tenth of it, but no less than 11 times and no more than 60 times the stiffness
/// against changes of shape (12 to 52 times in the paper's laws). 1, all of it, for tissue that is far from
/// incompressible.
inline double pointwise_volumetric_share(const wall::Law<double>& law) {
  constexpr double share = 0.1, least = 11, greatest = 60;
  const double ratio = wall::volumetric_ratio(law);
  return ratio > least ? std::clamp(share * ratio, least, greatest) / ratio : 1;
}

/// First Piola-Kirchhoff stress of tissue whose volumetric stress V'(theta) (see wall::volume_strain) is, for
/// the greater share, replaced by a pressure that is interpolated on its own:
///   P = dW_shape/dH + [s V'(theta) - (1 - s) p_wall] dtheta/dH.
/// With p_wall = -V'(theta) it is the law's own stress.
template <class S>
Tensor<S> mixed_wall_stress(const wall::Law<double>& law, const Tensor<S>& displacement_gradient,
                            const wall::MaterialAxes& axes, double wall_pressure) {
  const double s = pointwise_volumetric_share(law);
  const S volumetric = wall::volumetric_stress(law, wall::volume_strain(law, displacement_gradient));
  return wall::piola_with(law, displacement_gradient, axes, S(s * volumetric - (1 - s) * wall_pressure));
}

}  // namespace tunica::physics
