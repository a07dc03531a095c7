// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/tube_waves.hpp"

namespace tunica::test_support {

namespace {

/// even * (scalars, radial components) and odd * (axial components): a wave and its mirror image together.
Vector<Complex> combined(const Vector<Complex>& v, Complex even, Complex odd) {
  return {even * v[0], even * v[1], odd * v[2]};
}
Tensor<Complex> combined(const Tensor<Complex>& t, Complex even, Complex odd) {
  Tensor<Complex> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = ((i == 2) == (j == 2) ? even : odd) * t(i, j);
  return c;
}

}  // namespace

TubeWaves::TubeWaves(const ElasticWomersley& wave, double length, Complex forward, Complex backward)
    : wave_(wave), length_(length), forward_(forward), backward_(backward) {}

TubeWaves TubeWaves::from_end_pressures(const ElasticWomersley& wave, double length, Complex at_start,
                                        Complex at_end) {
  // p(0) = F + B e, p(L) = F e + B with e = e^{ikL}
  const Complex e = std::exp(Complex(0, length) * wave.wave_number());
  const Complex determinant = 1.0 - e * e;
  return {wave, length, (at_start - e * at_end) / determinant, (at_end - e * at_start) / determinant};
}

TubeWaves::Factors TubeWaves::factors(double z) const {
  const Complex ik = Complex(0, 1) * wave_.wave_number();
  const Complex f = forward_ * std::exp(ik * z), b = backward_ * std::exp(ik * (length_ - z));
  return {f + b, f - b};
}

BloodPoint<Complex> TubeWaves::blood(double radius, double z) const {
  const BloodPoint<Complex> point = wave_.blood(radius);
  const auto [even, odd] = factors(z);
  return {even * point.pressure, combined(point.velocity, even, odd), combined(point.gradient, even, odd),
          combined(point.stress, even, odd)};
}

WallPoint<Complex> TubeWaves::wall(double radius, double z) const {
  const WallPoint<Complex> point = wave_.wall(radius);
  const auto [even, odd] = factors(z);
  return {combined(point.displacement, even, odd), combined(point.gradient, even, odd),
          combined(point.stress, even, odd)};
}

Complex TubeWaves::phase(double time) const {
  return std::polar(1.0, -wave_.angular_frequency() * time);
}

BloodPoint<double> TubeWaves::blood(double radius, double z, double time) const {
  return at_phase(blood(radius, z), phase(time));
}
WallPoint<double> TubeWaves::wall(double radius, double z, double time) const {
  return at_phase(wall(radius, z), phase(time));
}
Vector<double> TubeWaves::wall_velocity(double radius, double z, double time) const {
  const Complex rate(0, -wave_.angular_frequency());
  return at_phase(wall(radius, z).displacement, rate * phase(time));
}
Vector<double> TubeWaves::wall_acceleration(double radius, double z, double time) const {
  const Complex rate(0, -wave_.angular_frequency());
  return at_phase(wall(radius, z).displacement, rate * rate * phase(time));
}

}  // namespace tunica::test_support
