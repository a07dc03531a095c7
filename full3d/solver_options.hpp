// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "full3d/share.hpp"

namespace tunica::full3d {

/// Names of the sets of options in full3d/solvers/, which solver.method takes.
std::vector<std::string> solver_names();

/// Puts the options of a choice into PETSc's database: those of its set, over them those that it gives, over
/// both those of the environment (PETSC_OPTIONS).
/// Throws InvalidInput for a text that is not a list of options.
void insert_options(const SolverChoice& choice);

/// Sets up a solver of a small system with a choice, before any work with it.
/// Throws InvalidInput for options that PETSc refuses.
void try_options(const SolverChoice& choice);

/// Options in the database that nothing has asked for.
std::vector<std::string> unused_options();

/// Entries of the factors of a direct solver; 0 for other preconditioners.
double factor_entries(PC pc);

}  // namespace tunica::full3d
