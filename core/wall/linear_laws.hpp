// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.hpp"

namespace tunica::wall {

/// Lame's constants from Young's modulus and Poisson's ratio:
/// lambda = E nu / ((1+nu)(1-2nu)), mu = E / (2(1+nu)).
template <class P>
struct Lame {
  P lambda, mu;
  Lame(const P& young_modulus, const P& poisson_ratio)
      : lambda(young_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio))),
        mu(young_modulus / (2.0 * (1.0 + poisson_ratio))) {}
};

/// What the laws lambda/2 tr^2 e + mu e:e of a strain e have in common; their volume strain is tr e.
template <class P>
struct Hooke {
  P young_modulus;  ///< dyn/cm2
  P poisson_ratio;

  Lame<P> lame() const { return {young_modulus, poisson_ratio}; }
  P shear_stiffness() const { return lame().mu; }
  P volumetric_stiffness() const { return lame().lambda; }

  template <class S>
  S volumetric_energy(const S& volume_strain) const {
    return 0.5 * lame().lambda * (volume_strain * volume_strain);
  }
};

/// St. Venant-Kirchhoff: quadratic in the Green-Lagrange strain E = (H + H^T + H^T H)/2.
template <class P>
struct StVenantKirchhoff : Hooke<P> {
  template <class S>
  S shape_energy(const Tensor<S>& displacement_gradient) const {
    const Tensor<S> transposed = transpose(displacement_gradient);
    const Tensor<S> strain = 0.5 * (displacement_gradient + transposed + transposed * displacement_gradient);
    return this->lame().mu * contract(strain, strain);
  }
  /// tr E = tr H + H:H/2
  template <class S>
  S volume_strain(const Tensor<S>& displacement_gradient) const {
    return trace(displacement_gradient) + 0.5 * contract(displacement_gradient, displacement_gradient);
  }
  /// F
  template <class S>
  Tensor<S> volume_strain_slope(const Tensor<S>& displacement_gradient) const {
    return Tensor<S>::identity() + displacement_gradient;
  }
};

/// Linear elasticity: quadratic in the small strain e = (H + H^T)/2. Not objective; for comparison
/// with linear theory.
template <class P>
struct LinearElastic : Hooke<P> {
  template <class S>
  S shape_energy(const Tensor<S>& displacement_gradient) const {
    const Tensor<S> strain = 0.5 * (displacement_gradient + transpose(displacement_gradient));
    return this->lame().mu * contract(strain, strain);
  }
  template <class S>
  S volume_strain(const Tensor<S>& displacement_gradient) const {
    return trace(displacement_gradient);
  }
  template <class S>
  Tensor<S> volume_strain_slope(const Tensor<S>&) const {
    return Tensor<S>::identity();
  }
};

}  // namespace tunica::wall
