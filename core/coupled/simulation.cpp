// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/coupled/failure.hpp"
#include "core/error.hpp"
#include "core/observables/checkpoint.hpp"

namespace tunica::coupled {

ExpectedMesh::ExpectedMesh(const Layout& layout)
    : mesh_(layout.mesh_follows() ? layout.velocity_begin() : 0), rate_(mesh_.size()) {}

Stage ExpectedMesh::stage(const time::Scheme& scheme, double time) {
  if (!mesh_.empty()) scheme.expect(mesh_, rate_);
  return {time, scheme.stage().coefficient, scheme.history(), mesh_, rate_};
}

Simulation::Simulation(const Equations& equations, const SimulationOptions& options)
    : equations_(equations),
      options_(options),
      newton_(equations),
      scheme_(options.method, options.spectral_radius),
      expected_mesh_(equations.layout()),
      control_(options.steps),
      candidate_(equations.layout().size()),
      error_(equations.layout().size()),
      shares_(equations.volume_shares()) {
  // What is still a hundredth of its size to come need not be computed to its own last digits.
  constexpr double small = 0.01;
  const auto& s = options.scales;
  newton_.set_sizes({small * s.displacement, small * s.velocity, small * s.pressure});
}

void Simulation::start(double time, std::vector<double> state, std::vector<double> rates) {
  if (rates.empty()) {
    equations_.complete({time, 0, {}}, state);
    rates.assign(state.size(), 0.0);
  }
  scheme_.start(time, std::move(state), std::move(rates));
  control_.restart();
  newton_.forget();
  step_begin_ = time;
}

bool Simulation::at_milestone() const {
  return control_.counts().accepted > 0 && control_.counts().accepted % options_.milestone == 0;
}

bool Simulation::jumps_at(double time) const {
  return std::binary_search(options_.jumps.begin(), options_.jumps.end(), time);
}

double Simulation::error_norm(std::span<const double> stage_value) {
  scheme_.error(stage_value, error_);
  const Layout& layout = equations_.layout();
  const auto& sizes = newton_.sizes();
  const auto& scales = options_.scales;
  const bool moves = equations_.has_wall();
  const double size =
      moves ? std::max(sizes.displacement, scales.displacement) : std::max(sizes.velocity, scales.velocity);
  double sum = 0, greatest = 0;
  for (std::size_t n = 0; n < shares_.size(); ++n) {
    const int node = static_cast<int>(n);
    for (int c = 0; c < layout.components(); ++c) {
      const std::size_t entry = moves ? layout.displacement(node, c) : layout.velocity(node, c);
      const double square = shares_[n] * error_[entry] * error_[entry];
      sum += square;
      if (square <= greatest) continue;
      greatest = square;
      worst_ = entry;
    }
  }
  double norm = size > 0 ? std::sqrt(sum) / (options_.tolerance * size) : 0;
  const double pressure = std::max(sizes.pressure, scales.pressure);
  for (std::size_t e = layout.scalar_begin(); e < layout.size() && pressure > 0; ++e) {
    // What drives a given flow in is determined by the rate of that flow alone: where this changes at once no
    // step makes its error small (time::Scheme::error).
    if (e == layout.inlet_pressure) continue;
    const double share = std::abs(error_[e]) / (options_.tolerance * pressure);
    if (share <= norm || std::isnan(norm)) continue;
    norm = share;
    worst_ = e;
  }
  return norm;
}

void Simulation::advance(double stop) {
  const auto jump = std::upper_bound(options_.jumps.begin(), options_.jumps.end(), time());
  if (jump != options_.jumps.end()) stop = std::min(stop, *jump);
  // Only now, so that the step up to the jump could be interpolated.
  if (jumps_at(time())) {
    scheme_.start(time(), scheme_.value());
    control_.restart();
    if (companion_) companion_->restart(time());
  }
  const NewtonOptions newton{options_.newton_tolerance, 60};
  for (;;) {
    const time::Step step = control_.next(time(), stop);
    const time::Stage& at = scheme_.begin(step);
    const auto prediction = scheme_.prediction();
    std::copy(prediction.begin(), prediction.end(), candidate_.begin());
    // A step up to a jump bears the loads of before.
    const double loads = jumps_at(at.time) ? at.time * (1 - 1e-12) : at.time;
    const Stage stage = expected_mesh_.stage(scheme_, loads);
    const NewtonReport report = newton_.solve(stage, candidate_, newton);
    time::Verdict verdict = time::Verdict::retry;
    if (report.converged) {
      const int order = options_.steps.fixed ? 0 : scheme_.error_order();
      verdict = control_.judge(order > 0 ? error_norm(candidate_) : 0.0, order);
    } else {
      newton_.forget();
      verdict = control_.solve_failed();
    }
    if (verdict == time::Verdict::give_up) give_up(report);
    if (verdict != time::Verdict::accept) continue;
    if (companion_) companion_->step(step, stage, candidate_, newton_);
    break;
  }
  step_begin_ = time();
  equations_.follow(scheme_.stage().time, candidate_);
  scheme_.accept(candidate_);
  least_jacobian_ = std::min(least_jacobian_, equations_.least_jacobian().value);
  if (at_milestone()) newton_.forget();
}

void Simulation::give_up(const NewtonReport& report) const {
  const double step = control_.options().minimum;
  if (report.converged)
    throw SolverFailure(
        fmt::format("even the smallest time step, {:.2g} s, has too large an error, in the {}", step,
                    place_of(equations_, worst_)));
  throw SolverFailure(
      fmt::format("the smallest time step, {:.2g} s, was not solved: {}", step, explain(equations_, report)));
}

namespace {

nlohmann::json pack_all(const std::vector<std::vector<double>>& all) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& one : all) list.push_back(pack(one));
  return list;
}
std::vector<std::vector<double>> unpack_all(const nlohmann::json& list) {
  std::vector<std::vector<double>> all;
  for (const auto& one : list) all.push_back(unpack(one));
  return all;
}

}  // namespace

