// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/coupled/simulation.hpp"
#include "core/observables/result.hpp"

namespace tunica::coupled {

/// How equations and observables depend on one key of the scene while all entries of the state are held.
class KeyDerivative {
 public:
  virtual ~KeyDerivative() = default;
  /// Of Equations::residual at a complete state.
  virtual void residual(const Stage& stage, std::span<const double> y, std::span<double> rows) const = 0;
  /// Of what Equations::complete puts in place, by entry of the state.
  virtual void placed(const Stage& stage, std::span<const double> y, std::span<double> out) const = 0;
  /// Of what Equations::follow moves, by entry of the state.
  virtual void follow(double time, std::span<const double> y, std::span<double> out) const = 0;
  /// Of a row of observables, and of the event functions, at a state whose own derivative is s.
  virtual observables::Sample sample(double time, std::span<const double> y,
                                     std::span<const double> s) const = 0;
  virtual std::vector<double> event_values(std::span<const double> y, std::span<const double> s) const = 0;
};

/// A vessel's equations with their derivatives by keys.
class KeyedEquations {
 public:
  virtual ~KeyedEquations() = default;
  virtual const Equations& equations() const = 0;
  virtual int keys() const = 0;
  virtual const KeyDerivative& key(int index) const = 0;
  /// Derivatives of the residual along directions that leave the unknowns where they are: rows by direction.
  virtual void change(const Stage& stage, std::span<const double> y, std::span<const Direction> along,
                      std::span<std::vector<double>> rows) const = 0;
};

/// Derivatives s = dy/dkey of a vessel's states along a run: the discrete equations of each step,
/// differentiated with the steps held. With the step's own equations F(y, c y + history, key) = 0,
///   (F_y + c F_r) s = -F_key - F_r history_s,
/// where history_s is what the same time scheme makes of the s before, and the derivative on the left is
/// that of the step at its solution, whose factors the next step begins with. Where the mesh lags, what is
/// expected of it has a derivative, too.
class Sensitivities final : public StepCompanion {
 public:
  /// The equations must outlive it. `options` of the simulation that it goes along with.
  Sensitivities(std::unique_ptr<KeyedEquations> equations, const SimulationOptions& options);

  const KeyedEquations& keyed() const { return *keyed_; }

  /// Begins at rest, or from the derivatives of a state, which has no rates.
  void start_at_rest(double time, std::span<const double> y);
  void start(double time, std::vector<std::vector<double>> s);

  void restart(double time) override;
  void step(const time::Step& step, const Stage& stage, std::span<const double> y, Newton& newton) override;

  /// Derivatives of a row of observables at a time within the last step, or at the time of the start.
  std::vector<observables::Sample> sample(double time, std::span<const double> y);
  /// Derivatives of the time at which an event function passes zero, at a time within the last step; `speed`
  /// is its rate there.
  std::vector<double> event_times(double time, std::span<const double> y, std::size_t event, double speed);

  nlohmann::json save() const;
  void restore(const nlohmann::json& saved);

 private:
  std::span<const double> at(double time, std::size_t key);

  std::unique_ptr<KeyedEquations> keyed_;
  std::vector<time::Scheme> schemes_;  ///< by key
  std::vector<ExpectedMesh> expected_;
  std::vector<std::vector<double>> s_;  ///< of the last step, by key
  std::vector<double> between_;
};

/// Derivatives by each key of a steady state of the equations. Throws SolverFailure where their derivative is
/// singular.
std::vector<std::vector<double>> steady_sensitivities(const KeyedEquations& keyed, Newton& newton,
                                                      double time, std::span<const double> y);

}  // namespace tunica::coupled
