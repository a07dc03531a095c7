// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "core/coupled/simulation.hpp"

namespace tunica::coupled {

struct LimitCycleReport {
  int periods = 0;  ///< computed
  /// Of the state in the last of them, or the distance that is estimated to be left where that is greater,
  /// relative to the ranges that the wall's displacement and the outlet's charge have in a period.
  double change = 0;
};

struct LimitCycle {
  std::vector<double> state, rates;
};

/// A state that repeats after one period: the fixed point of the map that takes a state one period on, by
/// Anderson's acceleration from `guess`. What decays slowly, the charge of the outlet's compliance and of the
/// wall, is a few modes.
/// Throws SolverFailure when `most` periods do not bring the change per period below a tenth of `tolerance`,
/// and what is left as far as the acceleration knows below three tenths. `interrupted` is asked between
/// steps; when it says so, an empty state is returned.
LimitCycle limit_cycle(Simulation& simulation, std::vector<double> guess, double period, double tolerance,
                       const std::function<bool()>& interrupted, LimitCycleReport& report, int most = 40);

}  // namespace tunica::coupled
