// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/recruitment_log.hpp"

#include <fmt/format.h>

namespace tunica::lumped {

RecruitmentLog::RecruitmentLog(const Network& network, std::vector<std::string> parameters)
    : network_(network), parameters_(std::move(parameters)), events_(observables::event_table()) {
  if (parameters_.empty()) return;
  sensitivities_ = observables::event_table();
  observables::add_sensitivity_columns(sensitivities_, "time", "s", parameters_);
}

int RecruitmentLog::events() const {
  return static_cast<int>(network_.curve().thresholds().size());
}

void RecruitmentLog::event_values(const double* y, double* values) const {
  const double strain = network_.mid_stretch(y).strain();
  for (const auto& threshold : network_.curve().thresholds()) *values++ = strain - (threshold.stretch - 1);
}

/// dt*/dtheta of a crossing s(t*) = s_threshold: -(ds/dtheta - ds_threshold/dtheta) / (ds/dt).
std::vector<double> RecruitmentLog::derivatives(const Integrator& integrator,
                                                const radial::Threshold& threshold) const {
  const double* y = integrator.state();
  const double time = integrator.time();
  const auto stretch_along = [&](const double* dy, int k) {
    return network_.outside_derivative(time, y, dy, k).lumen_strain.derivative[0];
  };
  std::vector<double> rate(network_.unknowns()), result;
  network_.rate(time, y, rate.data());
  const double speed = stretch_along(rate.data(), -1);
  for (int k = 0; k < network_.parameters(); ++k)
    result.push_back(-(stretch_along(integrator.sensitivity(k), k) - threshold.derivatives[k]) / speed);
  return result;
}

void RecruitmentLog::record(const Integrator& integrator, const Crossing& crossing) {
  const auto& threshold = network_.curve().thresholds()[crossing.index];
  const double time = integrator.time();
  const auto moved = derivatives(integrator, threshold);
  const observables::Event event{time, threshold.place + 1, static_cast<int>(threshold.family) + 1,
                                 crossing.rising};
  observables::append(events_, event);
  if (!parameters_.empty()) {
    const std::size_t first = observables::event_table().columns().size();
    observables::append(sensitivities_, event);
    for (std::size_t k = 0; k < moved.size(); ++k) sensitivities_[first + k].values.push_back(moved[k]);
  }
  if (tallies_.empty()) return;
  Tally& tally = tallies_[crossing.index];
  if (tally.recruited) tally.total += time - tally.since;
  for (std::size_t k = 0; k < moved.size(); ++k)
    tally.derivatives[k] += crossing.rising ? -moved[k] : moved[k];
  tally.since = time;
  tally.recruited = crossing.rising;
}

void RecruitmentLog::begin_last_beat(double time, const double* y) {
  const double stretch = network_.mid_stretch(y).value();
  for (const auto& threshold : network_.curve().thresholds())
    tallies_.push_back(
        {time, stretch > threshold.stretch, 0.0, std::vector<double>(parameters_.size(), 0.0)});
}

void RecruitmentLog::end_last_beat(double time) {
  if (tallies_.empty()) return;
  auto& table = recruited_time_;
  table.add("point", "");
  table.add("family", "1");
  table.add("recruited_time", "s");
  observables::add_sensitivity_columns(table, "recruited_time", "s", parameters_);
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    const auto& threshold = network_.curve().thresholds()[i];
    const Tally& tally = tallies_[i];
    table[0].labels.push_back(fmt::format("P{}", threshold.place + 1));
    table[1].values.push_back(static_cast<double>(threshold.family + 1));
    table[2].values.push_back(tally.total + (tally.recruited ? time - tally.since : 0.0));
    for (std::size_t k = 0; k < parameters_.size(); ++k) table[3 + k].values.push_back(tally.derivatives[k]);
  }
}

void RecruitmentLog::store(Result& result) && {
  result.events = std::move(events_);
  result.event_sensitivities = std::move(sensitivities_);
  result.recruited_time = std::move(recruited_time_);
}

}  // namespace tunica::lumped
