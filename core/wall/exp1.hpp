// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dual.hpp"

namespace tunica::wall {

/// First-order exponential matrix (paper eq. 10; Delfino et al. 1997):
/// W = alpha/2gamma (exp(gamma (I1bar - 3)) - 1).
template <class P>
struct Exp1 {
  P stiffness;   ///< alpha, dyn/cm2
  P stiffening;  ///< gamma

  /// Scale of the stiffness against changes of shape.
  const P& shear_stiffness() const { return stiffness; }

  template <class S>
  S energy(const S& invariant_change) const {
    using std::expm1;
    return stiffness / (2.0 * stiffening) * expm1(stiffening * invariant_change);
  }
};

}  // namespace tunica::wall
