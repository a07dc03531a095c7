// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/kinematics.hpp"

namespace tunica::wall {

/// Isochoric neo-Hookean matrix: W = mu/2 (I1bar - 3).
template <class P>
struct NeoHookean {
  P shear_modulus;  ///< mu, dyn/cm2

  const P& shear_stiffness() const { return shear_modulus; }

  template <class S>
  S energy(const S& invariant_change) const {
    return 0.5 * shear_modulus * invariant_change;
  }
};

/// Neo-Hookean solid without a volumetric split:
/// W = mu/2 (I1 - 3 - 2 ln J) + lambda/2 ln^2 J with lambda = kappa - 2/3 mu; the volume strain is J - 1.
template <class P>
struct NeoHookeanCompressible {
  P shear_modulus;  ///< mu, dyn/cm2
  P bulk_modulus;   ///< kappa, dyn/cm2

  const P& shear_stiffness() const { return shear_modulus; }
  P volumetric_stiffness() const { return bulk_modulus - (2.0 / 3.0) * shear_modulus; }

  template <class S>
  S shape_energy(const Tensor<S>& displacement_gradient) const {
    const Kinematics<S> k(displacement_gradient);
    return 0.5 * shear_modulus * (trace(k.left_cauchy_green_change) - 2.0 * k.log_jacobian);
  }
  template <class S>
  S volume_strain(const Tensor<S>& displacement_gradient) const {
    return volume_change(displacement_gradient);
  }
  template <class S>
  Tensor<S> volume_strain_slope(const Tensor<S>& displacement_gradient) const {
    return Kinematics<S>(displacement_gradient).deformation_cofactor;
  }
  template <class S>
  S volumetric_energy(const S& volume_strain) const {
    using std::log1p;
    const S log_jacobian = log1p(volume_strain);
    return 0.5 * volumetric_stiffness() * (log_jacobian * log_jacobian);
  }
};

}  // namespace tunica::wall
