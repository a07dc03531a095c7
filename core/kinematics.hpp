// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.hpp"

namespace tunica {

/// J - 1 of a displacement gradient H whose cofactor is known, see volume_change.
template <class S>
S volume_change_from(const Tensor<S>& gradient, const Tensor<S>& minors) {
  const S third =
      gradient(0, 0) * minors(0, 0) + gradient(0, 1) * minors(0, 1) + gradient(0, 2) * minors(0, 2);
  return trace(gradient) + trace(minors) + third;
}

/// J - 1 = tr H + tr cof H + det H for the displacement gradient H = F - I. No 1 is subtracted from 1,
/// so the relative accuracy stays at round-off for strains of any smallness.
template <class S>
S volume_change(const Tensor<S>& gradient) {
  return volume_change_from(gradient, cofactor(gradient));
}

/// What the laws need of a deformation, computed from the displacement gradient H = F - I.
template <class S>
struct Kinematics {
  Tensor<S> displacement_gradient;     ///< H = F - I
  Tensor<S> deformation_gradient;      ///< F
  Tensor<S> deformation_cofactor;      ///< cof F = J F^-T
  Tensor<S> left_cauchy_green_change;  ///< b - I = H + H^T + H H^T
  S volume_change;                     ///< J - 1
  S jacobian;                          ///< J
  S log_jacobian;                      ///< ln J
  S isochoric_factor_change;           ///< J^(-2/3) - 1, the same power in every frame
  S isochoric_factor;                  ///< J^(-2/3)

  explicit Kinematics(const Tensor<S>& gradient)
      : displacement_gradient(gradient), deformation_gradient(Tensor<S>::identity() + gradient) {
    const Tensor<S> transposed = transpose(gradient);
    left_cauchy_green_change = gradient + transposed + gradient * transposed;
    const Tensor<S> minors = cofactor(gradient);
    // cof(I + H) = (1 + tr H) I - H^T + cof H
    deformation_cofactor = minors - transposed;
    const S diagonal = 1.0 + trace(gradient);
    for (int i = 0; i < 3; ++i) deformation_cofactor(i, i) = deformation_cofactor(i, i) + diagonal;
    set_volume(volume_change_from(gradient, minors));
  }

  /// Of H = diag(a, b, c), without the products of zeros that a ring would spend most of its time on.
  static Kinematics diagonal(const S& a, const S& b, const S& c) {
    Kinematics k;
    k.displacement_gradient = Tensor<S>::diagonal(a, b, c);
    k.deformation_gradient = Tensor<S>::diagonal(1.0 + a, 1.0 + b, 1.0 + c);
    k.left_cauchy_green_change = Tensor<S>::diagonal(a * (2.0 + a), b * (2.0 + b), c * (2.0 + c));
    const S bc = b * c, ca = c * a, ab = a * b;
    k.deformation_cofactor = Tensor<S>::diagonal(1.0 + (b + c) + bc, 1.0 + (c + a) + ca, 1.0 + (a + b) + ab);
    k.set_volume((a + b + c) + (bc + ca + ab) + a * bc);
    return k;
  }

  /// I1bar - 3 = J^(-2/3) tr(b - I) + 3 (J^(-2/3) - 1)
  S isochoric_first_invariant_change() const {
    return isochoric_factor * trace(left_cauchy_green_change) + 3.0 * isochoric_factor_change;
  }

  /// First Piola-Kirchhoff stress P = tau F^-T of a Kirchhoff stress tau.
  Tensor<S> piola_from_kirchhoff(const Tensor<S>& kirchhoff) const {
    return (1.0 / jacobian) * (kirchhoff * deformation_cofactor);
  }

 private:
  Kinematics() = default;

  /// What follows from J - 1.
  void set_volume(const S& change) {
    using std::expm1;
    using std::log1p;
    volume_change = change;
    jacobian = 1.0 + volume_change;
    log_jacobian = log1p(volume_change);
    isochoric_factor_change = expm1((-2.0 / 3.0) * log_jacobian);
    isochoric_factor = 1.0 + isochoric_factor_change;
  }
};

/// Cauchy stress sigma = P F^T / J.
template <class S>
Tensor<S> cauchy_stress(const Tensor<S>& piola, const Tensor<S>& displacement_gradient) {
  const Tensor<S> f = Tensor<S>::identity() + displacement_gradient;
  return (1.0 / (1.0 + volume_change(displacement_gradient))) * (piola * transpose(f));
}

/// sqrt(3/2 s:s) with the deviator s of the Cauchy stress.
template <class S>
S von_mises_stress(const Tensor<S>& cauchy) {
  using std::sqrt;
  const Tensor<S> s = deviator(cauchy);
  return sqrt(1.5 * contract(s, s));
}

}  // namespace tunica
