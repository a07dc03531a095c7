// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/wall/law.hpp"

namespace tunica::physics {

/// Momentum of the wall: int [ rho a . phi + P : dphi/dX ] dX, `density` that of the unloaded tissue.
template <class S>
Vector<S> wall_inertia(double density, const Vector<S>& acceleration) {
  return {density * acceleration[0], density * acceleration[1], density * acceleration[2]};
}

/// First Piola-Kirchhoff stress of tissue with a hydrostatic stress of its own: P = P_iso(H) - p cof F.
template <class S>
Tensor<S> pressurised_wall_stress(const wall::Law<double>& law, const Tensor<S>& displacement_gradient,
                                  const wall::MaterialAxes& axes, const S& pressure) {
  const Kinematics<S> k(displacement_gradient);
  return wall::isochoric_piola(law, k, axes) - pressure * k.deformation_cofactor;
}

/// Share of the volumetric stress that is taken at each point when the rest is interpolated on its own. It
/// keeps the volume change within a cell bounded where strain is singular, as at the corners of clamped ends,
/// and is too small to lock: the tissue's bulk modulus times it is a few times its shear modulus.
inline constexpr double pointwise_volumetric_share = 0.1;

/// First Piola-Kirchhoff stress of tissue whose volumetric part U'(J) is, for the greater share, replaced by
/// a pressure that is interpolated on its own:
///   P = P_iso(H) + [s U'(J) - (1 - s) p_wall] cof F.
/// With p_wall = -U'(J) it is the law's own stress.
template <class S>
Tensor<S> mixed_wall_stress(const wall::Law<double>& law, const Tensor<S>& displacement_gradient,
                            const wall::MaterialAxes& axes, double wall_pressure) {
  constexpr double s = pointwise_volumetric_share;
  const S volumetric = wall::volumetric(law).slope(volume_change(displacement_gradient));
  return pressurised_wall_stress(law, displacement_gradient, axes,
                                 S((1 - s) * wall_pressure - s * volumetric));
}

}  // namespace tunica::physics
