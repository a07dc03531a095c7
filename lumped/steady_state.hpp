// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lumped/integrator.hpp"

namespace tunica::lumped {

/// A state that stays as it is while the inlet's value does, and its derivatives with respect to the
/// parameters.
struct SteadyState {
  std::vector<double> state;
  std::vector<std::vector<double>> derivatives;
  IntegratorStatistics statistics;
};

/// Solves f(time, y) = 0 by Newton's method, and J dy/dtheta = -df/dtheta with J = df/dy. It begins where the
/// system with its time held comes to from `guess` after `span`: close, and on the branch of equilibria that
/// the artery takes when it is loaded. Where that is not close enough the system is given ten times longer,
/// up to a thousand spans. `parameters`: the sensitivities wanted. Throws SolverFailure when there is no such
/// state.
SteadyState find_steady_state(const System& system, const std::vector<double>& guess, double time,
                              double span, const std::vector<Sensitivity>& parameters);

}  // namespace tunica::lumped
