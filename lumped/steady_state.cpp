// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/steady_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/linear/band_matrix.hpp"
#include "lumped/multistep.hpp"

namespace tunica::lumped {

namespace {

/// df/dy at a state. Columns further apart than the band share a directional derivative.
linear::BandMatrix jacobian(const System& system, double time, const std::vector<double>& y) {
  const int n = system.unknowns, band = system.bandwidth, stride = 2 * band + 1;
  linear::BandMatrix matrix;
  matrix.reset(n, band);
  std::vector<double> direction(n), column(n);
  for (int first = 0; first < std::min(stride, n); ++first) {
    for (int j = 0; j < n; ++j) direction[j] = j % stride == first ? system.scales[j] : 0;
    system.rate_derivative(time, y.data(), direction.data(), -1, column.data());
    for (int j = first; j < n; j += stride)
      for (int i = std::max(0, j - band); i <= std::min(n - 1, j + band); ++i)
        matrix.add(i, j, column[i] / system.scales[j]);
  }
  return matrix;
}

/// Newton's method from y. False, with y anywhere, when it does not arrive.
bool solve(const System& system, double time, std::vector<double>& y, long& iterations) {
  constexpr int most_iterations = 20;
  // Convergence is quadratic, so that the update after one of this size is round-off.
  constexpr double small_update = 1e-9;
  std::vector<double> update(y.size());
  try {
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      system.rate(time, y.data(), update.data());
      linear::BandMatrix matrix = jacobian(system, time, y);
      if (!matrix.factorise()) return false;
      matrix.solve(update);
      ++iterations;
      double size = 0;
      for (std::size_t i = 0; i < y.size(); ++i) {
        y[i] -= update[i];
        // A sum, so that an update that is no number counts as large.
        size += std::abs(update[i]) / system.scales[i];
      }
      if (size < small_update) return true;
    }
  } catch (const SolverFailure&) {
    // An update has left the states that the wall can take.
  }
  return false;
}

}  // namespace

SteadyState find_steady_state(const System& given, const std::vector<double>& guess, double time, double span,
                              const std::vector<Sensitivity>& parameters) {
  System system = given;
  system.events = 0;
  system.rate = [&](double, const double* y, double* rate) { given.rate(time, y, rate); };

  SteadyState steady;
  // The way there does not matter.
  constexpr double tolerance = 1e-4, most_spans = 1000;
  Multistep integrator(system, {}, tolerance);
  integrator.start(0, most_spans * span, guess, {});
  bool found = false;
  for (double spans = 1; !found && spans <= most_spans; spans *= 10) {
    integrator.advance(spans * span);
    steady.state.assign(integrator.state(), integrator.state() + system.unknowns);
    found = solve(system, time, steady.state, steady.statistics.newton_iterations);
  }
  const IntegratorStatistics approach = integrator.statistics();
  steady.statistics.steps += approach.steps;
  steady.statistics.newton_iterations += approach.newton_iterations;
  steady.statistics.rejected_steps += approach.rejected_steps;
  if (!found)
    throw SolverFailure(
        "no steady state was found: the artery does not come to rest under the inlet's value at the start, "
        "or Newton's method on its balances does not converge; start from rest");

  if (parameters.empty()) return steady;
  linear::BandMatrix matrix = jacobian(system, time, steady.state);
  if (!matrix.factorise())
    throw SolverFailure("the steady state has no derivatives: the balances are singular");
  const std::vector<double> still(system.unknowns, 0.0);
  for (const Sensitivity& sensitivity : parameters) {
    std::vector<double> derivative(system.unknowns);
    system.rate_derivative(time, steady.state.data(), still.data(), sensitivity.parameter, derivative.data());
    for (double& entry : derivative) entry = -entry;
    matrix.solve(derivative);
    steady.derivatives.push_back(std::move(derivative));
  }
  return steady;
}

}  // namespace tunica::lumped
