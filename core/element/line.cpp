// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/element/line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tunica::element {

namespace {

/// Barycentric weight of Chebyshev-Lobatto node k (Berrut and Trefethen, SIAM Rev. 46:501, 2004).
double barycentric_weight(int k, int degree) {
  const double sign = k % 2 == 0 ? 1.0 : -1.0;
  return k == 0 || k == degree ? 0.5 * sign : sign;
}

}  // namespace

Line::Line(int degree, int points) : degree_(degree), rule_(gauss_legendre(points)) {
  const int n = nodes();
  nodes_.resize(n);
  for (int k = 0; k < n; ++k) nodes_[k] = -std::cos(std::numbers::pi * k / degree);
  differentiation_.assign(n * n, 0.0);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      if (k == i) continue;
      const double d =
          barycentric_weight(k, degree) / barycentric_weight(i, degree) / (nodes_[i] - nodes_[k]);
      differentiation_[i * n + k] = d;
      differentiation_[i * n + i] -= d;
    }
  }
  shape_.resize(rule_.size() * n);
  slope_.resize(rule_.size() * n);
  for (std::size_t q = 0; q < rule_.size(); ++q) {
    shapes_at(rule_[q].position, &shape_[q * n]);
    slopes_at(rule_[q].position, &slope_[q * n]);
  }
}

void Line::shapes_at(double position, double* out) const {
  const int n = nodes();
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    const double distance = position - nodes_[k];
    if (distance == 0) {
      for (int j = 0; j < n; ++j) out[j] = j == k ? 1.0 : 0.0;
      return;
    }
    out[k] = barycentric_weight(k, degree_) / distance;
    sum += out[k];
  }
  for (int k = 0; k < n; ++k) out[k] /= sum;
}

void Line::slopes_from(const double* shapes, double* out) const {
  const int n = nodes();
  std::fill_n(out, n, 0.0);
  for (int i = 0; i < n; ++i) {
    const double* row = &differentiation_[i * n];
    for (int k = 0; k < n; ++k) out[k] += shapes[i] * row[k];
  }
}

void Line::slopes_at(double position, double* out) const {
  std::vector<double> shapes(nodes());
  shapes_at(position, shapes.data());
  slopes_from(shapes.data(), out);
}

}  // namespace tunica::element
