// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/collocation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/error.hpp"
#include "core/root.hpp"

namespace tunica::lumped {

namespace {

const double root6 = std::sqrt(6.0);
const std::array<double, 3> nodes{(4 - root6) / 10, (4 + root6) / 10, 1.0};
/// a_ij
const Eigen::Matrix3d weights{{(88 - 7 * root6) / 360, (296 - 169 * root6) / 1800, (-2 + 3 * root6) / 225},
                              {(296 + 169 * root6) / 1800, (88 + 7 * root6) / 360, (-2 - 3 * root6) / 225},
                              {(16 - root6) / 36, (16 + root6) / 36, 1.0 / 9}};
/// 1/gamma_0 is the real eigenvalue of the inverse of a, 3 + 3^(2/3) - 3^(1/3).
const double gamma0 = 1 / (3 + std::cbrt(9.0) - std::cbrt(3.0));
/// Of the stages in the embedded formula.
const Eigen::Vector3d error_weights = gamma0 / 3 * Eigen::Vector3d(-13 - 7 * root6, -13 + 7 * root6, -1.0);

/// Error that Newton's method may leave, relative to the tolerance.
constexpr double negligible = 0.01;
/// Where an update leaves more than this of the error the next step takes df/dy anew.
constexpr double slow = 1e-2;
/// The first step, and the shortest, over the system's time scale.
constexpr double first_share = 1e-3, shortest_share = 1e-12;
/// No step is longer than this, so that none passes over what an inlet does.
constexpr double greatest_share = 1.0 / 32;

/// Longer by at most 8, shorter by at most 5; the error of the embedded formula goes with the fourth power.
double factor_for(double error) {
  constexpr double safety = 0.8;
  return std::clamp(safety * std::pow(std::max(error, 1e-16), -0.25), 0.2, 8.0);
}

}  // namespace

Collocation::Collocation(System system, double tolerance)
    : system_(std::move(system)), tolerance_(tolerance), event_values_(system_.events) {
  const int n = system_.unknowns;
  if (n > most_unknowns) throw std::logic_error("Collocation: too many unknowns");
  for (State* state : {&state_, &at_begin_, &at_end_, &rate_, &magnitudes_}) *state = State::Zero(n);
  stages_ = solved_ = Stages::Zero(n, stages);
  jacobian_ = Square::Zero(n, n);
}

void Collocation::start(double time, double end_time, const std::vector<double>& state,
                        const std::vector<std::vector<double>>& sensitivities) {
  if (!sensitivities.empty()) throw std::logic_error("Collocation: no sensitivities are carried");
  time_ = begin_ = end_ = time;
  end_time_ = end_time;
  std::copy(state.begin(), state.end(), state_.data());
  at_begin_ = at_end_ = state_;
  system_.rate(time, state_.data(), rate_.data());
  system_.magnitudes(state_.data(), magnitudes_.data());
  step_ = first_share * system_.time_scale;
  is_jacobian_due_ = true;
  convergence_ = 1;
  sides_.clear();
  if (system_.events > 0) system_.event_values(state_.data(), event_values_.data());
  for (const double value : event_values_) sides_.push_back(value > 0);
}

std::vector<Crossing> Collocation::advance(double time) {
  const double target = std::min(time, end_time_);
  const long steps_before = statistics_.steps;
  double before = end_;
  while (time_ < target) {
    if (end_ <= time_) {
      step();
      if ((statistics_.steps - steps_before) % steps_at_a_time == 0) {
        if (system_.progress) system_.progress(end_, statistics_);
        if (end_ - before < least_share * system_.time_scale)
          throw SolverFailure(
              fmt::format("the last {} steps have brought the integration only {:.2g} s farther",
                          steps_at_a_time, end_ - before));
        before = end_;
      }
    }
    const double until = std::min(target, end_);
    if (const auto crossing = cross(until)) return {*crossing};
    state_ = within(until);
    time_ = until;
  }
  return {};
}

void Collocation::step() {
  while (true) {
    const double remaining = end_time_ - end_;
    const double h = remaining / std::max(1.0, std::ceil(remaining / step_ - 1e-9));
    if (!solve(h)) {
      shorten(h, 0.5);
      continue;
    }
    const double error = error_of(h, end_ == begin_);
    if (!(error <= 1)) {
      shorten(h, factor_for(error));
      continue;
    }
    const double factor = factor_for(error);
    // A step that is to grow by little stays as long as the matrices are factorised for.
    const bool stays = factor >= 1 && factor < 1.2;
    step_ = std::min(stays ? h : h * factor, greatest_share * system_.time_scale);
    return accept(h == remaining ? end_time_ : end_ + h);
  }
}

void Collocation::shorten(double h, double factor) {
  ++statistics_.rejected_steps;
  step_ = factor * h;
  if (step_ < shortest_share * system_.time_scale)
    throw SolverFailure(
        fmt::format("{}{}no step is short enough", complaint_, complaint_.empty() ? "" : "; "));
}

void Collocation::accept(double end) {
  begin_ = end_;
  at_begin_ = at_end_;
  stages_ = solved_;
  end_ = end;
  at_end_ += stages_.col(stages - 1);
  is_jacobian_of_end_ = false;
  complaint_.clear();
  ++statistics_.steps;
  system_.rate(end_, at_end_.data(), rate_.data());
  system_.magnitudes(at_end_.data(), magnitudes_.data());
}

bool Collocation::solve(double h) {
  const auto attempt = [&] {
    try {
      if (is_jacobian_due_) differentiate();
      factorise(h);
      return iterate(h);
    } catch (const SolverFailure& failure) {
      complaint_ = failure.what();
      return false;
    }
  };
  if (attempt()) return true;
  is_jacobian_due_ = !is_jacobian_of_end_;
  return is_jacobian_due_ && attempt();
}

bool Collocation::iterate(double h) {
  constexpr int most_iterations = 10;
  const int n = system_.unknowns;
  Stages found = guess(h), rates(n, stages);
  State at(n);
  StageVector update(n * stages);
  double previous = 0;
  double leaves = std::pow(std::max(convergence_, 1e-16), 0.8);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    for (int i = 0; i < stages; ++i) {
      at = at_end_ + found.col(i);
      system_.rate(end_ + nodes[i] * h, at.data(), rates.col(i).data());
    }
    Eigen::Map<Stages>(update.data(), n, stages) = h * (rates * weights.transpose()) - found;
    update = stage_solver_.solve(update).eval();
    const Eigen::Map<const Stages> change(update.data(), n, stages);
    found += change;
    ++statistics_.newton_iterations;
    double size = 0;
    for (int i = 0; i < stages; ++i)
      size = std::max(size, (change.col(i).array().abs() / magnitudes_.array()).maxCoeff());
    size /= tolerance_;
    if (!std::isfinite(size)) return false;
    if (iteration > 0 && size > 0) {
      const double ratio = size / previous;
      if (ratio >= 0.99) return false;
      leaves = ratio / (1 - ratio);
    }
    if (leaves * size <= negligible) {
      solved_ = found;
      convergence_ = leaves;
      is_jacobian_due_ = leaves > slow;
      return true;
    }
    previous = size;
  }
  return false;
}

