// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/kinematics.hpp"

namespace tunica::wall {

/// Penalty on volume change (paper eq. 9): U(J) = kappa/4 [(J-1)^2 + ln^2 J].
template <class P>
struct Volumetric {
  P bulk_modulus;  ///< kappa, dyn/cm2

  template <class S>
  S energy(const Kinematics<S>& k) const {
    return 0.25 * bulk_modulus * (k.volume_change * k.volume_change + k.log_jacobian * k.log_jacobian);
  }

  /// J U'(J) = kappa/2 [J (J-1) + ln J], the hydrostatic Kirchhoff stress.
  template <class S>
  S kirchhoff(const Kinematics<S>& k) const {
    return 0.5 * bulk_modulus * (k.jacobian * k.volume_change + k.log_jacobian);
  }

  /// U'(J) for J = 1 + volume_change, the hydrostatic Cauchy stress.
  template <class S>
  S slope(const S& volume_change) const {
    using std::log1p;
    return 0.5 * bulk_modulus * (volume_change + log1p(volume_change) / (1.0 + volume_change));
  }
};

}  // namespace tunica::wall
