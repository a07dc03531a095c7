// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

#include "core/dual.hpp"

namespace tunica::wall {

/// Share of recruited fibres (paper eq. 16): H(x) = atan(epsilon x)/pi + 1/2 with
/// x = I4bar - a^2, or its limit, the step with H(0) = 1/2.
template <class P>
struct Recruitment {
  P sharpness;  ///< epsilon
  bool sharp = false;

  template <class S>
  S share(const S& excess) const {
    using std::atan;
    if (sharp) {
      const double x = plain(excess);
      return S(x > 0 ? 1.0 : x < 0 ? 0.0 : 0.5);
    }
    return (1.0 / std::numbers::pi) * atan(sharpness * excess) + 0.5;
  }
};

}  // namespace tunica::wall
