// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.hpp"
#include "core/wall/collagen.hpp"

namespace tunica::frame {

/// Plane-strain ring: the field is u(R) e_R, tensor axes are (radial, circumferential, axial).
/// Measures are per radian and per unit length, so a volume integral is that of R dR.
struct Radial {
  /// Gradient of the field with value u and slope du/dR at radius R: diag(du/dR, u/R, 0). Test and
  /// trial functions go through the same operator, which is what puts the hoop terms in place.
  template <class S>
  static Tensor<S> gradient(const S& value, const S& slope, const S& radius) {
    return Tensor<S>::diagonal(slope, value / radius, S(0.0));
  }

  /// P : grad of the test function (value, slope), the integrand of the internal virtual work.
  template <class S>
  static S contract_with_test(const Tensor<S>& piola, double value, const S& slope, const S& radius) {
    return piola(0, 0) * slope + piola(1, 1) * (value / radius);
  }

  template <class S>
  static S measure(const S& radius) {
    return radius;
  }

  static wall::MaterialAxes axes() { return {{0, 1, 0}, {0, 0, 1}}; }
};

}  // namespace tunica::frame
