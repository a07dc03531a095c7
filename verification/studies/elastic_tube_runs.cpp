// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/studies/elastic_tube_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.hpp"

namespace tunica::verification {

double TubeTrace::at(double when) const {
  const auto next = std::upper_bound(time.begin(), time.end(), when);
  if (next == time.begin()) return displacement.front();
  if (next == time.end()) return displacement.back();
  const auto k = static_cast<std::size_t>(next - time.begin());
  return std::lerp(displacement[k - 1], displacement[k], (when - time[k - 1]) / (time[k] - time[k - 1]));
}

TubePeak peak_of(const TubeTrace& trace) {
  const auto greatest = std::max_element(trace.displacement.begin(), trace.displacement.end());
  if (greatest == trace.displacement.begin() || greatest + 1 >= trace.displacement.end())
    throw std::logic_error("peak_of: the displacement has no peak");
  const auto k = static_cast<std::size_t>(greatest - trace.displacement.begin());
  // Newton's form through the three points; their times need not be equidistant.
  const double t0 = trace.time[k - 1], t1 = trace.time[k], t2 = trace.time[k + 1];
  const double u0 = trace.displacement[k - 1], u1 = trace.displacement[k], u2 = trace.displacement[k + 1];
  const double slope = (u1 - u0) / (t1 - t0), curve = ((u2 - u1) / (t2 - t1) - slope) / (t2 - t0);
  const double time = curve < 0 ? 0.5 * (t0 + t1) - slope / (2 * curve) : t1;
  return {time, u0 + slope * (time - t0) + curve * (time - t0) * (time - t1)};
}

TubeRun tube_run(const run::Outcome& outcome) {
  if (outcome.ending != run::Ending::done) throw SolverFailure(outcome.reason);
  const observables::Table& table = outcome.stored->result.observables;
  TubeRun run{};
  run.trace.time = table.find("time")->values;
  constexpr double mm = 10;  // in a cm
  for (const double u : table.find("radial_displacement.P1")->values)
    run.trace.displacement.push_back(mm * u);
  run.peak = peak_of(run.trace);
  const RunRecord& record = outcome.stored->result.record;
  run.unknowns = record.unknowns;
  run.steps = record.steps;
  run.seconds = record.solve_seconds;
  return run;
}

double greatest_difference(const TubeTrace& trace, const TubeTrace& reference, double until) {
  double greatest = 0;
  for (std::size_t k = 0; k < reference.time.size() && reference.time[k] <= until; ++k)
    greatest = std::max(greatest, std::abs(trace.at(reference.time[k]) - reference.displacement[k]));
  return greatest;
}

double extrapolated(double coarse, double fine, double order) {
  return fine + (fine - coarse) / (std::pow(2.0, order) - 1);
}

std::optional<double> observed_order(double coarse, double middle, double fine) {
  const double ratio = (middle - coarse) / (fine - middle);
  if (!(ratio > 0) || !std::isfinite(ratio)) return {};
  return std::log2(ratio);
}

std::string order_text(double coarse, double middle, double fine) {
  if (std::abs(fine - middle) < 2e-5 * std::abs(fine)) return "converged";
  const auto order = observed_order(coarse, middle, fine);
  return order ? fmt::format("{:.2f}", *order) : "not monotone";
}

}  // namespace tunica::verification
