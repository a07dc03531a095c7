// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/kinematics.hpp"
#include "core/wall/recruitment.hpp"

namespace tunica::wall {

/// Unit vectors along the vessel's circumference and axis where a law is evaluated.
struct MaterialAxes {
  Vector<double> circumferential;
  Vector<double> axial;
};

/// A family of collagen fibres. Its energy (paper eqs. 13-15, with the square that the text has
/// lost; exponent 1 is the form as printed) is, for x = I4bar - a^2,
///   w alpha/2gamma (exp(gamma x^exponent) - 1),
/// and its stress is multiplied by the recruited share H(x), so that the stress is not the gradient
/// of this energy. Where x < 0 the exponential of the square is left out: w alpha/2 x^2, its first term, so
/// that what the tail of H lets through there is bounded by w alpha/(pi epsilon) wherever the threshold lies.
template <class P>
struct CollagenFamily {
  P angle;               ///< beta, rad, to the circumference
  P weight;              ///< w
  P stiffness;           ///< alpha, dyn/cm2
  P stiffening;          ///< gamma
  P activation_squared;  ///< a^2
  int exponent = 2;
  Recruitment<P> recruitment{};
  /// Of the angle that the family is made with, once and not at each stress.
  P cosine = cosine_of(angle), sine = sine_of(angle);

  /// Energy of fully recruited fibres. Its first three derivatives are continuous at the threshold.
  template <class S>
  S energy(const S& excess) const {
    using std::expm1;
    if (exponent == 2 && plain(excess) < 0) return 0.5 * weight * stiffness * (excess * excess);
    const S power = exponent == 2 ? excess * excess : excess;
    return weight * stiffness / (2.0 * stiffening) * expm1(stiffening * power);
  }

  /// a0 = cos(beta) e_circumferential + sin(beta) e_axial
  Vector<P> direction(const MaterialAxes& axes) const {
    Vector<P> a0;
    for (int i = 0; i < 3; ++i) a0[i] = cosine * axes.circumferential[i] + sine * axes.axial[i];
    return a0;
  }

  template <class S>
  struct Deformed {
    Vector<S> fiber;  ///< a = F a0
    S excess;         ///< x = I4bar - a^2
  };

  /// I4bar - a^2 = J^(-2/3) |F a0|^2 - a^2, computed from |F a0|^2 - 1 = (a + a0) . H a0 so that it
  /// keeps its relative accuracy at small strain for fibres that are recruited from rest.
  template <class S>
  Deformed<S> deformed(const Kinematics<S>& k, const MaterialAxes& axes) const {
    const Vector<P> a0 = direction(axes);
    const Vector<S> change = k.displacement_gradient * a0;
    Vector<S> a, sum;
    for (int i = 0; i < 3; ++i) {
      a[i] = change[i] + a0[i];
      sum[i] = a[i] + a0[i];
    }
    return {a,
            k.isochoric_factor * dot(sum, change) + k.isochoric_factor_change + (1.0 - activation_squared)};
  }

  template <class S>
  S excess(const Kinematics<S>& k, const MaterialAxes& axes) const {
    return deformed(k, axes).excess;
  }

  /// Kirchhoff stress H(x) 2 W'(x) J^(-2/3) dev(a x a), a = F a0, without the deviator:
  /// the caller takes it once for all terms.
  template <class S>
  Tensor<S> kirchhoff_before_deviator(const Kinematics<S>& k, const MaterialAxes& axes) const {
    const auto [a, x] = deformed(k, axes);
    const S slope = energy(seed(x)).derivative[0];
    return (2.0 * recruitment.share(x) * slope * k.isochoric_factor) * outer(a, a);
  }

 private:
  // std::cos of a double, cos by its argument's namespace of a dual.
  static P cosine_of(const P& angle) {
    using std::cos;
    return cos(angle);
  }
  static P sine_of(const P& angle) {
    using std::sin;
    return sin(angle);
  }
};

/// a^2 = lambda_A^2 cos^2 beta + sin^2 beta: fibres at angle beta are recruited when the tissue is
/// stretched by lambda_A along the circumference at constant length.
template <class P>
P activation_squared(const P& activation_stretch, const P& angle) {
  using std::cos;
  using std::sin;
  const P c = cos(angle), s = sin(angle);
  return activation_stretch * activation_stretch * (c * c) + s * s;
}

/// What the observables show of a family at a point.
template <class S>
struct FiberState {
  S stretch;      ///< sqrt(I4bar)
  S recruitment;  ///< H
  S angle;        ///< rad, deformed fibre F a0 against the deformed circumference F e_c, 0 to pi/2
};

template <class S>
FiberState<S> fiber_state(const CollagenFamily<S>& family, const Tensor<S>& displacement_gradient,
                          const MaterialAxes& axes) {
  using std::abs;
  using std::atan2;
  using std::sqrt;
  const Kinematics<S> k(displacement_gradient);
  const Vector<S> fiber = k.deformation_gradient * family.direction(axes);
  const Vector<S> ring = k.deformation_gradient * axes.circumferential;
  const Vector<S> normal = cross(fiber, ring);
  // Along the circumference the angle is a flat zero, but the root's slope is infinite.
  const S sine_squared = dot(normal, normal);
  const S sine = plain(sine_squared) > 0 ? S(sqrt(sine_squared)) : S(0.0);
  return {S(sqrt(k.isochoric_factor * dot(fiber, fiber))), family.recruitment.share(family.excess(k, axes)),
          S(atan2(sine, S(abs(dot(fiber, ring)))))};
}

}  // namespace tunica::wall
