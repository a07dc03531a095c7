// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

namespace tunica {

/// Chebyshev series sum_j c_j T_j(x) on [-1, 1] of so many terms, from values at the nodes of the first kind.
class ChebyshevBasis {
 public:
  explicit ChebyshevBasis(int terms);

  int terms() const { return terms_; }
  /// x_k = cos(pi (k + 1/2)/terms): none is an end.
  double node(int k) const { return nodes_[k]; }

  /// The coefficients c_j of the polynomial through values at the nodes, by the discrete cosine transform.
  void fit(std::span<const double> values, std::span<double> series) const;

 private:
  int terms_;
  std::vector<double> nodes_;
  std::vector<double> cosines_;  ///< [term][node]
};

/// A series at x, by Clenshaw's recurrence.
inline double chebyshev_sum(std::span<const double> series, double x) {
  double b1 = 0, b2 = 0;
  for (std::size_t j = series.size() - 1; j > 0; --j) {
    const double b = 2 * x * b1 - b2 + series[j];
    b2 = b1;
    b1 = b;
  }
  return x * b1 - b2 + series[0];
}

}  // namespace tunica
