// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/womersley.hpp"

#include <cmath>
#include <numbers>

namespace tunica::test_support {

namespace {

/// (I0(x) - 1) / (x/2)^2
LongComplex excess(LongComplex x) {
  const LongComplex quarter = 0.25L * x * x;
  LongComplex term = 1, sum = 1;
  for (int k = 2; std::abs(term) > 1e-21L * std::abs(sum); ++k) {
    term *= quarter / static_cast<long double>(k * k);
    sum += term;
  }
  return sum;
}

/// I2(x) / x^2
LongComplex second_ratio(LongComplex x) {
  return x == LongComplex(0) ? 0.125L : bessel_i(x).two / (x * x);
}

/// I1(x) / x
LongComplex first_ratio(LongComplex x) {
  const BesselI i = bessel_i(x);
  return 0.5L * (i.zero - i.two);
}

Complex rounded(LongComplex z) {
  return {static_cast<double>(z.real()), static_cast<double>(z.imag())};
}

}  // namespace

Womersley::Womersley(const RigidPipe& pipe, double angular_frequency, Complex gradient)
    : pipe_(pipe), angular_frequency_(angular_frequency), gradient_(gradient) {
  const long double rate = static_cast<long double>(angular_frequency) * pipe.density / pipe.viscosity;
  s_ = std::sqrt(LongComplex(0, -rate));
  at_wall_ = bessel_i(s_ * static_cast<long double>(pipe.radius)).zero;
}

Womersley Womersley::from_gradient(const RigidPipe& pipe, double angular_frequency, Complex gradient) {
  return {pipe, angular_frequency, gradient};
}

Womersley Womersley::from_flow(const RigidPipe& pipe, double angular_frequency, Complex flow) {
  return {pipe, angular_frequency, flow / Womersley(pipe, angular_frequency, 1).flow()};
}

double Womersley::number() const {
  return pipe_.radius * std::sqrt(angular_frequency_ * pipe_.density / pipe_.viscosity);
}

Complex Womersley::flow() const {
  const long double radius = pipe_.radius;
  const LongComplex ratio = second_ratio(s_ * radius) / at_wall_;
  return gradient_ * rounded(std::numbers::pi_v<long double> * std::pow(radius, 4) / pipe_.viscosity * ratio);
}

Complex Womersley::velocity(double radius) const {
  const long double r = radius, wall = pipe_.radius;
  LongComplex gap;  // (I0(sR) - I0(sr)) / s^2
  // The difference loses digits at small arguments, the powers of x at large ones.
  if (std::abs(s_ * wall) > 3)
    gap = (at_wall_ - bessel_i(s_ * r).zero) / (s_ * s_);
  else
    gap = 0.25L * (wall * wall * excess(s_ * wall) - r * r * excess(s_ * r));
  return gradient_ * rounded(gap / (at_wall_ * static_cast<long double>(pipe_.viscosity)));
}

Complex Womersley::slope(double radius) const {
  const long double r = radius;
  return -gradient_ *
         rounded(r * first_ratio(s_ * r) / (at_wall_ * static_cast<long double>(pipe_.viscosity)));
}

Complex Womersley::wall_shear() const {
  return -pipe_.viscosity * slope(pipe_.radius);
}

double Womersley::real(Complex amplitude, double time) const {
  return (amplitude * std::polar(1.0, -angular_frequency_ * time)).real();
}
double Womersley::gradient(double time) const {
  return real(gradient_, time);
}
double Womersley::flow(double time) const {
  return real(flow(), time);
}
double Womersley::velocity(double radius, double time) const {
  return real(velocity(radius), time);
}
double Womersley::slope(double radius, double time) const {
  return real(slope(radius), time);
}
double Womersley::wall_shear(double time) const {
  return real(wall_shear(), time);
}

}  // namespace tunica::test_support
