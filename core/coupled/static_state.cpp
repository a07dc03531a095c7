// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/static_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/coupled/failure.hpp"
#include "core/error.hpp"
#include "core/radial/wall_curve.hpp"
#include "core/units.hpp"

namespace tunica::coupled {

namespace {

/// Displacement of the lumen, over its radius, that a ring of the wall at mid-length has under a share of the
/// load: what states under different loads are compared by, since it grows more evenly than the load. The
/// share itself where there is no ring or it does not bear the load.
class RingMeasure {
 public:
  /// For loads from none to that of `pressure`.
  RingMeasure(const Loading& loading, double pressure) : loading_(loading), pressure_(pressure) {
    if (!loading.ring || pressure == 0) return;
    try {
      double stretch = pressure > 0 ? 1.05 : 0.95;
      while (!exceeds(stretch, pressure)) {
        stretch = 1 + (stretch - 1) * 1.6;
        if (stretch > radial::WallCurve::greatest_stretch || stretch < radial::WallCurve::least_stretch)
          return;
      }
      most_ = stretch - 1;
    } catch (const SolverFailure&) {
      // Loads are the measure.
    }
  }

  double at(double load) const {
    if (most_ == 0) return load;
    constexpr double precision = 1e-5;  // a load's least step changes it by more
    double low = 0, high = most_;
    try {
      while (std::abs(high - low) > precision * std::abs(high)) {
        const double middle = 0.5 * (low + high);
        (exceeds(1 + middle, load * pressure_) ? high : low) = middle;
      }
    } catch (const SolverFailure&) {
      return load * most_;
    }
    return 0.5 * (low + high);
  }

 private:
  bool exceeds(double stretch, double pressure) const {
    const double p = loading_.ring->respond(stretch, {}, false).pressure;
    return pressure_ > 0 ? p > pressure : p < pressure;
  }

  const Loading& loading_;
  double pressure_;
  double most_ = 0;  ///< bound of the displacements over the radius; 0 where loads are the measure
};

/// States found so far and their measures, for a guess of the next by the polynomial through the last of
/// them.
class Past {
 public:
  void add(double measure, const std::vector<double>& state) {
    if (!measures_.empty() && measure == measures_.back()) {
      states_.back() = state;
      return;
    }
    measures_.push_back(measure);
    states_.push_back(state);
    if (states_.size() <= 3) return;
    measures_.erase(measures_.begin());
    states_.erase(states_.begin());
  }

  std::vector<double> extrapolate(double measure) const {
    std::vector<double> guess(states_.front().size(), 0.0);
    for (std::size_t k = 0; k < states_.size(); ++k) {
      double weight = 1;
      for (std::size_t j = 0; j < states_.size(); ++j)
        if (j != k) weight *= (measure - measures_[j]) / (measures_[k] - measures_[j]);
      for (std::size_t e = 0; e < guess.size(); ++e) guess[e] += weight * states_[k][e];
    }
    return guess;
  }
  const std::vector<double>& last() const { return states_.back(); }
  bool is_first() const { return states_.size() == 1; }

 private:
  std::vector<double> measures_;
  std::vector<std::vector<double>> states_;
};

/// Steady states on one mesh under the loads that a setup has at the time.
class Solver {
 public:
  Solver(const Loading& loading, const Equations& equations, Newton& newton, double time, double tolerance)
      : loading_(loading), equations_(equations), newton_(newton), time_(time), tolerance_(tolerance) {}

  const Equations& equations() const { return equations_; }
  Newton& newton() { return newton_; }

  NewtonReport solve(std::vector<double>& state) {
    return newton_.solve({time_, 0, {}}, state, {tolerance_, 60});
  }

  /// The steady state by backward Euler steps in time that grow until they are infinite, with the momentum of
  /// the wall taken out at each: for states from which Newton's method alone would not get there, such as a
  /// wall without stiffness at rest. `pressure` is what drives the wall. Reports the last step that was not
  /// solved when it is not reached.
  NewtonReport relax(double pressure, const std::function<bool()>& interrupted, std::vector<double>& state) {
    constexpr double largest = 1000, least = 1e-5;  // of the first coefficient
    // A wall that gives way moves on for ever; one that comes to rest takes a third of these.
    constexpr int most_in_all = 600, most_iterations = 25;
    const Layout& layout = equations_.layout();
    std::vector<double> history(layout.size()), candidate;
    const double first = first_coefficient(pressure);
    double coefficient = first, fall = 10;
    newton_.forget();
    NewtonReport unsolved;
    unsolved.failure = "the state does not come to rest";
    for (int iterations = 0; iterations < most_in_all && coefficient <= largest * first && !interrupted();) {
      for (std::size_t e = 0; e < history.size(); ++e) history[e] = -coefficient * state[e];
      for (const int node : layout.wall_nodes())
        for (int c = 0; c < layout.components(); ++c) history[layout.velocity(node, c)] = 0;
      candidate = state;
      auto report = newton_.solve({time_, coefficient, history}, candidate, {tolerance_, most_iterations});
      iterations += std::max(1, report.iterations);
      if (report.converged) {
        state = candidate;
        if (coefficient == 0) return report;
        coefficient = coefficient > least * first ? coefficient / fall : 0;
        fall = std::min(2 * fall, 10.0);
        continue;
      }
      unsolved = report;
      newton_.forget();
      coefficient = coefficient == 0 ? 10 * least * first : 4 * coefficient;
      fall = 2;
    }
    return unsolved;
  }

