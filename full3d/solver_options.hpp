// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "full3d/share.hpp"

namespace tunica::full3d {

/// The method that "auto" stands for with so many unknowns: direct up to 300,000, beyond which its factors
/// outgrow memory; other names as they are.
std::string method_for(const std::string& name, int unknowns);

/// Puts the options of a choice into PETSc's database: those of its set, over them those that it gives, over
/// both those of the environment (PETSC_OPTIONS). The number of rows of the rank sets that of the parts of
/// additive Schwarz methods.
void insert_options(const SolverChoice& choice, int rows);
/// Throws InvalidInput for options that are not a list of "-name" and "-name value".
void check_options(const SolverChoice& choice);

/// Sets up a solver of a small system with a choice, before any work with it.
/// Throws InvalidInput for options that PETSc refuses.
void try_options(const SolverChoice& choice);

/// Options of a choice and of the environment that nothing has asked for.
std::vector<std::string> unused_options(const SolverChoice& choice);

/// Entries of the factors of a direct solver; 0 for other preconditioners.
double factor_entries(PC pc);

}  // namespace tunica::full3d
