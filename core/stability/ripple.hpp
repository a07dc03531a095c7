// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/stability/base_state.hpp"

namespace tunica::stability {

/// Gradient of the ripple (f cos, h sin, g sin) of phase k Z + m Theta, entries row-major, cos or sin left
/// out: H = slope (f', h', g') + (value + k wave) (f, h, g), with the curvature 1/R and the wave number m/R
/// along the circumference. Entries with one index r go with sin, the others with cos; the tangent of a
/// wall that a rotation by pi about a radius maps into itself does not mix the two.
/// Columns: the components that take part, of axes (r, theta, z).
struct RippleGradient {
  using Columns = Eigen::Matrix<double, 9, Eigen::Dynamic, Eigen::ColMajor, 9, 3>;
  Columns slope, value, wave;

  RippleGradient(double curvature, double around, const std::vector<int>& components) {
    enum Entry { rr, rt, rz, tr, tt, tz, zr, zt, zz };
    const auto count = static_cast<Eigen::Index>(components.size());
    for (auto* matrix : {&slope, &value, &wave}) matrix->setZero(9, count);
    for (Eigen::Index j = 0; j < count; ++j) {
      switch (components[j]) {
        case 0:
          slope(rr, j) = 1;
          value(tt, j) = curvature;
          value(rt, j) = -around;
          wave(rz, j) = -1;
          break;
        case 1:
          slope(tr, j) = 1;
          value(rt, j) = -curvature;
          value(tt, j) = around;
          wave(tz, j) = 1;
          break;
        default:
          slope(zr, j) = 1;
          value(zt, j) = around;
          wave(zz, j) = 1;
      }
    }
  }
};

/// The arrays of a base state as matrices, in place.
inline auto matrix_of(const Tangent& tangent) {
  return Eigen::Map<const Eigen::Matrix<double, 9, 9, Eigen::RowMajor>>(tangent[0].data());
}
inline auto load_by_gradient(const SurfaceState& surface) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 9, Eigen::RowMajor>>(surface.by_gradient[0].data());
}
inline auto load_by_displacement(const SurfaceState& surface) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(surface.by_displacement[0].data());
}

}  // namespace tunica::stability