nlohmann::json save_scheme(const time::Scheme& scheme) {
  const auto saved = scheme.save();
  return {{"steps", saved.steps},
          {"rate_given", saved.rate_given},
          {"numbers", pack(std::vector<double>{saved.time, saved.step_sizes[0], saved.step_sizes[1],
                                               saved.rate_offsets[0], saved.rate_offsets[1]})},
          {"values", pack_all(saved.values)},
          {"rates", pack_all(saved.rates)}};
}

void restore_scheme(const nlohmann::json& saved, time::Scheme& scheme) {
  const auto numbers = unpack(saved.at("numbers"));
  time::Scheme::Saved past;
  past.steps = saved.at("steps");
  past.rate_given = saved.at("rate_given");
  past.time = numbers.at(0);
  past.step_sizes = {numbers.at(1), numbers.at(2)};
  past.rate_offsets = {numbers.at(3), numbers.at(4)};
  past.values = unpack_all(saved.at("values"));
  past.rates = unpack_all(saved.at("rates"));
  scheme.restore(past);
}

nlohmann::json Simulation::save() const {
  const auto& control = control_.save();
  const auto& sizes = newton_.sizes();
  nlohmann::json saved;
  saved["scheme"] = save_scheme(scheme_);
  saved["control"] = {
      {"numbers", pack(std::vector<double>{control.wanted, control.tried, control.tried_end, control.regular,
                                           control.cell_end, control.accepted, control.error_before})},
      {"counts",
       {control.divided ? 1 : 0, control.order_before, control.failed, control.rejected, control.hold,
        control.counts.accepted, control.counts.rejected_by_error, control.counts.rejected_by_solver}}};
  saved["sizes"] = pack(std::vector<double>{sizes.displacement, sizes.velocity, sizes.pressure});
  saved["progress"] = pack(std::vector<double>{step_begin_, least_jacobian_});
  return saved;
}

void Simulation::restore(const nlohmann::json& saved) {
  restore_scheme(saved.at("scheme"), scheme_);
  const auto& c = saved.at("control");
  const auto steps = unpack(c.at("numbers"));
  const auto counts = c.at("counts").get<std::vector<long>>();
  time::StepControl::Saved control;
  control.wanted = steps.at(0);
  control.tried = steps.at(1);
  control.tried_end = steps.at(2);
  control.regular = steps.at(3);
  control.cell_end = steps.at(4);
  control.accepted = steps.at(5);
  control.error_before = steps.at(6);
  control.divided = counts.at(0) != 0;
  control.order_before = static_cast<int>(counts.at(1));
  control.failed = static_cast<int>(counts.at(2));
  control.rejected = static_cast<int>(counts.at(3));
  control.hold = static_cast<int>(counts.at(4));
  control.counts = {counts.at(5), counts.at(6), counts.at(7)};
  control_.restore(control);
  const auto sizes = unpack(saved.at("sizes"));
  newton_.set_sizes({sizes.at(0), sizes.at(1), sizes.at(2)});
  const auto progress = unpack(saved.at("progress"));
  step_begin_ = progress.at(0);
  least_jacobian_ = progress.at(1);
  newton_.forget();
}

}  // namespace tunica::coupled
