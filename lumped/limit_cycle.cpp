// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/limit_cycle.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/linear/anderson.hpp"
#include "lumped/multistep.hpp"

namespace tunica::lumped {

namespace {

using Vector = Eigen::VectorXd;

constexpr std::size_t depth = 8;
constexpr int most_periods = 60;
/// What a period changes is known to about ten local errors; closer than that no search can come.
constexpr double local_errors = 10;

void add(IntegratorStatistics& total, const IntegratorStatistics& more) {
  total.steps += more.steps;
  total.newton_iterations += more.newton_iterations;
  total.rejected_steps += more.rejected_steps;
}

Vector from(const double* entries, int size) {
  return Eigen::Map<const Vector>(entries, size);
}
std::vector<double> entries(const Vector& vector) {
  return {vector.begin(), vector.end()};
}

/// Fixed point of a map that is known with errors. Where the map itself brings x there quickly it is left to
/// do so: a combination of images would carry their errors, that of waves is, over into what follows.
class Search {
 public:
  explicit Search(double small) : small_(small) {}

  /// Takes the image of `x` in and moves x on; true when the image is a fixed point: x moves by little, and
  /// that either twice on end, or as the last of quick steps, or as far as the acceleration knows about what
  /// changes slowly.
  bool finds(Vector& x, const Vector& image, const Vector& weights) {
    constexpr double quick = 0.1;
    const auto norm = [&](const Vector& v) { return v.cwiseProduct(weights).lpNorm<Eigen::Infinity>(); };
    const double before = change_;
    change_ = norm(image - x);
    const Vector combined = anderson_.next(x, image, weights);
    const bool is_quick = std::isfinite(before) && change_ <= quick * before;
    x = is_quick || !combined.allFinite() ? image : combined;
    const bool was_small = is_small_;
    is_small_ = change_ <= small_;
    const bool agrees = anderson_.images() > 2 && norm(combined - image) <= local_errors * small_;
    return is_small_ && (was_small || is_quick || agrees);
  }

  void restart() {
    anderson_.restart();
    change_ = std::numeric_limits<double>::infinity();
    is_small_ = false;
  }
  /// By the last period, relative to the weights.
  double change() const { return change_; }

 private:
  linear::Anderson anderson_{depth};
  double small_;
  double change_ = std::numeric_limits<double>::infinity();
  bool is_small_ = false;
};

void find_state(const System& system, double period, double tolerance, LimitCycle& cycle) {
  const int n = system.unknowns;
  Multistep integrator(system, {}, tolerance);
  Search search(local_errors * tolerance);
  Vector x = from(cycle.state.data(), n), image = x, weights(n);
  for (int count = 0; count < most_periods; ++count) {
    try {
      integrator.start(0, period, entries(x), {});
      integrator.advance(period);
    } catch (const SolverFailure&) {
      // The acceleration may have gone too far, never the artery itself.
      if (x == image) throw;
      x = image;
      search.restart();
      continue;
    }
    image = from(integrator.state(), n);
    system.magnitudes(image.data(), weights.data());
    weights = weights.cwiseInverse();
    if (search.finds(x, image, weights)) {
      cycle.state = entries(image);
      cycle.statistics = integrator.statistics();
      return;
    }
  }
  throw SolverFailure(fmt::format(
      "no periodic state was found within {} periods: the last one still changes the state by {:.2g} of "
      "its size; start from rest",
      most_periods, search.change()));
}

}  // namespace

LimitCycle find_limit_cycle(const System& given, const std::vector<double>& guess, double period,
                            const std::vector<Sensitivity>& parameters, double tolerance) {
  System system = given;
  system.events = 0;
  const int n = system.unknowns;
  const std::size_t count = parameters.size();
  LimitCycle cycle;
  cycle.state = guess;
  find_state(system, period, tolerance, cycle);
  if (parameters.empty()) return cycle;

  Multistep integrator(system, parameters, tolerance);
  cycle.derivatives.assign(count, std::vector<double>(n, 0.0));
  std::vector<Search> searches(count, Search(local_errors * tolerance));
  for (int round = 0; round < most_periods; ++round) {
    integrator.start(0, period, cycle.state, cycle.derivatives);
    integrator.advance(period);
    bool found = true;
    for (std::size_t k = 0; k < count; ++k) {
      Vector derivative = from(cycle.derivatives[k].data(), n);
      const Vector image = from(integrator.sensitivity(static_cast<int>(k)), n);
      const Vector sizes = parameters[k].size * from(system.scales.data(), n) + image.cwiseAbs();
      const bool is_there = searches[k].finds(derivative, image, sizes.cwiseInverse());
      cycle.derivatives[k] = entries(is_there ? image : derivative);
      found &= is_there;
    }
    if (found) {
      add(cycle.statistics, integrator.statistics());
      return cycle;
    }
  }
  throw SolverFailure(
      fmt::format("the derivatives of the periodic state do not settle within {} periods; start from rest",
                  most_periods));
}

}  // namespace tunica::lumped
