// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/quadrature.hpp"
#include "tests/mms/manufactured_vessel.hpp"

/// Motions without swirl in the half plane of (r, z).
namespace tunica::mms::half_plane {

/// The unloaded vessel, the same for all motions. The interface is at R(z) = radius (1 + bulge sin(2 z)), the
/// outer surface is like it.
struct Shape {
  using Axes = manufactured::Axisymmetric;
  static constexpr int dimension = 2;
  double radius = 0.6, thickness = 0.3, length = 0.9;
  double bulge = 0;

  template <class S>
  S profile(const S& z) const {
    return 1 + bulge * sin(2.0 * z);
  }
  /// Outward normal of the interface and of the outer surface, for blood and wall together.
  Vector<double> normal(const Vector<double>& x) const {
    const Dual<double, 1> shape = profile(seed(x[2]));
    const double slope = x[0] * shape.derivative[0] / shape.value, size = std::hypot(1.0, slope);
    return {1 / size, 0, -slope / size};
  }
  /// There are no planes to cut along.
  static Vector<double> cut_normal(const Vector<double>&) { return {}; }
  static Vector<double> place(const std::array<double, 2>& x) { return {x[0], 0, x[1]}; }
  /// Of the wall.
  static wall::MaterialAxes directions() { return {{0, 1, 0}, {0, 0, 1}}; }
  /// Integrates over the section of the unloaded lumen at height z: visit(x, area).
  template <class Visit>
  void for_each_in_section(double z, const Visit& visit) const {
    const double edge = radius * profile(z);
    for (const auto& q : gauss_legendre(20)) {
      const double r = 0.5 * edge * (1 + q.position);
      visit(Vector<double>{r, 0, z}, edge * q.weight * std::numbers::pi * r);
    }
  }
};

/// Smooth in space, with strains of up to some 0.3. On the axis r-components are odd in r, all else is even.
struct SmoothMotion : Shape {
  /// The motion keeps volumes but for this share, as tissue does whose bulk modulus is the inverse of it.
  std::optional<double> compressibility;
  double direction = 1;  ///< -1 turns the flow through the vessel round

  template <class S>
  Vector<S> displacement(const Vector<S>& x, const S& t) const {
    const S &r = x[0], &z = x[2];
    if (!compressibility)
      return {r * (0.1 + 0.06 * sin(3.0 * t) + 0.12 * cos(2.0 * t) * sin(1.7 * z + 0.4 * r * r)), S(0.0),
              0.15 * cos(2.5 * t) * sin(1.3 * z) + 0.1 * r * r * cos(2.0 * z + t)};
    // (r, z) -> (r / sqrt(g'(s)), g(s)) with s = z + shear(r) keeps volumes for any g.
    const S s = z + 0.2 * cos(2.0 * t) * r * r, phase = 1.7 * s + 2.0 * t;
    const S slope = 1 + 0.25 * cos(phase);
    return {r * (1 / sqrt(slope) - 1 + *compressibility * (3 + sin(2.0 * z - t))), S(0.0),
            s + (0.25 / 1.7) * sin(phase) - z};
  }
  /// Velocity of blood beyond that of the motion; vanishes at the interface.
  template <class S>
  Vector<S> stream(const Vector<S>& x, const S& t) const {
    const S &r = x[0], &z = x[2];
    const S share = r / (radius * profile(z)), inside = 1 - share * share;
    return {r * inside * (0.6 * cos(3.0 * t) * cos(1.5 * z)), S(0.0),
            direction * inside * (1.5 + sin(2.0 * t) + 0.4 * cos(t) * sin(2.0 * z + r * r))};
  }
  template <class S>
  S pressure(const Vector<S>& x, const S& t) const {
    const S &r = x[0], &z = x[2];
    return 2.0 * cos(1.4 * z) * (1 + 0.5 * sin(3.0 * t)) + r * r * sin(2.0 * z + t);
  }
};

/// Quadratic displacement and velocity, linear pressure, and a volume change that is the same everywhere:
/// quadratic elements hold these fields, and integrate all that follows from them for a neo-Hookean wall,
/// without error. What is left are errors in time.
struct PolynomialMotion : Shape {
  template <class S>
  Vector<S> displacement(const Vector<S>& x, const S& t) const {
    const S &r = x[0], &z = x[2];
    return {r * (0.1 + 0.08 * sin(4.0 * t)), S(0.0), z * (0.05 - 0.1 * cos(3.0 * t)) + 0.1 * sin(3.5 * t)};
  }
  template <class S>
  Vector<S> stream(const Vector<S>& x, const S& t) const {
    const S &r = x[0], &z = x[2];
    return {r * (radius - r) * (1 + 0.4 * z) * (0.8 * cos(3.0 * t)), S(0.0),
            (1 - r * r / (radius * radius)) * (1 + 0.3 * z) * (1.5 + sin(4.0 * t))};
  }
  template <class S>
  S pressure(const Vector<S>& x, const S& t) const {
    const S &r = x[0], &z = x[2];
    return 1 + sin(3.0 * t) + z * (cos(4.0 * t) - 2) + 0.5 * r * sin(2.0 * t);
  }
};

}  // namespace tunica::mms::half_plane