Collocation::State Collocation::change_at(double x) const {
  const auto& c = nodes;
  // Lagrange's polynomials of 0 and the nodes; the change at 0 is 0.
  const Eigen::Vector3d shares{x * (x - c[1]) * (x - c[2]) / (c[0] * (c[0] - c[1]) * (c[0] - c[2])),
                               x * (x - c[0]) * (x - c[2]) / (c[1] * (c[1] - c[0]) * (c[1] - c[2])),
                               x * (x - c[0]) * (x - c[1]) / (c[2] * (c[2] - c[0]) * (c[2] - c[1]))};
  return stages_ * shares;
}

Collocation::Stages Collocation::guess(double h) const {
  // A polynomial of degree 3 says nothing far beyond its step.
  constexpr double farthest = 3;
  Stages result = Stages::Zero(system_.unknowns, stages);
  const double last = end_ - begin_;
  if (!(h < farthest * last)) return result;
  for (int i = 0; i < stages; ++i)
    result.col(i) = change_at(1 + nodes[i] * h / last) - stages_.col(stages - 1);
  return result;
}

double Collocation::error_of(double h, bool is_careful) const {
  const auto size = [&](const State& error) {
    return (error.array().abs() / magnitudes_.array()).maxCoeff() / tolerance_;
  };
  const State of_stages = solved_ * error_weights;
  State error = error_solver_.solve(State(h * gamma0 * rate_ + of_stages));
  // Of a stiff system the first step is judged too harshly unless the error is filtered once more.
  if (is_careful && !(size(error) <= 1)) {
    State moved(system_.unknowns);
    const State at = at_end_ + error;
    try {
      system_.rate(end_, at.data(), moved.data());
      error = error_solver_.solve(State(h * gamma0 * moved + of_stages));
    } catch (const SolverFailure&) {
      // The unfiltered error is beyond the states that there are: the step is too long.
    }
  }
  return size(error);
}

void Collocation::differentiate() {
  for (int j = 0; j < system_.unknowns; ++j) {
    const State direction = State::Unit(system_.unknowns, j);
    system_.rate_derivative(end_, at_end_.data(), direction.data(), -1, jacobian_.col(j).data());
  }
  is_jacobian_due_ = false;
  is_jacobian_of_end_ = true;
  factorised_step_ = 0;
}

void Collocation::factorise(double h) {
  if (std::abs(h - factorised_step_) <= 1e-3 * h) return;
  const int n = system_.unknowns;
  StageSquare matrix = StageSquare::Identity(n * stages, n * stages);
  for (int i = 0; i < stages; ++i)
    for (int j = 0; j < stages; ++j) matrix.block(i * n, j * n, n, n) -= h * weights(i, j) * jacobian_;
  stage_solver_.compute(matrix);
  error_solver_.compute(Square(Square::Identity(n, n) - h * gamma0 * jacobian_));
  factorised_step_ = h;
}

Collocation::State Collocation::within(double time) const {
  return time == end_ ? at_end_ : State(at_begin_ + change_at((time - begin_) / (end_ - begin_)));
}

std::optional<Crossing> Collocation::cross(double until) {
  if (sides_.empty()) return {};
  system_.event_values(within(until).data(), event_values_.data());
  double first = until;
  std::optional<Crossing> crossing;
  for (std::size_t k = 0; k < sides_.size(); ++k) {
    if ((event_values_[k] > 0) == sides_[k]) continue;
    std::vector<double> values(sides_.size());
    const auto value = [&](double time) {
      system_.event_values(within(time).data(), values.data());
      return values[k];
    };
    // A function that is zero to round-off at this time has passed it already.
    const bool at_once = (value(time_) > 0) != sides_[k];
    const double when = at_once ? time_ : find_root(value, time_, until, 1e-12 * system_.time_scale);
    if (crossing && when >= first) continue;
    first = when;
    crossing = Crossing{static_cast<int>(k), !sides_[k]};
  }
  if (!crossing) return {};
  sides_[crossing->index] = crossing->rising;
  state_ = within(first);
  time_ = first;
  return crossing;
}

const double* Collocation::sensitivity(int) const {
  throw std::logic_error("Collocation: no sensitivities are carried");
}

}  // namespace tunica::lumped
