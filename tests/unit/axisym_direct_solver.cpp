// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/direct_solver.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace tunica::axisym {
namespace {

SparseMatrix matrix_of(double a, double b, double c, double d) {
  SparseMatrix matrix(2, 2);
  matrix.insert(0, 0) = a;
  matrix.insert(0, 1) = b;
  matrix.insert(1, 0) = c;
  matrix.insert(1, 1) = d;
  matrix.makeCompressed();
  return matrix;
}

TEST(DirectSolver, SolvesWithTheLatestMatrix) {
  DirectSolver solver;
  SparseMatrix first = matrix_of(4, 1, 2, 3), second = matrix_of(2, 1, 1, 3);
  ASSERT_TRUE(solver.factorise(first));
  std::vector<double> x{9, 7};
  solver.solve(x);
  EXPECT_DOUBLE_EQ(x[0], 2);
  EXPECT_DOUBLE_EQ(x[1], 1);
  ASSERT_TRUE(solver.factorise(second));
  x = {5, 10};
  solver.solve(x);
  EXPECT_DOUBLE_EQ(x[0], 1);
  EXPECT_DOUBLE_EQ(x[1], 3);
}

TEST(DirectSolver, GivesNoSolutionWithoutFactors) {
  DirectSolver solver;
  std::vector<double> x{1, 2};
  EXPECT_THROW(solver.solve(x), std::runtime_error);
  SparseMatrix singular = matrix_of(1, 2, 2, 4);
  EXPECT_FALSE(solver.factorise(singular));
  SparseMatrix regular = matrix_of(4, 1, 2, 3);
  ASSERT_TRUE(solver.factorise(regular));
  solver.forget();
  EXPECT_THROW(solver.solve(x), std::runtime_error);
  EXPECT_EQ(x, (std::vector<double>{1, 2}));
}

}  // namespace
}  // namespace tunica::axisym
