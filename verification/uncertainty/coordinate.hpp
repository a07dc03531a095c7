// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "verification/uncertainty/marginal.hpp"

namespace tunica::uncertainty {

/// The variable z in which surrogates see a number x of a distribution, and the polynomials p_n of z that are
/// orthonormal under its law: E[p_m p_n] = 1 where m = n, else 0.
///
///   uniform, triangular   z = (2 x - a - b) / (b - a);   log-uniform, the same of logarithms
///   normal                z = (x - mean) / deviation;    lognormal, the same of the logarithm
///
/// so that p_n are Legendre's polynomials, Hermite's, and for triangular ones those of Stieltjes' procedure:
///   sqrt(b_(n+1)) p_(n+1) = (z - a_n) p_n - sqrt(b_n) p_(n-1).
/// (Gautschi, Orthogonal Polynomials, 2004, sections 1.3 and 2.2.)
class Coordinate {
 public:
  static constexpr int highest_degree = 20;

  explicit Coordinate(const Marginal& law);

  /// z of a number; finite for all that the distribution can draw.
  double of(double x) const;
  /// p_0 to p_degree at z, degree at most highest_degree.
  void polynomials(double z, int degree, double* values) const;

  struct Node {
    double place, weight;  ///< z, and its share of the probability
  };
  /// Gauss's rule of the law, exact for polynomials of twice its size less one; the weights add to 1.
  const std::vector<Node>& quadrature() const { return quadrature_; }

 private:
  void find_recurrence();
  void find_quadrature();

  Marginal law_;
  std::vector<double> a_, b_;  ///< of the recurrence; b_0 is not used
  std::vector<Node> quadrature_;
};

}  // namespace tunica::uncertainty
