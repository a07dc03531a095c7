// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/limit_cycle.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace tunica::lumped {

namespace {

void add(IntegratorStatistics& total, const IntegratorStatistics& more) {
  total.steps += more.steps;
  total.newton_iterations += more.newton_iterations;
  total.rejected_steps += more.rejected_steps;
}

}  // namespace

LimitCycle find_limit_cycle(const System& given, const std::vector<double>& guess, double period,
                            const std::vector<Sensitivity>& parameters, double tolerance) {
  System system = given;
  system.events = 0;
  const int n = system.unknowns;

  LimitCycle cycle;
  // One period brings most of the way: the artery forgets its start within a fraction of a beat.
  {
    Integrator integrator(system, {}, tolerance);
    integrator.start(0, period, guess, {});
    integrator.advance(period);
    cycle.state.assign(integrator.state(), integrator.state() + n);
    add(cycle.statistics, integrator.statistics());
  }

  // Newton's method needs the monodromy matrix roughly. Steps that follow the state blur waves that
  // only the unit perturbations excite; to resolve those would cost a thousand times the state itself.
  const std::vector<Sensitivity> perturbations(n, Sensitivity{-1, 1.0});
  std::vector<std::vector<double>> identity(n, std::vector<double>(n, 0.0));
  for (int i = 0; i < n; ++i) identity[i][i] = system.scales[i];

  constexpr int most_iterations = 20;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Integrator integrator(system, perturbations, tolerance, Integrator::SensitivityErrors::followed);
    integrator.start(0, period, cycle.state, identity);
    integrator.advance(period);
    add(cycle.statistics, integrator.statistics());

    Eigen::MatrixXd map(n, n);  // I - M
    Eigen::VectorXd gap(n);
    double size = 0;
    for (int i = 0; i < n; ++i) {
      gap[i] = integrator.state()[i] - cycle.state[i];
      size = std::max(size, std::abs(gap[i]) / system.scales[i]);
      for (int j = 0; j < n; ++j)
        map(i, j) = (i == j ? 1.0 : 0.0) - integrator.sensitivity(j)[i] / system.scales[j];
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> factor(map);
    // The period map is known to about ten local errors; closer than that Newton cannot come.
    if (size < 10 * tolerance) {
      if (parameters.empty()) return cycle;
      Integrator forced(system, parameters, tolerance);
      forced.start(0, period, cycle.state, std::vector(parameters.size(), std::vector<double>(n, 0.0)));
      forced.advance(period);
      add(cycle.statistics, forced.statistics());
      for (std::size_t k = 0; k < parameters.size(); ++k) {
        const Eigen::Map<const Eigen::VectorXd> forcing(forced.sensitivity(static_cast<int>(k)), n);
        const Eigen::VectorXd derivative = factor.solve(forcing);
        cycle.derivatives.emplace_back(derivative.begin(), derivative.end());
      }
      return cycle;
    }
    const Eigen::VectorXd update = factor.solve(gap);
    for (int i = 0; i < n; ++i) cycle.state[i] += update[i];
  }
  throw SolverFailure(
      "no periodic state was found: Newton's method on the period map does not converge; start from rest");
}

}  // namespace tunica::lumped
