// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/static_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/coupled/failure.hpp"
#include "core/coupled/tube_state.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace tunica::coupled {

namespace {

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

/// The mean pressure within a wall is less than the lumen's. A derivative that knows half of that leads there
/// from farther off than an exact one, and still in few iterations.
constexpr double half = 0.5;

/// How a state is approached from a guess that keeps the wall's volume but is not where it should be, and so
/// first gets worse in the small cells at the ends.
struct Approach {
  double pressure_share;  ///< of the lumen's that the derivative's wall pressures may have
  double growth;          ///< NewtonOptions::growth
};
/// One that fails costs a fifth of what steps in time do, and another seldom fails with it.
constexpr Approach approaches[] = {{half, 3}, {0.5 * half, 3}, {1.5 * half, 1.5}};

/// How a state is let come to rest.
struct Patience {
  int iterations;         ///< in all
  double pressure_share;  ///< of the lumen's that the derivative's wall pressures may have
};
/// A wall that gives way moves on for ever; one that comes to rest takes a third of these.
constexpr Patience to_the_end{600, std::numeric_limits<double>::infinity()};
/// From an estimate it is soon there or not at all.
constexpr Patience from_estimate{90, half};

/// Steady states on one mesh under the loads that a setup has at the time.
class Solver {
 public:
  Solver(const Loading& loading, const Equations& equations, Newton& newton, double time, double tolerance)
      : loading_(loading),
        equations_(equations),
        newton_(newton),
        time_(time),
        tolerance_(tolerance),
        pressure_(loading.steady_pressure(time)) {}

  const Equations& equations() const { return equations_; }
  Newton& newton() { return newton_; }
  double time() const { return time_; }

  /// From a state near the one looked for.
  NewtonReport solve(std::vector<double>& state) {
    return newton_.solve({time_, 0, {}}, state, {tolerance_, 60});
  }

  /// From a state that is roughly like it.
  NewtonReport approach(std::vector<double>& state, const Approach& how) {
    // Near the state, where pressures in the corners of the wall's ends are beyond all bounds, Newton's own
    // derivative is the better one.
    constexpr double near = 0.03;
    newton_.forget();
    const Newton::Sizes sizes = newton_.sizes();
    const NewtonReport begun =
        newton_.solve(stage(0, {}, how.pressure_share), state, {std::max(near, tolerance_), 60, how.growth});
    // What is only roughly the state says nothing about the sizes of its fields.
    newton_.set_sizes(sizes);
    newton_.forget();
    return begun.converged ? solve(state) : begun;
  }

  /// The steady state by backward Euler steps in time that grow until they are infinite, with the momentum of
  /// the wall taken out at each: for states from which Newton's method alone would not get there, such as a
  /// wall without stiffness at rest. `pressure` is what drives the wall. Reports the last step that was not
  /// solved when it is not reached.
  NewtonReport relax(double pressure, const std::function<bool()>& interrupted, std::vector<double>& state,
                     const Patience& patience) {
    constexpr double largest = 1000, least = 1e-5;  // of the first coefficient
    constexpr int most_iterations = 25;
    const Layout& layout = equations_.layout();
    std::vector<double> history(layout.size()), candidate;
    const double first = first_coefficient(pressure);
    double coefficient = first, fall = 10;
    newton_.forget();
    NewtonReport unsolved;
    unsolved.failure = "the state does not come to rest";
    for (int iterations = 0;
         iterations < patience.iterations && coefficient <= largest * first && !interrupted();) {
      for (std::size_t e = 0; e < history.size(); ++e) history[e] = -coefficient * state[e];
      for (const int node : layout.wall_nodes())
        for (int c = 0; c < layout.components(); ++c) history[layout.velocity(node, c)] = 0;
      candidate = state;
      auto report = newton_.solve(stage(coefficient, history, patience.pressure_share), candidate,
                                  {tolerance_, most_iterations});
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
  /// With a derivative that knows wall pressures up to a share of the lumen's.
  Stage stage(double coefficient, std::span<const double> history, double pressure_share) const {
    Stage at{time_, coefficient, history};
    if (pressure_ != 0) at.wall_pressure_bound = pressure_share * std::abs(pressure_);
    return at;
  }

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
  double pressure_;  ///< in the lumen, dyn/cm2
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
  // Three times what the loads of walls that do find their states have taken. Of others, such as those whose
  // ripples grow at each load, nothing comes of more.
  constexpr long most_iterations = 1200;
  const long before = solver.newton().counts().iterations;
  const auto spent = [&] { return solver.newton().counts().iterations - before; };
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
      solved = solver.relax(pressure, interrupted, state, to_the_end);
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
    if (increment >= smallest && spent() < most_iterations) continue;
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

/// From what is known of tubes, or else from rest.
std::vector<double> begin(Loading& loading, Solver& solver, double pressure,
                          const std::function<bool()>& interrupted, StaticReport& report) {
  const auto guess = tube_state(loading, solver.equations(), solver.time());
  if (!guess.empty()) {
    std::vector<double> state;
    bool found = false;
    for (const Approach& how : approaches) {
      if (found || interrupted()) break;
      state = guess;
      found = solver.approach(state, how).converged;
    }
    if (!found && !interrupted()) {
      ++report.guesses_missed;
      state = guess;
      found = solver.relax(pressure, interrupted, state, from_estimate).converged;
    }
    if (interrupted()) return {};
    if (found) {
      ++report.load_steps;
      return state;
    }
    solver.newton().forget();
  }
  return climb(loading, solver, pressure, interrupted, report);
}

/// From the state on a coarser mesh; empty when that does not lead there.
std::vector<double> refine(const CoarserMeshes& meshes, const Equations& coarser,
                           const std::vector<double>& coarse_state, Solver& solver, double pressure,
                           const std::function<bool()>& interrupted, StaticReport& report) {
  const auto guess = meshes.prolong(coarser, coarse_state, solver.equations());
  auto state = guess;
  if (solver.solve(state).converged) return state;
  // Corrections that grow could lead to another state than the one prolonged.
  state = guess;
  if (solver.approach(state, {half, 0}).converged) return state;
  ++report.guesses_missed;
  state = guess;
  if (!solver.relax(pressure, interrupted, state, to_the_end).converged) state.clear();
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
    solving.set_sizes(newton.sizes());
    Solver solver(next->loading(), next->equations(), solving, time, coarse_tolerance);
    try {
      state = mesh ? refine(coarser, mesh->equations(), state, solver, pressure, interrupted, report)
                   : begin(next->loading(), solver, pressure, interrupted, report);
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
  if (state.empty()) state = begin(loading, solver, pressure, interrupted, report);
  loading.load = 1;
  return state;
}

}  // namespace tunica::coupled
