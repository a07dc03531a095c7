// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/linear/band_matrix.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

#include <cmath>

#include "core/gsl.hpp"

namespace tunica::linear {

void BandMatrix::reset(std::size_t size, std::size_t bandwidth) {
  size_ = size;
  bandwidth_ = bandwidth < size ? bandwidth : size - 1;
  storage_.assign(size_ * stride(), 0.0);
  pivots_.resize(size_);
}

bool BandMatrix::factorise() {
  for (const double entry : storage_)
    if (!std::isfinite(entry)) return false;
  let_gsl_return_codes();
  gsl_matrix_view matrix = gsl_matrix_view_array(storage_.data(), size_, stride());
  gsl_vector_uint_view pivots = gsl_vector_uint_view_array(pivots_.data(), size_);
  if (gsl_linalg_LU_band_decomp(size_, bandwidth_, bandwidth_, &matrix.matrix, &pivots.vector) != GSL_SUCCESS)
    return false;
  for (std::size_t k = 0; k < size_; ++k)
    if (storage_[k * stride() + 2 * bandwidth_] == 0) return false;
  return true;
}

void BandMatrix::solve(std::span<double> x) const {
  const gsl_matrix_const_view matrix = gsl_matrix_const_view_array(storage_.data(), size_, stride());
  const gsl_vector_uint_const_view pivots = gsl_vector_uint_const_view_array(pivots_.data(), size_);
  gsl_vector_view vector = gsl_vector_view_array(x.data(), size_);
  check_gsl(gsl_linalg_LU_band_svx(bandwidth_, bandwidth_, &matrix.matrix, &pivots.vector, &vector.vector),
            "gsl_linalg_LU_band_svx");
}

}  // namespace tunica::linear
