// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>

#include "core/tensor.hpp"

/// What an exact solution says at one point. Tensor axes are (r, theta, z), gradients have the derivative's
/// direction second: gradient(0, 2) = d u_r / dz, gradient(1, 1) = u_r / r.
namespace tunica::test_support {

template <class S>
struct BloodPoint {
  S pressure;
  Vector<S> velocity;
  Tensor<S> gradient;  ///< of the velocity
  Tensor<S> stress;    ///< -p I + mu (grad v + grad v^T)
};

template <class S>
struct WallPoint {
  Vector<S> displacement;
  Tensor<S> gradient;
  Tensor<S> stress;  ///< lambda tr(e) I + 2 G e of the small strain e
};

/// Real part of complex amplitudes times a phase factor such as e^{-i w t}.
inline double at_phase(std::complex<double> amplitude, std::complex<double> factor) {
  return (amplitude * factor).real();
}
inline Vector<double> at_phase(const Vector<std::complex<double>>& amplitude, std::complex<double> factor) {
  return {at_phase(amplitude[0], factor), at_phase(amplitude[1], factor), at_phase(amplitude[2], factor)};
}
inline Tensor<double> at_phase(const Tensor<std::complex<double>>& amplitude, std::complex<double> factor) {
  Tensor<double> t;
  for (int k = 0; k < 9; ++k) t.entries[k] = at_phase(amplitude.entries[k], factor);
  return t;
}
inline BloodPoint<double> at_phase(const BloodPoint<std::complex<double>>& amplitude,
                                   std::complex<double> factor) {
  return {at_phase(amplitude.pressure, factor), at_phase(amplitude.velocity, factor),
          at_phase(amplitude.gradient, factor), at_phase(amplitude.stress, factor)};
}
inline WallPoint<double> at_phase(const WallPoint<std::complex<double>>& amplitude,
                                  std::complex<double> factor) {
  return {at_phase(amplitude.displacement, factor), at_phase(amplitude.gradient, factor),
          at_phase(amplitude.stress, factor)};
}

}  // namespace tunica::test_support
