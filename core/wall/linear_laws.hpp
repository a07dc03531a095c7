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

  /// lambda/2 tr^2 e + mu e:e for a strain tensor e.
  template <class S>
  S energy(const Tensor<S>& strain) const {
    const S tr = trace(strain);
    return 0.5 * lambda * (tr * tr) + mu * contract(strain, strain);
  }
};

/// St. Venant-Kirchhoff: quadratic in the Green-Lagrange strain E = (H + H^T + H^T H)/2.
template <class P>
struct StVenantKirchhoff {
  P young_modulus;  ///< dyn/cm2
  P poisson_ratio;

  template <class S>
  S energy(const Tensor<S>& displacement_gradient) const {
    const Tensor<S> transposed = transpose(displacement_gradient);
    const Tensor<S> strain = 0.5 * (displacement_gradient + transposed + transposed * displacement_gradient);
    return Lame<P>(young_modulus, poisson_ratio).energy(strain);
  }
};

/// Linear elasticity: quadratic in the small strain e = (H + H^T)/2. Not objective; for comparison
/// with linear theory.
template <class P>
struct LinearElastic {
  P young_modulus;  ///< dyn/cm2
  P poisson_ratio;

  template <class S>
  S energy(const Tensor<S>& displacement_gradient) const {
    const Tensor<S> strain = 0.5 * (displacement_gradient + transpose(displacement_gradient));
    return Lame<P>(young_modulus, poisson_ratio).energy(strain);
  }
};

}  // namespace tunica::wall
