// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "core/quadrature.hpp"
#include "tests/mms/manufactured_vessel.hpp"

/// Motions in space without any symmetry, of a wall beside a channel: blood fills 0 < x < width P(y, z), the
/// wall lies beyond, to (width + thickness) P(y, z), for 0 < y < depth, 0 < z < length. What would be planes
/// of symmetry cut the channel.
namespace tunica::mms::box {

struct Shape {
  using Axes = manufactured::Cartesian;
  static constexpr int dimension = 3;
  double width = 0.6, thickness = 0.3, depth = 0.6, length = 0.6;
  double bulge = 0;  ///< P(y, z) = 1 + bulge sin(2 z + y)

  template <class S>
  S profile(const S& y, const S& z) const {
    return 1 + bulge * sin(2.0 * z + y);
  }
  /// Outward normal of the interface and of the outer surface, for blood and wall together.
  Vector<double> normal(const Vector<double>& x) const {
    const double steepness = -x[0] / profile(x[1], x[2]) * bulge * std::cos(2 * x[2] + x[1]);
    const double size = std::sqrt(1 + 5 * steepness * steepness);
    return {1 / size, steepness / size, 2 * steepness / size};
  }
  Vector<double> cut_normal(const Vector<double>& x) const {
    if (x[0] < 1e-12) return {-1, 0, 0};
    return {0, x[1] < 0.5 * depth ? -1.0 : 1.0, 0};
  }
  static Vector<double> place(const std::array<double, 3>& x) { return x; }
  /// Of the wall.
  static wall::MaterialAxes directions() { return {{0, 1, 0}, {0, 0, 1}}; }
  /// Integrates over the section of the unloaded channel at height z: visit(x, area).
  template <class Visit>
  void for_each_in_section(double z, const Visit& visit) const {
    const auto rule = gauss_legendre(10);
    for (const auto& b : rule) {
      const double y = 0.5 * depth * (1 + b.position), edge = width * profile(y, z);
      for (const auto& a : rule)
        visit(Vector<double>{0.5 * edge * (1 + a.position), y, z}, 0.25 * edge * depth * a.weight * b.weight);
    }
  }
};

/// Smooth in space, with strains of up to some 0.3.
struct SmoothMotion : Shape {
  /// The motion keeps volumes but for this share, as tissue does whose bulk modulus is the inverse of it.
  std::optional<double> compressibility;
  double direction = 1;  ///< -1 turns the flow through the channel round

  template <class S>
  Vector<S> displacement(const Vector<S>& p, const S& t) const {
    const S &x = p[0], &y = p[1], &z = p[2];
    if (compressibility) {
      // Each of the three shears keeps volumes.
      const S u = x + 0.12 * cos(2.0 * t) * sin(1.7 * z + 0.8 * y),
              v = y + 0.15 * cos(2.5 * t) * sin(1.3 * u - 0.6 * z),
              w = z + 0.15 * sin(2.0 * t + 1.0) * sin(1.1 * u + 0.9 * v);
      return {u - x + *compressibility * x * (3 + sin(2.0 * z - t)), v - y, w - z};
    }
    return {0.1 * x * (1 + sin(3.0 * t)) + 0.12 * cos(2.0 * t) * sin(1.7 * z + x + 0.8 * y),
            0.12 * cos(2.5 * t) * sin(1.3 * y - 0.9 * x + 0.5 * z) + 0.05 * x * z,
            0.15 * cos(2.0 * t) * sin(1.3 * z + 0.6 * y) + 0.1 * x * y * cos(2.0 * z + t)};
  }
  /// Velocity of blood beyond that of the motion; vanishes at the interface.
  template <class S>
  Vector<S> stream(const Vector<S>& p, const S& t) const {
    const S &x = p[0], &y = p[1], &z = p[2];
    const S share = x / (width * profile(y, z)), inside = 1 - share * share;
    return {inside * (0.6 * cos(3.0 * t) * cos(1.5 * z + y)),
            inside * (0.5 * sin(t + 1.0) * sin(x + 1.4 * y - z)),
            direction * inside * (1.5 + sin(2.0 * t) + 0.4 * cos(t) * sin(2.0 * z + x - 1.2 * y))};
  }
  template <class S>
  S pressure(const Vector<S>& p, const S& t) const {
    const S &x = p[0], &y = p[1], &z = p[2];
    return 2.0 * cos(1.4 * z + 0.7 * y) * (1 + 0.5 * sin(3.0 * t)) + x * y * sin(2.0 * z + t) + sin(1.6 * x);
  }
};

/// Quadratic displacement and velocity, linear pressure, and a deformation that is the same everywhere:
/// quadratic elements hold these fields, and integrate all that follows from them for a neo-Hookean wall,
/// without error. What is left are errors in time.
struct PolynomialMotion : Shape {
  template <class S>
  Vector<S> displacement(const Vector<S>& p, const S& t) const {
    const S &x = p[0], &y = p[1], &z = p[2];
    return {x * (0.1 + 0.08 * sin(4.0 * t)) + 0.1 * y * cos(2.0 * t),
            0.06 * y * sin(3.0 * t) - 0.1 * z * sin(2.5 * t),
            z * (0.05 - 0.1 * cos(3.0 * t)) + 0.08 * x * cos(3.5 * t) + 0.1 * sin(3.5 * t)};
  }
  template <class S>
  Vector<S> stream(const Vector<S>& p, const S& t) const {
    const S &x = p[0], &y = p[1], &z = p[2];
    const S inside = 1 - x / width;
    return {inside * (1 + 0.4 * z) * (0.8 * cos(3.0 * t)), inside * (x - y) * sin(2.0 * t),
            inside * (1 + 0.3 * z + 0.5 * y) * (1.5 + sin(4.0 * t))};
  }
  template <class S>
  S pressure(const Vector<S>& p, const S& t) const {
    const S &x = p[0], &y = p[1], &z = p[2];
    return 1 + sin(3.0 * t) + z * (cos(4.0 * t) - 2) + 0.5 * x * sin(2.0 * t) - 0.4 * y * cos(2.0 * t);
  }
};

}  // namespace tunica::mms::box
