// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tunica::linear {

/// Square matrix with `bandwidth` diagonals on either side of the main one, factorised with partial
/// pivoting by GSL. Cost of a factorisation: of the order of size * bandwidth^2.
class BandMatrix {
 public:
  /// Sets all entries to 0; storage is kept when the size stays.
  void reset(std::size_t size, std::size_t bandwidth);
  std::size_t size() const { return size_; }

  void add(std::size_t row, std::size_t column, double value) {
    storage_[column * stride() + 2 * bandwidth_ + row - column] += value;
  }

  /// Replaces the entries by their factors. False when the matrix is singular or not finite.
  bool factorise();
  /// Solves A x = b in place, after factorise().
  void solve(std::span<double> x) const;

 private:
  /// Each column keeps its band and room for the rows that pivoting brings in (GSL's banded format).
  std::size_t stride() const { return 3 * bandwidth_ + 1; }

  std::size_t size_ = 0, bandwidth_ = 0;
  std::vector<double> storage_;
  std::vector<unsigned> pivots_;
};

}  // namespace tunica::linear
