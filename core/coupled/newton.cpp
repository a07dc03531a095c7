// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tunica::coupled {

namespace {

constexpr const char* singular = "the derivative is singular";

}  // namespace

Newton::Newton(const Equations& equations)
    : equations_(equations),
      solver_(equations.tangent_solver()),
      residual_(equations.layout().unknowns()),
      weights_(equations.layout().unknowns()) {}

void Newton::forget() {
  factorised_ = false;
  solver_->forget();
}

bool Newton::evaluate(const Stage& stage, std::span<double> y) {
  equations_.complete(stage, y);
  return equations_.residual(stage, y, residual_);
}

bool Newton::refresh(const Stage& stage, std::span<const double> y) {
  ++counts_.factorisations;
  factorised_ = solver_->factorise(stage, y);
  return factorised_;
}

bool Newton::linearised(std::span<double> right_hand_side) {
  const bool solved = solver_->solve(right_hand_side);
  counts_.linear_iterations += solver_->iterations();
  return solved;
}

void Newton::correct(std::vector<double>& correction) {
  correction.assign(residual_.begin(), residual_.end());
  if (!linearised(correction)) std::fill(correction.begin(), correction.end(), NAN);
  for (double& entry : correction) entry = -entry;
}

void Newton::add(std::span<double> y, double factor, const std::vector<double>& correction) const {
  const Layout& layout = equations_.layout();
  for (int u = 0; u < layout.unknowns(); ++u) y[layout.entry(u)] += factor * correction[u];
}

Newton::Sizes Newton::sizes_with(std::span<const double> y) const {
  const Layout& layout = equations_.layout();
  Sizes sizes = sizes_;
  for (std::size_t e = 0; e < layout.size(); ++e) {
    double& size = e < layout.velocity_begin()   ? sizes.displacement
                   : e < layout.pressure_begin() ? sizes.velocity
                                                 : sizes.pressure;
    size = std::max(size, std::abs(y[e]));
  }
  return sizes;
}

void Newton::weigh(std::span<const double> y) {
  const Layout& layout = equations_.layout();
  const Sizes sizes = sizes_with(y);
  const auto inverse = [](double size) { return size > 0 ? 1 / size : 0.0; };
  const double d = inverse(sizes.displacement), v = inverse(sizes.velocity), p = inverse(sizes.pressure);
  for (int u = 0; u < layout.unknowns(); ++u) {
    const std::size_t e = layout.entry(u);
    weights_[u] = e < layout.velocity_begin() ? d : e < layout.pressure_begin() ? v : p;
  }
}

Newton::Norms Newton::norms(const std::vector<double>& correction) const {
  const Layout& layout = equations_.layout();
  Norms greatest{};
  for (std::size_t u = 0; u < correction.size(); ++u) {
    const std::size_t e = layout.entry(static_cast<int>(u));
    double& field = greatest[e < layout.velocity_begin() ? 0 : e < layout.pressure_begin() ? 1 : 2];
    const double scaled = std::abs(correction[u]) * weights_[u];
    if (!(scaled <= field || std::isnan(field))) field = scaled;
  }
  return greatest;
}

double Newton::norm(const Norms& norms) {
  const double sum = norms[0] + norms[1] + norms[2];
  return std::isnan(sum) ? sum : std::max({norms[0], norms[1], norms[2]});
}

std::size_t Newton::greatest(const std::vector<double>& correction) const {
  int found = 0;
  for (int u = 1; u < equations_.layout().unknowns(); ++u)
    if (std::abs(correction[u]) * weights_[u] > std::abs(correction[found]) * weights_[found]) found = u;
  return equations_.layout().entry(found);
}

const char* Newton::flaw() const {
  return equations_.least_jacobian().value > 0 ? "makes forces that are not finite"
                                               : "turns cells inside out";
}

double Newton::inner(const std::vector<double>& a, const std::vector<double>& b) const {
  double sum = 0;
  for (std::size_t u = 0; u < a.size(); ++u) sum += a[u] * b[u] * weights_[u] * weights_[u];
  return sum;
}

