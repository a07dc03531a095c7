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

/// Solves Phi(y) = y, Phi being the state one period later, by periods from `guess` on that Anderson's
/// acceleration combines, and the linear M dy/dtheta + dPhi/dtheta = dy/dtheta of the derivatives alike, with
/// the forward sensitivities of a period as its map. Neither needs the matrix M = dPhi/dy: nearly all that an
/// artery knows at the start of a period it has forgotten at its end.
/// `parameters`: the sensitivities wanted. Throws SolverFailure when there is no convergence.
LimitCycle find_limit_cycle(const System& system, const std::vector<double>& guess, double period,
                            const std::vector<Sensitivity>& parameters, double tolerance);

}  // namespace tunica::lumped
