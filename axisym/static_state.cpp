// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/static_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "axisym/failure.hpp"
#include "axisym/prolong.hpp"
#include "core/error.hpp"
#include "core/radial/wall_curve.hpp"

namespace tunica::axisym {

namespace {

constexpr double mmhg = 1333.22387;

/// Displacement of the lumen, over its radius, that a ring of the wall at mid-length has under a share of the
/// load: what states under different loads are compared by, since it grows more evenly than the load. The
/// share itself where there is no ring or it does not bear the load.
class RingMeasure {
 public:
  /// For loads from none to that of `pressure`.
  RingMeasure(const Setup& setup, double pressure) : setup_(setup), pressure_(pressure) {
    if (!setup.ring || pressure == 0) return;
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
    const double p = setup_.ring->respond(stretch, {}, false).pressure;
    return pressure_ > 0 ? p > pressure : p < pressure;
  }

  const Setup& setup_;
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
  Solver(const Setup& setup, const Assembler& assembler, Newton& newton, double time, double tolerance)
      : setup_(setup), assembler_(assembler), newton_(newton), time_(time), tolerance_(tolerance) {}

  const Assembler& assembler() const { return assembler_; }
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
    const Layout& layout = assembler_.layout();
    std::vector<double> history(layout.size()), candidate;
    const double first = first_coefficient(pressure);
    double coefficient = first, fall = 10;
    newton_.forget();
    NewtonReport unsolved;
    unsolved.failure = "the state does not come to rest";
    for (int iterations = 0; iterations < most_in_all && coefficient <= largest * first && !interrupted();) {
      for (std::size_t e = 0; e < history.size(); ++e) history[e] = -coefficient * state[e];
      for (const int node : layout.wall_nodes())
        for (int c = 0; c < 2; ++c) history[layout.velocity(node, c)] = 0;
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
    if (!setup_.ring) return 1e3;
    return 3 * std::sqrt(std::abs(pressure) / setup_.problem.wall_density) / setup_.ring->ring().thickness;
  }

  const Setup& setup_;
  const Assembler& assembler_;
  Newton& newton_;
  double time_, tolerance_;
};

/// Pressure in the lumen at mid-length under the full loads of a time, as far as it is known beforehand.
double lumen_pressure(const Setup& setup, double time) {
  const Problem& problem = setup.problem;
  if (!problem.mesh.has(Part::blood)) return problem.lumen_pressure(time);
  if (problem.inlet.kind == InletKind::pressure) return problem.inlet.value(time);
  const OutletCondition& outlet = problem.outlet;
  return outlet.pressure(time) + (outlet.resistance + outlet.proximal_resistance) * setup.inlet_value(time);
}

/// From rest in steps of the load.
std::vector<double> climb(Setup& setup, Solver& solver, double pressure,
                          const std::function<bool()>& interrupted, StaticReport& report) {
  constexpr double step_pressure = 15 * mmhg;
  const RingMeasure measure(setup, pressure);
  double increment = 1 / std::max(1.0, std::ceil(std::abs(pressure) / step_pressure));
  const double first = increment, smallest = increment / 32;
  Past past;
  past.add(0, std::vector<double>(solver.assembler().layout().size(), 0.0));
  double reached = 0;
  int even = 0;  // states found with this increment
  while (reached < 1 && !interrupted()) {
    const double load = reached + increment > 1 - 1e-9 ? 1.0 : reached + increment;
    setup.load = load;
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
    const std::string why = explain(solver.assembler(), solved) + limit_of_wall(setup.ring.get(), pressure);
    setup.load = 1;
    const std::string in_lumen =
        pressure == 0 || reached == 0
            ? ""
            : fmt::format(", {:.4g} of {:.4g} mmHg in the lumen", reached * pressure / mmhg, pressure / mmhg);
    throw SolverFailure(fmt::format("no static equilibrium was found beyond {:.3g} % of the load{}: {}",
                                    100 * reached, in_lumen, why));
  }
  return reached < 1 ? std::vector<double>{} : past.last();
}

/// Meshes that lead from a coarse one to that of a resolution, each of at most twice the cells in a
/// direction; without the latter.
std::vector<Resolution> coarser_meshes(const Resolution& finest, int layers) {
  using Count = int Resolution::*;
  struct Direction {
    Count count;
    int least;
  };
  const Direction directions[] = {{&Resolution::wall_cells, std::max(2, layers)},
                                  {&Resolution::blood_cells, 2},
                                  {&Resolution::axial_cells, 16}};
  double ratio = 1;
  for (const auto& [count, least] : directions)
    ratio = std::max(ratio, static_cast<double>(finest.*count) / least);
  const int levels = static_cast<int>(std::ceil(std::log2(ratio) - 1e-9));
  std::vector<Resolution> meshes(levels, finest);
  for (int k = 0; k < levels; ++k) {
    for (const auto& [count, least] : directions) {
      if (finest.*count <= least) continue;
      const double share = static_cast<double>(k) / levels;
      meshes[k].*count = static_cast<int>(std::lround(least * std::pow(finest.*count / least, share)));
    }
    meshes[k].axial_cells += meshes[k].axial_cells % 2;
  }
  return meshes;
}

/// From the state on a coarser mesh; empty when that does not lead there.
std::vector<double> refine(const Assembler& coarser, const std::vector<double>& coarse_state, Solver& solver,
                           double pressure, const std::function<bool()>& interrupted, StaticReport& report) {
  const auto guess = prolong(coarser, coarse_state, solver.assembler());
  auto state = guess;
  if (solver.solve(state).converged) return state;
  ++report.guesses_missed;
  state = guess;
  if (!solver.relax(pressure, interrupted, state).converged) state.clear();
  return state;
}

}  // namespace

std::vector<double> static_state(const Scene& scene, Setup& setup, const Assembler& assembler, Newton& newton,
                                 double time, double tolerance, const std::function<bool()>& interrupted,
                                 StaticReport& report) {
  setup.load = 1;
  const double pressure = lumen_pressure(setup, time);
  std::vector<Resolution> meshes;
  if (scene.text("geometry.kind") != "mesh")
    meshes = coarser_meshes(setup.resolution, setup.problem.mesh.layers());
  // As good as interpolation to the next mesh needs it.
  constexpr double coarse_tolerance = 1e-5;
  std::vector<double> state;
  std::unique_ptr<Setup> coarser_setup;
  std::unique_ptr<const Assembler> coarser;
  for (const Resolution& mesh : meshes) {
    auto next_setup = setup_of(scene, mesh);
    auto next = std::make_unique<const Assembler>(next_setup->problem);
    Newton solving(*next);
    Solver solver(*next_setup, *next, solving, time, coarse_tolerance);
    try {
      state = coarser ? refine(*coarser, state, solver, pressure, interrupted, report)
                      : climb(*next_setup, solver, pressure, interrupted, report);
    } catch (const SolverFailure&) {
      report.coarse += solving.counts();
      throw;
    }
    report.coarse += solving.counts();
    if (state.empty() || interrupted()) break;
    coarser = std::move(next);
    coarser_setup = std::move(next_setup);
  }
  if (interrupted()) return {};
  Solver solver(setup, assembler, newton, time, tolerance);
  if (!state.empty()) state = refine(*coarser, state, solver, pressure, interrupted, report);
  if (state.empty()) state = climb(setup, solver, pressure, interrupted, report);
  setup.load = 1;
  return state;
}

}  // namespace tunica::axisym