NewtonReport Newton::solve(const Stage& stage, std::span<double> y, const NewtonOptions& options) {
  NewtonReport report;
  const auto converge = [&] {
    sizes_ = sizes_with(y);
    report.converged = true;
    return report;
  };
  std::vector<double> begin(y.begin(), y.end());
  if (!evaluate(stage, y)) {
    report.failure = fmt::format("the guess {}", flaw());
    return report;
  }
  if (std::all_of(residual_.begin(), residual_.end(), [](double r) { return r == 0; })) return converge();
  if (factorised_) {
    const Outcome outcome = iterate(stage, y, options, report);
    if (outcome == Outcome::converged) return converge();
    if (outcome == Outcome::failed) std::copy(begin.begin(), begin.end(), y.begin());
    if (!evaluate(stage, y)) {
      std::copy(begin.begin(), begin.end(), y.begin());
      evaluate(stage, y);
    }
  }
  while (report.iterations < options.most_iterations) {
    if (!refresh(stage, y)) {
      report.failure = singular;
      return report;
    }
    bool converged = false;
    if (!damped_step(stage, y, options, report, converged)) return report;
    if (!converged) {
      const std::vector<double> good(y.begin(), y.end());
      const Outcome outcome = iterate(stage, y, options, report);
      converged = outcome == Outcome::converged;
      if (outcome == Outcome::failed) std::copy(good.begin(), good.end(), y.begin());
      if (!converged && !evaluate(stage, y)) {
        std::copy(good.begin(), good.end(), y.begin());
        evaluate(stage, y);
      }
    }
    if (converged) return converge();
  }
  report.failure = fmt::format("no convergence in {} iterations", report.iterations);
  return report;
}

Newton::Outcome Newton::iterate(const Stage& stage, std::span<double> y, const NewtonOptions& options,
                                NewtonReport& report) {
  // Iterations that a new factorisation is worth, and convergence that never pays.
  constexpr double patience = 9, slowest = 0.7;
  std::vector<std::vector<double>> steps;
  std::vector<double> squares;
  std::vector<double> z;
  double before = 0;
  Norms fields_before{};
  while (report.iterations < options.most_iterations) {
    correct(z);
    for (std::size_t j = 0; j + 1 < steps.size(); ++j) {
      const double factor = inner(steps[j], z) / squares[j];
      for (std::size_t u = 0; u < z.size(); ++u) z[u] += factor * steps[j + 1][u];
    }
    if (!steps.empty()) {
      const double share = inner(steps.back(), z) / squares.back();
      if (share >= 0.9) return Outcome::slow;
      for (double& entry : z) entry /= 1 - share;
    }
    weigh(y);
    const Norms fields = norms(z);
    const double size = norm(fields);
    if (!std::isfinite(size)) return Outcome::failed;
    ++counts_.iterations;
    ++report.iterations;
    const double contraction = before > 0 ? size / before : 0;
    if (before > 0 && contraction >= 2) return Outcome::failed;
    add(y, 1.0, z);
    // Each field by its own contraction: the mesh, whose equations are linear, contracts at once and says
    // nothing about blood.
    bool small = true;
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const double rate = fields_before[f] > 0 ? fields[f] / fields_before[f] : 1;
      small = small && (fields[f] <= 0.01 * options.tolerance ||
                        (rate < 1 && fields[f] * rate / (1 - rate) <= options.tolerance));
    }
    if (small) {
      equations_.complete(stage, y);
      return Outcome::converged;
    }
    if (before > 0 && size > options.tolerance) {
      if (contraction > slowest) return Outcome::slow;
      if (std::log(options.tolerance / size) / std::log(contraction) > patience) return Outcome::slow;
    }
    if (!evaluate(stage, y)) return Outcome::failed;
    squares.push_back(inner(z, z));
    if (squares.back() == 0) return Outcome::converged;
    steps.push_back(z);
    before = size;
    fields_before = fields;
  }
  return Outcome::slow;
}

bool Newton::damped_step(const Stage& stage, std::span<double> y, const NewtonOptions& options,
                         NewtonReport& report, bool& converged) {
  constexpr double smallest = 1.0 / 256;
  std::vector<double> step, simplified;
  correct(step);
  weigh(y);
  if (!std::isfinite(norm(norms(step)))) {
    report.failure = singular;
    return false;
  }
  report.worst = greatest(step);
  const std::vector<double> from(y.begin(), y.end());
  bool fit = true;
  ++counts_.iterations;
  ++report.iterations;
  for (double factor = 1; factor >= smallest; factor /= 2) {
    std::copy(from.begin(), from.end(), y.begin());
    add(y, factor, step);
    fit = evaluate(stage, y);
    if (!fit) continue;
    correct(simplified);
    weigh(y);
    const double size = norm(norms(step)), next = norm(norms(simplified));
    if (!std::isfinite(size) || !std::isfinite(next)) continue;
    if (factor == 1 && next <= options.tolerance && next <= 0.5 * size) {
      add(y, 1.0, simplified);
      equations_.complete(stage, y);
      converged = true;
      return true;
    }
    if (next <= std::max(1 - factor / 4, options.growth) * size || size <= options.tolerance) return true;
  }
  report.failure =
      fit ? "no step towards a solution was found" : fmt::format("every step towards a solution {}", flaw());
  return false;
}

}  // namespace tunica::coupled
