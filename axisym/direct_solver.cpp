// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/direct_solver.hpp"

#include <new>

namespace tunica::axisym {

DirectSolver::DirectSolver() {
  klu_defaults(&common_);
  // The equations are one irreducible block, and fill grows less with the diagonal preferred.
  common_.btf = 0;
  common_.tol = 1e-3;
}

DirectSolver::~DirectSolver() {
  klu_free_numeric(&numeric_, &common_);
  klu_free_symbolic(&symbolic_, &common_);
}

void DirectSolver::forget() {
  klu_free_numeric(&numeric_, &common_);
}

bool DirectSolver::factorise(SparseMatrix& matrix) {
  int* const columns = matrix.outerIndexPtr();
  int* const rows = matrix.innerIndexPtr();
  double* const values = matrix.valuePtr();
  if (!symbolic_) symbolic_ = klu_analyze(static_cast<int>(matrix.rows()), columns, rows, &common_);
  if (!symbolic_) throw std::bad_alloc();
  if (numeric_) {
    // Growth of entries by elimination, 1 for perfect pivots: below this, pivots of another matrix do harm.
    constexpr double least_growth = 1e-8;
    const bool done = klu_refactor(columns, rows, values, symbolic_, numeric_, &common_) != 0 &&
                      klu_rgrowth(columns, rows, values, symbolic_, numeric_, &common_) != 0;
    if (done && common_.status == KLU_OK && common_.rgrowth > least_growth) return true;
    forget();
  }
  numeric_ = klu_factor(columns, rows, values, symbolic_, &common_);
  if (!numeric_ && common_.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
  return numeric_ && common_.status == KLU_OK;
}

void DirectSolver::solve(std::span<double> right_hand_side) const {
  if (klu_solve(symbolic_, numeric_, static_cast<int>(right_hand_side.size()), 1, right_hand_side.data(),
                &common_) == 0)
    throw std::runtime_error("klu_solve: no factors of a matrix of this size");
}

double DirectSolver::entries() const {
  return numeric_ ? static_cast<double>(numeric_->lnz) + static_cast<double>(numeric_->unz) : 0;
}

}  // namespace tunica::axisym
