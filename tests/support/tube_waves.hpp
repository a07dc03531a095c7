// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/elastic_womersley.hpp"

namespace tunica::test_support {

/// A wave to +z and its mirror image to -z in a tube from z = 0 to `length`: what a finite tube does whose
/// ends move as these fields say.
class TubeWaves {
 public:
  /// Amplitudes of the axis pressure: of the forward wave at z = 0, of the backward wave at z = length.
  TubeWaves(const ElasticWomersley& wave, double length, Complex forward, Complex backward);
  /// The two waves that together have these axis pressures at z = 0 and z = length. Ill-posed where the
  /// length is a multiple of half a wavelength of an undamped wave.
  static TubeWaves from_end_pressures(const ElasticWomersley& wave, double length, Complex at_start,
                                      Complex at_end);

  Complex forward() const { return forward_; }
  Complex backward() const { return backward_; }

  BloodPoint<Complex> blood(double radius, double z) const;
  WallPoint<Complex> wall(double radius, double z) const;
  BloodPoint<double> blood(double radius, double z, double time) const;
  WallPoint<double> wall(double radius, double z, double time) const;
  Vector<double> wall_velocity(double radius, double z, double time) const;
  Vector<double> wall_acceleration(double radius, double z, double time) const;

 private:
  /// e^{ikz} of both waves, added for what is even in z and subtracted for what is odd.
  struct Factors {
    Complex even, odd;
  };
  Factors factors(double z) const;
  Complex phase(double time) const;

  ElasticWomersley wave_;
  double length_;
  Complex forward_, backward_;
};

}  // namespace tunica::test_support