 private:
  /// Reciprocal of a step in which tissue that resists with the pressure that drives it would move by a third
  /// of its thickness: its inertia is then about as great as its stiffness, 1/s.
  double first_coefficient(double pressure) const {
    if (!loading_.ring) return 1e3;
    return 3 * std::sqrt(std::abs(pressure) / loading_.wall_density) / loading_.ring->ring().thickness;
  }

  const Loading& loading_;
  const Equations& equations_;
  Newton& newton_;
  double time_, tolerance_;
};

/// From rest in steps of the load.
std::vector<double> climb(Loading& loading, Solver& solver, double pressure,
                          const std::function<bool()>& interrupted, StaticReport& report) {
  constexpr double step_pressure = 15 * mmhg;
  const RingMeasure measure(loading, pressure);
  double increment = 1 / std::max(1.0, std::ceil(std::abs(pressure) / step_pressure));
  const double first = increment, smallest = increment / 32;
  Past past;
  past.add(0, std::vector<double>(solver.equations().layout().size(), 0.0));
  double reached = 0;
  int even = 0;  // states found with this increment
  while (reached < 1 && !interrupted()) {
    const double load = reached + increment > 1 - 1e-9 ? 1.0 : reached + increment;
    loading.load = load;
    const double size = measure.at(load);
    std::vector<double> state;
    NewtonReport solved;
    if (!past.is_first()) {
      state = past.extrapolate(size);
      solved = solver.solve(state);
    }
    if (!solved.converged) {
      if (!past.is_first()) ++report.guesses_missed;
      state = past.last();
      solved = solver.relax(pressure, interrupted, state);
    }
    if (solved.converged) {
      past.add(size, state);
      reached = load;
      ++report.load_steps;
      if (++even == 2) {
        increment = std::min(2 * increment, first);
        even = 0;
      }
      continue;
    }
    if (interrupted()) break;
    ++report.rejected;
    solver.newton().forget();
    increment /= 2;
    even = 0;
    if (increment >= smallest) continue;
    const std::string why = explain(solver.equations(), solved) + limit_of_wall(loading.ring.get(), pressure);
    loading.load = 1;
    const std::string in_lumen =
        pressure == 0 || reached == 0
            ? ""
            : fmt::format(", {:.4g} of {:.4g} mmHg in the lumen", reached * pressure / mmhg, pressure / mmhg);
    throw SolverFailure(fmt::format("no static equilibrium was found beyond {:.3g} % of the load{}: {}",
                                    100 * reached, in_lumen, why));
  }
  return reached < 1 ? std::vector<double>{} : past.last();
}

/// From the state on a coarser mesh; empty when that does not lead there.
std::vector<double> refine(const CoarserMeshes& meshes, const Equations& coarser,
                           const std::vector<double>& coarse_state, Solver& solver, double pressure,
                           const std::function<bool()>& interrupted, StaticReport& report) {
  const auto guess = meshes.prolong(coarser, coarse_state, solver.equations());
  auto state = guess;
  if (solver.solve(state).converged) return state;
  ++report.guesses_missed;
  state = guess;
  if (!solver.relax(pressure, interrupted, state).converged) state.clear();
  return state;
}

}  // namespace

std::vector<double> static_state(Loading& loading, const Equations& equations, const CoarserMeshes& coarser,
                                 Newton& newton, double time, double tolerance,
                                 const std::function<bool()>& interrupted, StaticReport& report) {
  loading.load = 1;
  const double pressure = loading.steady_pressure(time);
  // As good as interpolation to the next mesh needs it.
  constexpr double coarse_tolerance = 1e-5;
  std::vector<double> state;
  std::unique_ptr<StaticMesh> mesh;
  for (int k = 0; k < coarser.count(); ++k) {
    auto next = coarser.make(k);
    Newton solving(next->equations());
    Solver solver(next->loading(), next->equations(), solving, time, coarse_tolerance);
    try {
      state = mesh ? refine(coarser, mesh->equations(), state, solver, pressure, interrupted, report)
                   : climb(next->loading(), solver, pressure, interrupted, report);
    } catch (const SolverFailure&) {
      report.coarse += solving.counts();
      throw;
    }
    report.coarse += solving.counts();
    if (state.empty() || interrupted()) break;
    mesh = std::move(next);
  }
  if (interrupted()) return {};
  Solver solver(loading, equations, newton, time, tolerance);
  if (!state.empty())
    state = refine(coarser, mesh->equations(), state, solver, pressure, interrupted, report);
  if (state.empty()) state = climb(loading, solver, pressure, interrupted, report);
  loading.load = 1;
  return state;
}

}  // namespace tunica::coupled
