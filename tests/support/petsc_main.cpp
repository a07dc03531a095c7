// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the tests of a program that needs PETSc, in one process.
#include <gtest/gtest.h>

#include "full3d/petsc.hpp"

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  const tunica::full3d::PetscSession petsc;
  return RUN_ALL_TESTS();
}
