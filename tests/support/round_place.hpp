// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/tensor.hpp"

namespace tunica::test_support {

/// A place in a straight vessel around the z axis, meshed in the half plane (r, z) or in space, and what
/// vectors without swirl, given by their radial and axial components, are there.
template <std::size_t dimension>
struct RoundPlace {
  double radius, height;
  std::array<double, dimension> radial;  ///< unit vector, by component; 0 on the axis

  /// Component of the vector {radial, -, axial}.
  template <class T>
  T component(const Vector<T>& v, int c) const {
    return radial[c] * v[0] + (c + 1 == static_cast<int>(dimension) ? v[2] : T(0));
  }
  /// The vector on the axes of the tensors: (r, theta, z) or (x, y, z).
  template <class T>
  Vector<T> vector(const Vector<T>& v) const {
    if constexpr (dimension == 2)
      return v;
    else
      return {component(v, 0), component(v, 1), component(v, 2)};
  }
};

inline RoundPlace<2> round_place(const std::array<double, 2>& x) {
  return {x[0], x[1], {1, 0}};
}
inline RoundPlace<3> round_place(const std::array<double, 3>& x) {
  const double r = std::hypot(x[0], x[1]), scale = r > 0 ? 1 / r : 0;
  return {r, x[2], {scale * x[0], scale * x[1], 0}};
}

}  // namespace tunica::test_support
