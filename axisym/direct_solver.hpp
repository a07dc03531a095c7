// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <klu.h>

#include <Eigen/SparseCore>
#include <span>

namespace tunica::axisym {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor>;

/// Sparse LU factorisation for a matrix whose pattern stays the same (KLU of SuiteSparse: Davis and Palamadai
/// Natarajan, ACM Trans. Math. Softw. 37:36, 2010). The ordering is found once; the pivots of the first
/// factorisation are used again while they are good.
class DirectSolver {
 public:
  DirectSolver();
  ~DirectSolver();
  DirectSolver(const DirectSolver&) = delete;
  DirectSolver& operator=(const DirectSolver&) = delete;

  /// False when the matrix is singular to working precision.
  bool factorise(SparseMatrix& matrix);
  /// Overwrites the right-hand side with the solution. Needs a factorisation.
  void solve(std::span<double> right_hand_side) const;
  /// Forgets the pivots: the next factorisation depends on its matrix alone.
  void forget();
  /// Entries of L and U.
  double entries() const;

 private:
  mutable klu_common common_;
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
};

}  // namespace tunica::axisym
