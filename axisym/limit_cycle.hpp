// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "axisym/simulation.hpp"

namespace tunica::axisym {

struct LimitCycleReport {
  int periods = 0;    ///< computed
  double change = 0;  ///< of the state in the last of them, relative to the fields' sizes
};

struct LimitCycle {
  std::vector<double> state, rates;
};

/// A state that repeats after one period: the fixed point of the map that takes a state one period on, by
/// Anderson's acceleration (Walker and Ni, SIAM J. Numer. Anal. 49:1715, 2011) from `guess`. What decays
/// slowly, the charge of the outlet's compliance and of the wall, is a few modes, which it finds within as
/// many periods. The state taken is that of the wall's displacement, the blood's velocity and the scalars.
/// Throws SolverFailure when `most` periods do not bring the change per period below a tenth of `tolerance`.
/// `interrupted` is asked between steps; when it says so, an empty state is returned.
LimitCycle limit_cycle(Simulation& simulation, std::vector<double> guess, double period, double tolerance,
                       const std::function<bool()>& interrupted, LimitCycleReport& report, int most = 40);

}  // namespace tunica::axisym
