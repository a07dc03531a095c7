// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace tunica {

struct QuadraturePoint {
  double position;
  double weight;
};

/// Gauss-Legendre rule on [-1, 1], exact for polynomials of degree 2 points - 1 (nodes from GSL).
std::vector<QuadraturePoint> gauss_legendre(int points);

}  // namespace tunica
