// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/bessel.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tunica::test_support {

namespace {

struct Recurrence {
  BesselI i;
  LongComplex neumann;  ///< 2 sum_{k >= 1} I_2k / k
};

/// I_{n-1} = I_{n+1} + (2n/z) I_n, stable downwards; z != 0, Re z >= 0.
Recurrence recur(LongComplex z) {
  const long double size = std::abs(z);
  // I_n is below 1e-20 of I_0 from there on, on the imaginary axis too.
  const int start = static_cast<int>(size + 15 * std::cbrt(size)) + 26;
  LongComplex above = 0, current = 1e-3000L, sum = 0, neumann = 0, two = 0;
  for (int n = start; n > 0; --n) {
    if (n == 2) two = current;
    sum += current;
    if (n % 2 == 0) neumann += 2.0L / n * current;
    const LongComplex below = above + (2.0L * n) / z * current;
    above = current;
    current = below;
  }
  const LongComplex factor = std::exp(z) / (current + 2.0L * sum);
  return {{factor * current, factor * above, factor * two}, 2.0L * factor * neumann};
}

/// K0 and K1 by Steed's evaluation of Temme's continued fraction.
BesselK fraction(LongComplex z) {
  const LongComplex one = 1;
  LongComplex b = 2.0L * (one + z), d = one / b, h = d, step = d, q1 = 0, q2 = 1, q = 0.25L, c = 0.25L;
  long double a = -0.25L;
  LongComplex sum = one + q * step;
  for (int n = 2; n < 2000; ++n) {
    a -= 2.0L * (n - 1);
    c = -a * c / static_cast<long double>(n);
    const LongComplex next = (q1 - b * q2) / a;
    q1 = q2;
    q2 = next;
    q += c * next;
    b += 2.0L;
    d = one / (b + a * d);
    step = (b * d - one) * step;
    h += step;
    const LongComplex change = q * step;
    sum += change;
    if (std::abs(change) < 1e-20L * std::abs(sum)) {
      const LongComplex k0 = std::sqrt(std::numbers::pi_v<long double> / (2.0L * z)) * std::exp(-z) / sum;
      const LongComplex k1 = k0 * (z + 0.5L - 0.25L * h) / z;
      return {k0, k1, k0 + 2.0L * k1 / z};
    }
  }
  throw std::domain_error("bessel_k: the continued fraction does not converge");
}

}  // namespace

BesselI bessel_i(LongComplex z) {
  if (z == LongComplex(0)) return {1, 0, 0};
  if (z.real() >= 0) return recur(z).i;
  const BesselI i = recur(-z).i;
  return {i.zero, -i.one, i.two};
}

BesselK bessel_k(LongComplex z) {
  if (z.real() < 0 || z == LongComplex(0)) throw std::domain_error("bessel_k: Re z < 0 or z = 0");
  if (std::abs(z) > 2) return fraction(z);
  const auto [i, neumann] = recur(z);
  const LongComplex k0 = neumann - (std::log(0.5L * z) + std::numbers::egamma_v<long double>)*i.zero;
  const LongComplex k1 = (1.0L / z - i.one * k0) / i.zero;
  return {k0, k1, k0 + 2.0L * k1 / z};
}

}  // namespace tunica::test_support
