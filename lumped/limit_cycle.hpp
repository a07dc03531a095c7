// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lumped/integrator.hpp"

namespace tunica::lumped {

/// A state that repeats after one period, and its derivatives with respect to the parameters.
struct LimitCycle {
  std::vector<double> state;
  std::vector<std::vector<double>> derivatives;
  IntegratorStatistics statistics;
};

/// Solves Phi(y) = y by Newton's method, Phi being the state one period later. Its Jacobian M, the
/// monodromy matrix, comes from forward sensitivities to the initial state, and the derivatives of the
/// solution from (I - M) dy/dtheta = dPhi/dtheta.
/// `parameters`: the sensitivities wanted. Throws SolverFailure when there is no convergence.
LimitCycle find_limit_cycle(const System& system, const std::vector<double>& guess, double period,
                            const std::vector<Sensitivity>& parameters, double tolerance);

}  // namespace tunica::lumped
