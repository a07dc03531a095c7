// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/sensitivity.hpp"

#include <utility>

#include "core/error.hpp"

namespace tunica::coupled {

namespace {

/// Completes the derivative of a state whose unknowns' are given, as Equations::complete does the state:
/// prescribed entries, shares of the wall's displacement, and the wall's velocities. Displacements that are
/// prescribed are so whatever the keys.
void complete(const Layout& layout, const Stage& along, std::span<const double> placed, std::span<double> s) {
  for (const auto& entry : layout.prescribed()) s[entry.entry] = entry.is_velocity ? placed[entry.entry] : 0;
  layout.share_out(s);
  for (std::size_t e = 0; e < layout.velocity_begin(); ++e)
    if (layout.unknown(e) < 0) s[e] += placed[e];
  for (const int node : layout.wall_nodes())
    for (int c = 0; c < layout.components(); ++c)
      s[layout.velocity(node, c)] = rate(along, s, layout.displacement(node, c));
}

/// Derivatives of the solution of a stage's equations; `along` has the changes of its history and mesh.
void linearise(const KeyedEquations& keyed, const Stage& stage, std::span<const double> y,
               const std::vector<Stage>& along, Newton& newton, std::vector<std::vector<double>>& s) {
  const Layout& layout = keyed.equations().layout();
  const std::size_t keys = along.size();
  std::vector<std::vector<double>> placed(keys, std::vector<double>(layout.size(), 0.0)), rows(keys);
  std::vector<double> by_key(layout.unknowns());
  std::vector<Direction> directions;
  for (std::size_t k = 0; k < keys; ++k) {
    s[k].assign(layout.size(), 0.0);
    keyed.key(static_cast<int>(k)).placed(stage, y, placed[k]);
    complete(layout, along[k], placed[k], s[k]);
    directions.push_back({along[k], s[k]});
  }
  keyed.change(stage, y, directions, rows);
  if (!newton.refresh(stage, y))
    throw SolverFailure("the derivatives by the keys do not exist: that of the equations is singular");
  for (std::size_t k = 0; k < keys; ++k) {
    keyed.key(static_cast<int>(k)).residual(stage, y, by_key);
    for (std::size_t u = 0; u < by_key.size(); ++u) rows[k][u] = -rows[k][u] - by_key[u];
    if (!newton.linearised(rows[k])) throw SolverFailure("the derivatives by the keys were not found");
    for (int u = 0; u < layout.unknowns(); ++u) s[k][layout.entry(u)] = rows[k][u];
    complete(layout, along[k], placed[k], s[k]);
  }
}

}  // namespace

Sensitivities::Sensitivities(std::unique_ptr<KeyedEquations> equations, const SimulationOptions& options)
    : keyed_(std::move(equations)), s_(keyed_->keys()) {
  for (int k = 0; k < keyed_->keys(); ++k) {
    schemes_.emplace_back(options.method, options.spectral_radius);
    expected_.emplace_back(keyed_->equations().layout());
  }
}

void Sensitivities::start_at_rest(double time, std::span<const double> y) {
  const Stage still{time, 0, {}};
  std::vector<double> placed(y.size());
  for (std::size_t k = 0; k < s_.size(); ++k) {
    s_[k].assign(y.size(), 0.0);
    keyed_->key(static_cast<int>(k)).placed(still, y, placed);
    complete(keyed_->equations().layout(), still, placed, s_[k]);
  }
  start(time, std::move(s_));
  s_.resize(schemes_.size());
}

void Sensitivities::start(double time, std::vector<std::vector<double>> s) {
  for (std::size_t k = 0; k < schemes_.size(); ++k) {
    std::vector<double> rates(s[k].size(), 0.0);
    schemes_[k].start(time, std::move(s[k]), std::move(rates));
  }
}

void Sensitivities::restart(double time) {
  for (time::Scheme& scheme : schemes_) scheme.start(time, scheme.value());
}

void Sensitivities::step(const time::Step& step, const Stage& stage, std::span<const double> y,
                         Newton& newton) {
  std::vector<Stage> along;
  for (std::size_t k = 0; k < schemes_.size(); ++k) {
    schemes_[k].begin(step);
    along.push_back(expected_[k].stage(schemes_[k], stage.time));
  }
  linearise(*keyed_, stage, y, along, newton, s_);
  const Equations& equations = keyed_->equations();
  std::vector<double> moved;
  for (std::size_t k = 0; k < schemes_.size(); ++k) {
    if (equations.layout().mesh_follows()) {
      equations.follow(stage.time, s_[k]);
      moved.assign(y.size(), 0.0);
      keyed_->key(static_cast<int>(k)).follow(stage.time, y, moved);
      for (std::size_t e = 0; e < moved.size(); ++e) s_[k][e] += moved[e];
    }
    schemes_[k].accept(s_[k]);
  }
}

std::span<const double> Sensitivities::at(double time, std::size_t key) {
  const time::Scheme& scheme = schemes_[key];
  if (time == scheme.time()) return scheme.value();
  between_.resize(scheme.value().size());
  scheme.interpolate(time, between_);
  return between_;
}

std::vector<observables::Sample> Sensitivities::sample(double time, std::span<const double> y) {
  std::vector<observables::Sample> samples;
  for (std::size_t k = 0; k < schemes_.size(); ++k)
    samples.push_back(keyed_->key(static_cast<int>(k)).sample(time, y, at(time, k)));
  return samples;
}

std::vector<double> Sensitivities::event_times(double time, std::span<const double> y, std::size_t event,
                                               double speed) {
  std::vector<double> times;
  for (std::size_t k = 0; k < schemes_.size(); ++k)
    times.push_back(-keyed_->key(static_cast<int>(k)).event_values(y, at(time, k))[event] / speed);
  return times;
}

nlohmann::json Sensitivities::save() const {
  nlohmann::json saved = nlohmann::json::array();
  for (const time::Scheme& scheme : schemes_) saved.push_back(save_scheme(scheme));
  return saved;
}

void Sensitivities::restore(const nlohmann::json& saved) {
  for (std::size_t k = 0; k < schemes_.size(); ++k) restore_scheme(saved.at(k), schemes_[k]);
}

std::vector<std::vector<double>> steady_sensitivities(const KeyedEquations& keyed, Newton& newton,
                                                      double time, std::span<const double> y) {
  std::vector<std::vector<double>> s(keyed.keys());
  const Stage still{time, 0, {}};
  linearise(keyed, still, y, std::vector<Stage>(s.size(), still), newton, s);
  return s;
}

}  // namespace tunica::coupled
