// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/static_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/radial/wall_curve.hpp"

namespace tunica::axisym {

namespace {

constexpr double mmhg = 1333.22387;

/// Displacement of the lumen that a ring of the wall at mid-length has under a pressure: what states under
/// different loads are compared by, since it grows more evenly than the load. The load itself where there is
/// no such ring.
class RingMeasure {
 public:
  explicit RingMeasure(const Setup& setup) : setup_(setup) {}

  double at(double pressure) const {
    if (!setup_.ring || pressure == 0) return pressure;
    try {
      const bool grows = pressure > 0;
      double low = 1, high = grows ? 1.05 : 0.95;
      const auto exceeds = [&](double stretch) {
        const double p = setup_.ring->respond(stretch, {}, false).pressure;
        return grows ? p > pressure : p < pressure;
      };
      while (!exceeds(high)) {
        low = high;
        high = 1 + (high - 1) * 1.6;
        if (high > radial::WallCurve::greatest_stretch || high < radial::WallCurve::least_stretch)
          return pressure;
      }
      constexpr int halvings = 14;
      for (int k = 0; k < halvings; ++k) (exceeds(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
      return 0.5 * (low + high) - 1;
    } catch (const SolverFailure&) {
      return pressure;
    }
  }

 private:
  const Setup& setup_;
};

/// States found so far and their measures, for a guess of the next by the polynomial through the last of
/// them.
class Past {
 public:
  void add(double measure, const std::vector<double>& state) {
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

/// The steady state by backward Euler steps in time that grow until they are infinite, with the momentum of
/// the wall taken out at each: for states from which Newton's method alone would not get there, such as a
/// wall without stiffness at rest. True when it was reached.
bool relax(const Assembler& assembler, Newton& newton, double time, double tolerance,
           std::vector<double>& state) {
  constexpr double first = 1e3, largest = 1e8, least = 1;  // 1/s: reciprocal steps
  constexpr int most = 60;
  const Layout& layout = assembler.layout();
  std::vector<double> history(layout.size()), candidate;
  double coefficient = first;
  for (int k = 0; k < most; ++k) {
    for (std::size_t e = 0; e < history.size(); ++e) history[e] = -coefficient * state[e];
    for (const int node : layout.wall_nodes())
      for (int c = 0; c < 2; ++c) history[layout.velocity(node, c)] = 0;
    candidate = state;
    const Stage stage{time, coefficient, history};
    if (newton.solve(stage, candidate, {tolerance, 60}).converged) {
      state = candidate;
      if (coefficient == 0) return true;
      coefficient = coefficient > least ? coefficient / 10 : 0;
      continue;
    }
    newton.forget();
    coefficient = coefficient == 0 ? 10 * least : 4 * coefficient;
    if (coefficient > largest) return false;
  }
  return false;
}

/// Pressure in the lumen at mid-length under the full loads of a time, as far as it is known beforehand.
double lumen_pressure(const Setup& setup, double time) {
  const Problem& problem = setup.problem;
  if (!problem.mesh.has(Part::blood)) return problem.lumen_pressure(time);
  if (problem.inlet.kind == InletKind::pressure) return problem.inlet.value(time);
  const OutletCondition& outlet = problem.outlet;
  return outlet.pressure(time) + (outlet.resistance + outlet.proximal_resistance) * setup.inlet_value(time);
}

}  // namespace

std::vector<double> static_state(Setup& setup, const Assembler& assembler, Newton& newton, double time,
                                 double tolerance, const std::function<bool()>& interrupted,
                                 StaticReport& report) {
  constexpr double step_pressure = 15 * mmhg;
  constexpr double smallest = 1.0 / 4096;
  const RingMeasure measure(setup);
  setup.load = 1;
  const double pressure = lumen_pressure(setup, time);
  double increment = 1 / std::max(1.0, std::ceil(std::abs(pressure) / step_pressure));
  Past past;
  past.add(0, std::vector<double>(assembler.layout().size(), 0.0));
  double reached = 0;
  while (reached < 1) {
    if (interrupted()) return {};
    const double load = reached + increment > 1 - 1e-9 ? 1.0 : reached + increment;
    setup.load = load;
    const double size = measure.at(load * pressure);
    std::vector<double> state;
    NewtonReport solved;
    if (!past.is_first()) {
      state = past.extrapolate(size);
      solved = newton.solve({time, 0, {}}, state, {tolerance, 100});
    }
    if (!solved.converged) {
      newton.forget();
      state = past.last();
      solved.converged = relax(assembler, newton, time, tolerance, state);
    }
    if (solved.converged) {
      past.add(size, state);
      reached = load;
      ++report.load_steps;
      continue;
    }
    ++report.rejected;
    newton.forget();
    increment /= 2;
    if (increment < smallest) {
      const LeastJacobian& least = assembler.least_jacobian();
      std::string where;
      if (least.cell >= 0 && least.value < 0.1) {
        const Mesh& mesh = assembler.problem().mesh;
        const auto& at = mesh.points[mesh.cells[least.cell].nodes[mesh.centre_node()]];
        where = fmt::format("; J = {:.3g} in cell {} at r = {:.4g}, z = {:.4g} cm", least.value, least.cell,
                            at[0], at[1]);
      }
      setup.load = 1;
      throw SolverFailure(fmt::format("no static equilibrium was found beyond {:.4g} of {:.4g} mmHg{}{}",
                                      reached * pressure / mmhg, pressure / mmhg,
                                      solved.failure.empty() ? "" : ": " + solved.failure, where));
    }
  }
  setup.load = 1;
  return past.last();
}

}  // namespace tunica::axisym
