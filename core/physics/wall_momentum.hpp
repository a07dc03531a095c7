// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/wall/law.hpp"

namespace tunica::physics {

/// Momentum of the wall: int [ rho a . phi + P : dphi/dX ] dX, `density` that of the unloaded tissue.
template <class S>
Vector<S> wall_inertia(double density, const Vector<S>& acceleration) {
  return {density * acceleration[0], density * acceleration[1], density * acceleration[2]};
}

/// First Piola-Kirchhoff stress of tissue whose volumetric part U'(J) is replaced by a pressure that is
/// interpolated on its own: P = P_iso(H) - p_wall cof F. With p_wall = -U'(J) it is the law's own stress.
template <class S>
Tensor<S> mixed_wall_stress(const wall::Law<double>& law, const Tensor<S>& displacement_gradient,
                            const wall::MaterialAxes& axes, const S& wall_pressure) {
  const Kinematics<S> k(displacement_gradient);
  return wall::isochoric_piola(law, k, axes) - wall_pressure * k.deformation_cofactor;
}

}  // namespace tunica::physics
