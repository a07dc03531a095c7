// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "full3d/resolution.hpp"

namespace tunica::full3d {

/// Throws InvalidInput for options that are not a list of "-name" and "-name value", that name a solver,
/// preconditioner, package or ordering that PETSc has not, at whatever level of the solver ("-sub_pc_type"),
/// or that are known to do harm.
void check_options(const SolverChoice& choice);

/// Solves the equations of a vessel of a few cells with the choice, whose name is that of a method, before
/// any work with it; not without options of the user's. `with_blood`: the vessel has any.
/// Throws InvalidInput for options that PETSc refuses.
void try_options(const SolverChoice& choice, bool with_blood, bool lagged_mesh);

}  // namespace tunica::full3d
