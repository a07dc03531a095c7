// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/kinematics.hpp"

namespace tunica::wall {

/// Isochoric neo-Hookean matrix: W = mu/2 (I1bar - 3).
template <class P>
struct NeoHookean {
  P shear_modulus;  ///< mu, dyn/cm2

  template <class S>
  S energy(const S& invariant_change) const {
    return 0.5 * shear_modulus * invariant_change;
  }
};

/// Neo-Hookean solid without a volumetric split:
/// W = mu/2 (I1 - 3 - 2 ln J) + lambda/2 ln^2 J with lambda = kappa - 2/3 mu.
template <class P>
struct NeoHookeanCompressible {
  P shear_modulus;  ///< mu, dyn/cm2
  P bulk_modulus;   ///< kappa, dyn/cm2

  template <class S>
  S energy(const Tensor<S>& displacement_gradient) const {
    const Kinematics<S> k(displacement_gradient);
    const P lambda = bulk_modulus - (2.0 / 3.0) * shear_modulus;
    return 0.5 * shear_modulus * (trace(k.left_cauchy_green_change) - 2.0 * k.log_jacobian) +
           0.5 * lambda * (k.log_jacobian * k.log_jacobian);
  }
};

}  // namespace tunica::wall
