// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/point_fields.hpp"

namespace tunica::test_support {

/// A thick linear elastic tube whose outer surface is held by springs: sigma n = -(radial_spring u_r,
/// axial_spring u_z).
struct LinearTube {
  double radius;     ///< inner, cm
  double thickness;  ///< cm
  double young_modulus;
  double poisson_ratio;
  double radial_spring = 0;  ///< dyn/cm3
  double axial_spring = 0;

  double outer_radius() const { return radius + thickness; }
  double lame_first() const {
    return young_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
  }
  double shear_modulus() const { return young_modulus / (2 * (1 + poisson_ratio)); }
};

/// The wall of a long pipe under steady Poiseuille flow, far from its ends. On the inner surface act the
/// pressure p = p0 - G z and the blood's shear tau = G R_i / 2 (towards +z):
///   sigma_rr = -(p0 - G z),  sigma_rz = -tau  at R_i;   the springs at R_o.
/// Displacement, with e + q z the axial strain:
///   u_r = A r + B/r + z (a r + b/r),
///   u_z = e z + q z^2/2 + D - (S/(4 G_w) + a/2) r^2 + (C/G_w - b) ln(r/R_i),
///   sigma_rz = C/r - S r/2,   S = d(sigma_zz)/dz = 2 lambda a + (lambda + 2 G_w) q,
/// which meets equilibrium for any constants:
///   d(sigma_rr)/dr + (sigma_rr - sigma_tt)/r + d(sigma_rz)/dz = 0  (two of Lame's; sigma_rz has no z),
///   (1/r) d(r sigma_rz)/dr + d(sigma_zz)/dz = 0.
/// With an axial spring e = q = 0 and the spring carries the shear; without one the axial force in the wall
/// grows along z instead (q from sigma_rz = 0 outside), e is free and u_z = 0 at (R_i, 0). G = 0 is Lame's
/// tube: in plane strain (e = 0) or stretched by e. Errors are round-off.
class LameTube {
 public:
  /// Throws std::invalid_argument for an axial strain of a tube that an axial spring holds.
  LameTube(const LinearTube& tube, double pressure, double pressure_gradient = 0, double axial_strain = 0);

  /// R_i <= r <= R_o; pressures and stresses in dyn/cm2.
  WallPoint<double> at(double radius, double z = 0) const;
  double pressure(double z) const { return pressure_ - gradient_ * z; }
  double wall_shear() const { return 0.5 * gradient_ * tube_.radius; }

 private:
  /// u_r = linear r + inverse / r
  struct Lame {
    double linear = 0, inverse = 0;
  };
  Lame lame(double inner_pressure, double axial_strain) const;

  LinearTube tube_;
  double pressure_, gradient_;
  Lame constant_, slope_;  ///< (A, B) and (a, b)
  double strain_ = 0, strain_slope_ = 0;
  double shear_ = 0, offset_ = 0;  ///< C and D
  double force_slope_ = 0;         ///< S
};

}  // namespace tunica::test_support
