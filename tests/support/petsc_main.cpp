// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the tests of a program that needs PETSc, in one process.
#include <gtest/gtest.h>

#include "full3d/petsc.hpp"

// A sanitised program looks for no leaks: Open MPI leaves memory behind with parts of it that it unloads.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "detect_leaks=0";
}

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  const tunica::full3d::PetscSession petsc;
  return RUN_ALL_TESTS();
}
