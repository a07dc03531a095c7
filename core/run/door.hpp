// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/run/quantity.hpp"
#include "core/run/scene_source.hpp"
#include "core/stored_run.hpp"
#include "core/tier.hpp"

namespace tunica::run {

/// One computation: a scene with overrides, by a tier.
struct Case {
  std::string tier = "auto";
  std::vector<std::string> overrides = {};  ///< after those of the source
};

enum class Ending {
  done,
  gave_up,     ///< the solver, or the machine's memory
  refused,     ///< the input; nothing was computed
  interrupted  ///< by the caller
};
/// "done", "gave-up", "refused", "interrupted".
const char* name_of(Ending ending);

/// What a computation took.
struct Cost {
  double wall_seconds = 0;                 ///< set-up included; of a process from its start to its end
  double cpu_seconds = observables::none;  ///< of a process
  double mebibytes = observables::none;    ///< largest resident set, of a process
};

struct Outcome {
  Ending ending = Ending::done;
  std::string reason;               ///< one line, empty when done
  double time = observables::none;  ///< s of the run, to which it came; `none` where it did not begin
  std::string tier;                 ///< that computed; empty for a scene or tier that is refused
  Answer answer;                    ///< of ask(), when done
  Cost cost;
  std::optional<StoredResult> stored;  ///< of compute(): what there is
};

/// Where a whole result is kept, and what becomes of what lies there.
struct Keep {
  std::filesystem::path folder;  ///< empty: nowhere, or in the door's cache
  Earlier earlier = Earlier::resume;
  /// Names of files there that are made from the result: those of an earlier one do not stand beside it.
  std::vector<std::string> derived = {};
  /// Adds to the folder when the result is there, before others may use it.
  std::function<void(const std::filesystem::path&, const Result&)> beside = [](const std::filesystem::path&,
                                                                               const Result&) {};
};

struct DoorOptions {
  /// The program that computes what this process cannot, and everything where `processes` is set.
  std::filesystem::path program = {};
  /// Each case in a process of its own, so that its cost is known from outside.
  bool processes = false;
  int ranks = 1;  ///< of the processes of tiers that this program does not compute; more than 1: by mpirun
  /// Folder in which whole results without a folder of their own are kept by what decides them (scene, tier,
  /// contents of files, version and commit of the program), and taken from; empty for none.
  std::filesystem::path cache = {};
};

/// A case that has been set up, to be computed once.
class Prepared {
 public:
  virtual ~Prepared() = default;
  virtual const Scene& scene() const = 0;
  virtual const Tier& tier() const = 0;
  /// True when its folder holds the whole result already: execute() reads it.
  virtual bool is_complete() const = 0;
  /// What a user should know before the run, one line each.
  virtual std::vector<std::string> warnings() const = 0;
  /// The whole result. `not_saved` is told of checkpoints that could not be written; the run goes on. Throws
  /// OutputFailure where the result cannot be kept, and InvalidInput when another run has begun in the folder
  /// since this one was set up.
  virtual Outcome execute(
      const RunControl& control,
      const std::function<void(const std::string&)>& not_saved = [](const std::string&) {}) = 0;
};

/// The override that asks a run for derivatives by keys.
std::string sensitivity_override(const std::vector<std::string>& keys);

/// The one door through which cases are computed: in process by the tiers of this program, by a process of
/// their own where a tier is here by name only. Any number of threads may ask at once.
class Door {
 public:
  /// The tiers must outlive it.
  Door(const TierList& tiers, SceneSource source, DoorOptions options = {});

  /// Quantities and gradients, by the tier's own short way where it has one. A case that cannot be computed,
  /// or that gives up, is an outcome with its reason and no exception. Throws OutputFailure where a process
  /// that is needed has no room for its result.
  Outcome ask(const Case& what, const Question& question, const RunControl& control = {}) const;

  /// The whole result, likewise. Throws OutputFailure where it cannot be kept.
  Outcome compute(const Case& what, const Keep& keep = {}, const RunControl& control = {}) const;

  /// compute() in two steps, for a caller who has something to say between them. Throws InvalidInput for a
  /// case that cannot be computed, before anything is written. The door must outlive what it returns.
  std::unique_ptr<Prepared> prepare(const Case& what, const Keep& keep) const;
  /// The same for a tier that the caller has.
  std::unique_ptr<Prepared> prepare(const Tier& tier, const std::vector<std::string>& overrides,
                                    const Keep& keep) const;

  const SceneSource& source() const { return source_; }
  const TierList& tiers() const { return tiers_; }
  const DoorOptions& options() const { return options_; }

 private:
  class InProcess;
  class ByProcess;

  bool needs_process(const Tier& tier) const { return options_.processes || !tier.computes(); }
  std::unique_ptr<Prepared> prepare(Scene scene, const Tier& tier, const std::vector<std::string>& overrides,
                                    Keep keep) const;
  std::filesystem::path cached(const Scene& scene, const Tier& tier) const;

  const TierList& tiers_;
  SceneSource source_;
  DoorOptions options_;
};

}  // namespace tunica::run
