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
/// The options that a user gives: those of a choice and of the environment, which go before them.
std::string given_options(const SolverChoice& choice);
/// Words between blanks.
std::vector<std::string> words_in(const std::string& text);

/// Options of a choice and of the environment that nothing has asked for.
std::vector<std::string> unused_options(const SolverChoice& choice);

/// Entries of the factors of a direct solver; 0 for other preconditioners.
double factor_entries(PC pc);

}  // namespace tunica::full3d
