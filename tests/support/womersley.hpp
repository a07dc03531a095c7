// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/bessel.hpp"

namespace tunica::test_support {

struct RigidPipe {
  double radius;     ///< cm
  double density;    ///< g/cm3
  double viscosity;  ///< g/(cm s)
};

/// Fully developed oscillating flow in a rigid pipe (J. R. Womersley, J. Physiol. 127 (1955) 553),
///   rho dv/dt = g + mu (v'' + v'/r),  v(R) = 0,  g = -dp/dz = Re(G e^{-i w t}).
/// With s^2 = -i w rho / mu: v = (G/mu) (I0(sR) - I0(sr)) / (s^2 I0(sR)), which is Poiseuille's flow at w =
/// 0. Complex results are the amplitudes at e^{-i w t}; those with a time are real. Errors are some 1e-15 of
/// the largest velocity for Womersley numbers from 0 to 1e3. A periodic flow is a sum of such flows.
class Womersley {
 public:
  static Womersley from_gradient(const RigidPipe& pipe, double angular_frequency, Complex gradient);
  static Womersley from_flow(const RigidPipe& pipe, double angular_frequency, Complex flow);

  /// R sqrt(w rho / mu)
  double number() const;
  /// G, dyn/cm3
  Complex gradient() const { return gradient_; }
  /// pi R^4 G / mu * I2(sR) / ((sR)^2 I0(sR)), cm3/s
  Complex flow() const;
  Complex velocity(double radius) const;
  /// dv/dr
  Complex slope(double radius) const;
  /// Traction of the blood on the pipe along z, -mu dv/dr at R, dyn/cm2.
  Complex wall_shear() const;

  double gradient(double time) const;
  double flow(double time) const;
  double velocity(double radius, double time) const;
  double slope(double radius, double time) const;
  double wall_shear(double time) const;

 private:
  Womersley(const RigidPipe& pipe, double angular_frequency, Complex gradient);
  double real(Complex amplitude, double time) const;

  RigidPipe pipe_;
  double angular_frequency_;
  Complex gradient_;
  LongComplex s_;        ///< 1/cm
  LongComplex at_wall_;  ///< I0(sR)
};

}  // namespace tunica::test_support
