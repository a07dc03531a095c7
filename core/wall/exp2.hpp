// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dual.hpp"

namespace tunica::wall {

/// Second-order exponential matrix (paper eq. 11):
/// W = alpha/2gamma (exp(gamma (I1bar - 3)^2) - 1). It has no shear stiffness at rest.
template <class P>
struct Exp2 {
  P stiffness;   ///< alpha, dyn/cm2
  P stiffening;  ///< gamma

  /// Scale of the stiffness against changes of shape, once the tissue is strained.
  const P& shear_stiffness() const { return stiffness; }

  template <class S>
  S energy(const S& invariant_change) const {
    using std::expm1;
    return stiffness / (2.0 * stiffening) * expm1(stiffening * (invariant_change * invariant_change));
  }
};

}  // namespace tunica::wall
