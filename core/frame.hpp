// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <numbers>

#include "core/kinematics.hpp"
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

  /// What the laws need of it.
  template <class S>
  static Kinematics<S> kinematics(const S& value, const S& slope, const S& radius) {
    return Kinematics<S>::diagonal(slope, value / radius, S(0.0));
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

/// Where a component of a nodal vector enters the 3x3 gradient of its field: entry number `entry`
/// (row-major) gets the nodal value times the lift number `lift` of the node's shape function.
struct GradientSlot {
  int component;
  int entry;
  int lift;
};

/// The lifts of a shape function are the numbers that fields and gradients are made of. Lift 0 is its
/// value, lifts 1 to `dimension` are its derivatives by the coordinates of the mesh; further ones are
/// the frame's own. Kernels know a frame by these tables only, so that test and trial functions, hoop
/// strain, divergence and follower loads need no special case.

/// Axisymmetric motion without swirl on a mesh of (r, z); tensor axes (r, theta, z), as in Radial.
struct Axisymmetric {
  static constexpr int dimension = 2;
  static constexpr int components = 2;
  static constexpr std::array<int, 2> axes{0, 2};  ///< tensor axis of each component and coordinate
  static constexpr int lifts = 4;                  ///< N, dN/dr, dN/dz, N/r
  static constexpr std::array<GradientSlot, 5> gradient{
      {{0, 0, 1}, {0, 2, 2}, {0, 4, 3}, {1, 6, 1}, {1, 8, 2}}};

  /// On the axis fields of component r vanish, and u/r is du/dr.
  static std::array<double, lifts> lift(double value, const std::array<double, 2>& slope,
                                        const std::array<double, 2>& place) {
    const double r = place[0];
    return {value, slope[0], slope[1], r > 0 ? value / r : slope[0]};
  }
  /// Volume per unit area of the (r, z) plane, and area per unit length of a line in it.
  static double measure(const std::array<double, 2>& place) { return 2 * std::numbers::pi * place[0]; }
};

/// Three dimensions; tensor axes (x, y, z).
struct Cartesian {
  static constexpr int dimension = 3;
  static constexpr int components = 3;
  static constexpr std::array<int, 3> axes{0, 1, 2};
  static constexpr int lifts = 4;  ///< N, dN/dx, dN/dy, dN/dz
  static constexpr std::array<GradientSlot, 9> gradient{
      {{0, 0, 1}, {0, 1, 2}, {0, 2, 3}, {1, 3, 1}, {1, 4, 2}, {1, 5, 3}, {2, 6, 1}, {2, 7, 2}, {2, 8, 3}}};

  static std::array<double, lifts> lift(double value, const std::array<double, 3>& slope,
                                        const std::array<double, 3>&) {
    return {value, slope[0], slope[1], slope[2]};
  }
  static double measure(const std::array<double, 3>&) { return 1; }
};

}  // namespace tunica::frame
