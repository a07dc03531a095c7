// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/quadrature.hpp"

namespace tunica::element {

/// Lagrange element of any degree on [-1, 1] with Chebyshev-Lobatto nodes x_k = -cos(pi k/degree),
/// tabulated at the points of a Gauss-Legendre rule.
class Line {
 public:
  Line(int degree, int points);

  int degree() const { return degree_; }
  int nodes() const { return degree_ + 1; }
  double node(int k) const { return nodes_[k]; }
  const std::vector<QuadraturePoint>& rule() const { return rule_; }

  /// Shape function k and its derivative at quadrature point q.
  double shape(std::size_t q, int k) const { return shape_[q * nodes() + k]; }
  double slope(std::size_t q, int k) const { return slope_[q * nodes() + k]; }

  /// All shape functions, or all their derivatives, at any position in [-1, 1]; `out` has nodes()
  /// entries.
  void shapes_at(double position, double* out) const;
  void slopes_at(double position, double* out) const;
  /// The derivatives at a position where the shape functions are already known.
  void slopes_from(const double* shapes, double* out) const;

 private:
  int degree_;
  std::vector<double> nodes_;
  std::vector<double> differentiation_;  ///< D_ik = l_k'(x_i)
  std::vector<QuadraturePoint> rule_;
  std::vector<double> shape_, slope_;
};

}  // namespace tunica::element
