// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/coupled/sensitivity.hpp"
#include "core/coupled/static_state.hpp"
#include "core/observables/event_log.hpp"
#include "core/tier.hpp"

namespace tunica::coupled {

/// Turns states (see Layout) into the tables of a result. What a vessel has not (blood, wall, fibres) is
/// observables::none.
class Observing {
 public:
  virtual ~Observing() = default;
  /// observables.csv: the columns of observables::standard_table, and those that the tier adds.
  virtual observables::Table observables_table() const = 0;
  virtual void append_observables(double time, std::span<const double> y,
                                  observables::Table& table) const = 0;
  /// Rows of profiles.csv: the wall at mid-length from the inner to the outer surface; none without a wall.
  virtual void append_profile(double time, std::span<const double> y, observables::Table& profiles) const = 0;
  virtual observables::Table along_table() const = 0;
  virtual void append_along(double time, std::span<const double> y, observables::Table& along) const = 0;
  /// Event functions: I4bar - a^2 of families at P1..P4. Of families that act alike the first has an event.
  virtual int events() const = 0;
  virtual void event_values(std::span<const double> y, double* values) const = 0;
  virtual observables::EventPlace event_place(int event) const = 0;
};

/// Turns states into pictures.
class Picturing {
 public:
  virtual ~Picturing() = default;
  /// Meshes and names for the parts that there are. No frames.
  virtual std::vector<observables::FieldSeries> empty_series() const = 0;
  /// Appends a frame to each of the series that empty_series has made.
  virtual void append(double time, std::span<const double> y,
                      std::span<observables::FieldSeries> series) const = 0;
};

/// A vessel as a tier has set it up.
class Vessel {
 public:
  virtual ~Vessel() = default;
  virtual Loading& loading() = 0;
  virtual const Equations& equations() const = 0;
  virtual const CoarserMeshes& coarser() const = 0;
  /// Equations whose steady states are found, where those of equations() are for steps in time alone: their
  /// mesh lags. Null where they serve both.
  virtual std::unique_ptr<StaticMesh> steady_mesh() const { return nullptr; }
  /// The vessel's equations, or those of its steady states, with their derivatives by the keys of
  /// sensitivity.parameters. Null for a tier that has none.
  virtual std::unique_ptr<KeyedEquations> keyed(const Equations& /*equations*/) const { return nullptr; }
  virtual const Observing& observer() const = 0;
  virtual const Picturing& fields() const = 0;
  virtual double local_tolerance() const = 0;   ///< of a time step
  virtual double newton_tolerance() const = 0;  ///< of a time step
  /// The tier's name, and what it computes with: record.tier and record.resolution.
  virtual void describe(RunRecord& record) const = 0;
  /// What a user should know before the run, one line each.
  virtual std::vector<std::string> warnings() const = 0;
  /// Looks at a static state that was found: findings, and numbers for record.resolution.
  virtual void judge_static(std::span<const double>, RunRecord&) const {}
  /// Adds at the end of a run what the tier has to say about it.
  virtual void conclude(RunRecord&) const {}
};

/// Computes a scene with a vessel: start, beats or static state, rows, profiles, pictures, events,
/// checkpoints, and what stopped it. `make` sets the vessel up, which counts as the run's set-up. The scene
/// must outlive the run.
std::unique_ptr<TierRun> vessel_run(const Scene& scene, const std::function<std::unique_ptr<Vessel>()>& make);

}  // namespace tunica::coupled
