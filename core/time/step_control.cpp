// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tunica::time {

namespace {

/// Sizes that differ by less are equal but for rounding.
constexpr double rounding = 1e-9;
/// Accepted steps without growth after one that could not be solved: the equations are hard there, and a
/// step that grows at once would fail again.
constexpr int hold_after_failure = 5;
/// Least ratio of a step to the one that was rejected or that came before.
constexpr double least_ratio = 0.2;
/// Errors below say no more than that the step may grow (the greatest growth needs no smaller ones).
constexpr double least_error = 1e-3;

}  // namespace

StepControl::StepControl(const StepOptions& options) : options_(options) {
  const bool ordered = options.minimum > 0 && options.minimum <= options.first &&
                       options.first <= options.maximum && std::isfinite(options.maximum);
  if (!ordered) throw std::logic_error("time::StepControl: 0 < minimum <= first <= maximum is needed");
  if (!(options.growth > options.keep_to && options.keep_to > 1 && options.keep_from < 1))
    throw std::logic_error("time::StepControl: growth > keep_to > 1 > keep_from is needed");
  state_.wanted = options.first;
}

Step StepControl::next(double time, double stop) {
  double target = state_.divided ? std::min(stop, state_.cell_end) : stop;
  if (stop - target < 1e-6 * state_.regular) target = stop;
  const double remaining = target - time;
  if (!(remaining > 0 && std::isfinite(remaining)))
    throw std::logic_error("time::StepControl: the stop is not ahead");
  double limit = options_.maximum;
  if (!options_.fixed && state_.accepted > 0) limit = std::min(limit, options_.growth * state_.accepted);
  const double wanted = options_.fixed ? state_.wanted : std::min(state_.wanted, limit);
  // A step that was rejected must become smaller.
  const bool again = state_.rejected + state_.failed > 0;
  const double stretch = options_.fixed ? 1e-6 : again ? 0 : 0.1;
  double count = std::max(1.0, std::ceil(remaining / wanted - stretch));
  if (!options_.fixed && remaining / count > limit * (1 + rounding)) ++count;
  double size = remaining / count;
  // Bitwise equal steps have bitwise equal coefficients.
  for (const double known : {state_.tried, state_.regular})
    if (std::abs(size - known) <= rounding * size) size = known;
  state_.tried = size;
  state_.tried_end = count == 1 ? target : time + size;
  if (!state_.divided) state_.regular = size;
  return {size, state_.tried_end};
}

bool StepControl::at_floor() const {
  return state_.tried <= options_.minimum * (1 + rounding);
}

void StepControl::accept(double error, int order) {
  state_.accepted = state_.tried;
  state_.error_before = error;
  state_.order_before = order;
  state_.failed = state_.rejected = 0;
  ++state_.counts.accepted;
}

Verdict StepControl::judge(double error, int order) {
  if (options_.fixed) {
    accept(error, order);
    if (state_.divided && state_.tried_end >= state_.cell_end) {
      // Back by doubling: bdf2 does not bear a greater growth.
      const double grown = options_.growth * state_.tried;
      state_.divided = grown < state_.regular * (1 - rounding);
      state_.wanted = state_.divided ? grown : options_.first;
      state_.cell_end += state_.regular;
    }
    return Verdict::accept;
  }
  if (order == 0) {
    accept(0, 0);
    return Verdict::accept;
  }
  const double exponent = -1.0 / (order + 1), tried = state_.tried;
  if (!(error <= 1)) {
    ++state_.counts.rejected_by_error;
    if (at_floor()) return Verdict::give_up;
    double ratio = std::isfinite(error) ? options_.safety * std::pow(error, exponent) : 0;
    // An error that does not follow its order must not lead to many small reductions.
    if (++state_.rejected > 1) ratio = std::min(ratio, 0.5);
    state_.wanted = std::max(tried * std::max(ratio, least_ratio), options_.minimum);
    state_.hold = std::max(state_.hold, 1);
    return Verdict::retry;
  }
  error = std::max(error, least_error);
  double ratio = options_.safety * std::pow(error, exponent);
  const bool comparable = state_.order_before == order && tried * options_.growth >= state_.accepted;
  if (comparable && state_.rejected + state_.failed == 0)
    ratio *= std::min(1.0, tried / state_.accepted * std::pow(error / state_.error_before, exponent));
  ratio = std::max(ratio, least_ratio);
  accept(error, order);
  // A step that a stop has shortened and that may grow says nothing against the step wanted before.
  double wanted = ratio < options_.growth ? tried * ratio : std::max(state_.wanted, tried * options_.growth);
  if (state_.hold > 0) {
    --state_.hold;
    wanted = std::min(wanted, state_.wanted);
  }
  wanted = std::clamp(wanted, options_.minimum, options_.maximum);
  const double change = wanted / state_.wanted;
  if (change < options_.keep_from || change > options_.keep_to) state_.wanted = wanted;
  return Verdict::accept;
}

Verdict StepControl::solve_failed() {
  ++state_.counts.rejected_by_solver;
  if (at_floor()) return Verdict::give_up;
  if (options_.fixed && !state_.divided) {
    state_.divided = true;
    state_.cell_end = state_.tried_end;
  }
  const double ratio = ++state_.failed > 1 ? 0.25 : 0.5;
  state_.wanted = std::max(state_.tried * ratio, options_.minimum);
  state_.hold = hold_after_failure;
  return Verdict::retry;
}

void StepControl::restart() {
  if (!options_.fixed) state_.wanted = std::min(state_.wanted, options_.first);
  state_.accepted = state_.error_before = 0;
  state_.order_before = state_.failed = state_.rejected = state_.hold = 0;
}

}  // namespace tunica::time
