// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <numbers>

namespace tunica::test_support {

/// The amplitude a of Re(a e^{-i w t}) in a signal that is sampled at equal steps over whole periods.
class Harmonic {
 public:
  explicit Harmonic(double angular_frequency) : angular_frequency_(angular_frequency) {}
  void add(double time, double value) {
    sum_ += value * std::polar(1.0, angular_frequency_ * time);
    ++count_;
  }
  std::complex<double> amplitude() const { return 2.0 * sum_ / static_cast<double>(count_); }

 private:
  double angular_frequency_;
  std::complex<double> sum_;
  long count_ = 0;
};

}  // namespace tunica::test_support
