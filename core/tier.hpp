// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/observables/checkpoint.hpp"
#include "core/observables/result.hpp"
#include "core/run/quantity.hpp"
#include "core/scene/scene.hpp"

namespace tunica {

/// Where a run stands, told to the caller now and then.
struct Progress {
  int beat = 0;         ///< 1 for the first, 0 on the way to the state that the run starts from
  double time = 0;      ///< s of simulated time
  double end_time = 0;  ///< s
  long step = 0;
  long newton_iterations = 0;
};

/// How a caller watches a run, ends it early, keeps where it stood and lets it go on from there.
struct RunControl {
  std::function<void(const Progress&)> report = [](const Progress&) {};
  std::function<bool()> interrupted = [] { return false; };
  /// Called by a tier when it has come some way, counted in steps or simulated time and never by the clock,
  /// so that a resumed run takes the very steps of one that was not disturbed.
  std::function<void(const Checkpoint&)> save = [](const Checkpoint&) {};
  /// Where the run is to go on; null to begin. It outlives the run.
  const Checkpoint* resume = nullptr;
};

/// A computation that has been set up for a scene, which must outlive it.
class TierRun {
 public:
  virtual ~TierRun() = default;
  /// Computes, once. A solver that gives up returns what it has with record.failure set.
  virtual Result execute(const RunControl& control) = 0;
  /// What a user should know before the run, one line each: that the state to be computed is unstable.
  virtual std::vector<std::string> warnings() const { return {}; }
};

/// One of the models that can answer a scene. A tier knows core only, never another tier.
class Tier {
 public:
  virtual ~Tier() = default;
  virtual std::string_view name() const = 0;
  /// False for a tier that is here by name only: another program computes it.
  virtual bool computes() const { return true; }
  /// Empty when the tier can compute the scene, otherwise the reason, naming key and remedy.
  virtual std::string refusal(const Scene& scene) const = 0;
  /// True when the tier's model is meant for the scene, so that `--tier auto` may choose it.
  virtual bool suits(const Scene& scene) const = 0;
  /// Sets the computation up. Throws InvalidInput for a scene that the tier cannot compute, before
  /// anything has been written.
  virtual std::unique_ptr<TierRun> prepare(const Scene& scene) const = 0;
  /// The answer by a way that is shorter than a result's tables, as accurate as the scene asks; nullopt where
  /// the tier has none for this question. Any number of threads may ask at once. Throws InvalidInput as
  /// prepare does, SolverFailure saying when and why, and Interrupted.
  virtual std::optional<run::Answer> answer(const Scene& /*scene*/, const run::Question& /*question*/,
                                            const RunControl& /*control*/) const {
    return std::nullopt;
  }
};

/// The tiers of this build, the cheapest first.
using TierList = std::vector<std::unique_ptr<Tier>>;

}  // namespace tunica
