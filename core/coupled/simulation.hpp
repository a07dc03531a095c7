// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/coupled/newton.hpp"
#include "core/time/scheme.hpp"
#include "core/time/step_control.hpp"

namespace tunica::coupled {

struct SimulationOptions {
  time::Method method = time::Method::bdf2;
  double spectral_radius = 0.5;  ///< of generalised-alpha
  time::StepOptions steps;
  /// Local error allowed per step, relative to `scales`: the root of the mean square over the wall of the
  /// displacement (in a rigid pipe: over the blood of the velocity) and the pressure at the outlet. Where
  /// fibres of a few points are recruited, the wall there follows at once, and forgets it at once: smaller
  /// steps for its sake would make nothing else more accurate.
  double tolerance = 1e-3;
  double newton_tolerance = 1e-5;  ///< relative to the greatest values so far
  Newton::Sizes scales;            ///< expected sizes of the fields; 0 where nothing is known
  /// Times at which loads jump: steps end there, and the scheme begins anew.
  std::vector<double> jumps;
  /// Accepted steps after which the factorisation is dropped, so that a run resumed there is the same.
  long milestone = 50;
};

/// Where the mesh in the blood is expected within a step, for layouts whose mesh follows the wall.
class ExpectedMesh {
 public:
  explicit ExpectedMesh(const Layout& layout);
  /// The stage of the step that the scheme has begun, with the loads of `time`. It refers to the scheme and
  /// to this.
  Stage stage(const time::Scheme& scheme, double time);

 private:
  std::vector<double> mesh_, rate_;  ///< empty where the mesh is unknown
};

/// What goes along with the accepted steps of a simulation.
class StepCompanion {
 public:
  virtual ~StepCompanion() = default;
  /// The scheme begins anew, after a jump of the loads.
  virtual void restart(double time) = 0;
  /// A step was solved: its stage, and the state that solves it, before the mesh follows where it lags. The
  /// derivative may be computed anew.
  virtual void step(const time::Step& step, const Stage& stage, std::span<const double> y,
                    Newton& newton) = 0;
};

/// A scheme's past for a checkpoint, and back.
nlohmann::json save_scheme(const time::Scheme& scheme);
void restore_scheme(const nlohmann::json& saved, time::Scheme& scheme);

/// Computes a vessel step by step.
class Simulation {
 public:
  /// The equations must outlive it.
  Simulation(const Equations& equations, const SimulationOptions& options);

  /// Begins at `time` from a state and its rates; without rates they are zero, and the state is made to agree
  /// with that. What follows depends on nothing that came before but the sizes of the fields.
  void start(double time, std::vector<double> state, std::vector<double> rates = {});

  /// Takes one step that does not go beyond `stop`; steps whose error is too large and steps that are not
  /// solved are repeated with smaller ones. Throws SolverFailure at the smallest step: when, where and why.
  void advance(double stop);

  /// From now on; it must outlive the simulation. Null for none.
  void accompany(StepCompanion* companion) { companion_ = companion; }

  double time() const { return scheme_.time(); }
  double step_begin() const { return step_begin_; }  ///< of the last step
  const std::vector<double>& state() const { return scheme_.value(); }
  const std::vector<double>& rates() const { return scheme_.rate(); }
  /// State within the last step.
  void interpolate(double time, std::span<double> out) const { scheme_.interpolate(time, out); }
  /// True right after a step that ends at a milestone: the place for a checkpoint.
  bool at_milestone() const;

  const Equations& equations() const { return equations_; }
  const Newton::Sizes& expected_sizes() const { return options_.scales; }
  const Layout& layout() const { return equations_.layout(); }
  Newton& newton() { return newton_; }
  double factor_entries() const { return newton_.factor_entries(); }
  const NewtonCounts& newton_counts() const { return newton_.counts(); }
  const time::StepControl::Counts& step_counts() const { return control_.counts(); }
  double least_jacobian() const { return least_jacobian_; }  ///< of all accepted states

  nlohmann::json save() const;
  void restore(const nlohmann::json& saved);

 private:
  bool jumps_at(double time) const;
  double error_norm(std::span<const double> stage_value);
  [[noreturn]] void give_up(const NewtonReport& report) const;

  const Equations& equations_;
  StepCompanion* companion_ = nullptr;
  SimulationOptions options_;
  Newton newton_;
  time::Scheme scheme_;
  ExpectedMesh expected_mesh_;
  time::StepControl control_;
  std::vector<double> candidate_, error_;
  std::size_t worst_ = 0;       ///< entry with the greatest share in the error of the last step tried
  std::vector<double> shares_;  ///< of the nodes in the volume whose error is measured
  double step_begin_ = 0;
  double least_jacobian_ = 1;
};

}  // namespace tunica::coupled
