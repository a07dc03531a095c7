// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <limits>

namespace tunica::test_support {

using Complex = std::complex<double>;
/// Bessel functions are differenced in the exact solutions, so that they carry more digits than those report.
using LongComplex = std::complex<long double>;
static_assert(std::numeric_limits<long double>::digits >= 64, "exact solutions need extended precision");

/// Modified Bessel functions of orders 0, 1, 2 of one complex argument. Order 2 stands for what is singular
/// by sight: 2 I1(z)/z = I0 - I2, 2 I1' = I0 + I2.
struct BesselI {
  LongComplex zero, one, two;
};
struct BesselK {
  LongComplex zero, one, two;
};

/// I0, I1, I2(z) for any z with |z| up to about 1e4, each to some 1e-17 of |e^z| or of itself, whichever is
/// larger: recurrence downwards, normalised by I0 + 2 sum I_n = e^z (J. C. P. Miller; DLMF 10.35.4).
BesselI bessel_i(LongComplex z);

/// K0, K1, K2(z) for Re z >= 0, z != 0: Neumann's series for |z| <= 2 (DLMF 10.44.5 and the Wronskian), else
/// the continued fraction of N. M. Temme, J. Comput. Phys. 19 (1975) 324. Throws std::domain_error elsewhere.
BesselK bessel_k(LongComplex z);

}  // namespace tunica::test_support
