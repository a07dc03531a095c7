// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/chebyshev.hpp"

#include <cmath>
#include <numbers>

namespace tunica {

ChebyshevBasis::ChebyshevBasis(int terms) : terms_(terms) {
  for (int k = 0; k < terms; ++k) nodes_.push_back(std::cos(std::numbers::pi * (k + 0.5) / terms));
  for (int j = 0; j < terms; ++j)
    for (int k = 0; k < terms; ++k) cosines_.push_back(std::cos(std::numbers::pi * j * (k + 0.5) / terms));
}

void ChebyshevBasis::fit(std::span<const double> values, std::span<double> series) const {
  for (int j = 0; j < terms_; ++j) {
    double sum = 0;
    for (int k = 0; k < terms_; ++k) sum += cosines_[j * terms_ + k] * values[k];
    series[j] = sum * (j == 0 ? 1.0 : 2.0) / terms_;
  }
}

}  // namespace tunica
