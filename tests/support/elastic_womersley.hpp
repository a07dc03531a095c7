// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "tests/support/bessel.hpp"
#include "tests/support/point_fields.hpp"

namespace tunica::test_support {

/// A thick linear elastic tube full of blood, its outer surface held by springs: sigma n = -tether u.
struct ElasticTube {
  double radius;     ///< inner, cm
  double thickness;  ///< cm
  double young_modulus;
  double poisson_ratio;
  double wall_density;
  double blood_density;
  double viscosity;
  double tether = 0;  ///< dyn/cm3, radially and axially alike; 0: free

  double outer_radius() const { return radius + thickness; }
  double lame_first() const {
    return young_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
  }
  double shear_modulus() const { return young_modulus / (2 * (1 + poisson_ratio)); }
};

/// Squares of the two wave numbers of a thin-walled tube (membrane forces, wall inertia, tether) with long
/// waves (J. R. Womersley, Phil. Mag. 46 (1955) 199, with springs): errors are O(h/R) and O((kR)^2). The one
/// that is closer to the axially held tube's is the Young mode's, and comes first.
std::array<LongComplex, 2> thin_wall_wave_numbers_squared(const ElasticTube& tube, double angular_frequency);

/// The pressure pulse (Young mode) that travels in a blood-filled thick elastic tube, linearised about rest:
///   rho dv/dt = -grad p + mu lap v, div v = 0 in r < R;   rho_s d2u/dt2 = div sigma(u) in R < r < R + h;
///   v = du/dt and equal tractions at R, sigma n = -K u at R + h; all fields ~ e^{i (k z - w t)}.
/// Each field is a sum of terms grad(f0(a r) e^{ikz}) and curl(f1(a r) e^{ikz} e_theta) with modified Bessel
/// functions f: p = A I0(kr), v = grad p/(i w rho) + C curl, s^2 = k^2 - i w rho/mu; u = B1, B2 grad (I, K of
/// sqrt(k^2 - w^2/c_L^2) r) + B3, B4 curl (sqrt(k^2 - w^2/c_S^2)). The six conditions on (A, C, B1..B4) have
/// a solution where their determinant vanishes, which Muller's method finds from the thin-walled tube's k.
/// Amplitudes are for unit pressure on the axis at z = 0. In extended precision: the equations hold to
/// round-off of the results, the conditions to 1e-12 of the blood's shear for |k| R > 3e-3; longer waves in a
/// held wall lose digits as (kR)^-4, since gradient and curl terms become alike (1e-8 at 3e-4).
class ElasticWomersley {
 public:
  /// Throws std::runtime_error when the Young mode is not found from the thin-walled tube's, which needs long
  /// waves, |k| R < 3.
  ElasticWomersley(const ElasticTube& tube, double angular_frequency);

  /// 1/cm; waves go to +z and decay on their way: Re k > 0, Im k > 0.
  Complex wave_number() const;
  double angular_frequency() const { return angular_frequency_; }
  const ElasticTube& tube() const { return tube_; }

  BloodPoint<Complex> blood(double radius) const;  ///< 0 <= r <= R, at z = 0
  WallPoint<Complex> wall(double radius) const;    ///< R <= r <= R + h, at z = 0

 private:
  ElasticTube tube_;
  double angular_frequency_;
  LongComplex k_;
  std::array<LongComplex, 6> weights_;  ///< A, C, B1..B4
};

}  // namespace tunica::test_support
