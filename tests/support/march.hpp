// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "core/coupled/simulation.hpp"

namespace tunica::test_support {

/// Takes the steps of a time scheme that has been started; `after` sees the scheme after each. False, with
/// a test failure, when a step is not solved.
inline bool march(const coupled::Equations& equations, time::Scheme& scheme, const std::vector<double>& steps,
                  double newton_tolerance, const std::function<void()>& after = {}) {
  coupled::Newton newton(equations);
  coupled::ExpectedMesh mesh(equations.layout());
  std::vector<double> state(equations.layout().size());
  for (const double step : steps) {
    const time::Stage& at = scheme.begin(step);
    std::copy(scheme.prediction().begin(), scheme.prediction().end(), state.begin());
    const auto report = newton.solve(mesh.stage(scheme, at.time), state, {newton_tolerance, 30});
    if (!report.converged) {
      ADD_FAILURE() << "at " << at.time << " s: " << report.failure;
      return false;
    }
    equations.follow(at.time, state);
    scheme.accept(state);
    if (after) after();
  }
  return true;
}

}  // namespace tunica::test_support
