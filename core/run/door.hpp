// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/run/quantity.hpp"
#include "core/run/scene_source.hpp"
#include "core/tier.hpp"

namespace tunica::run {

/// One computation: a scene with overrides, by a tier.
struct Case {
  std::string tier = "auto";
  std::vector<std::string> overrides;  ///< after those of the source
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
  double wall_seconds = 0;  ///< set-up included; of a process from its start to its end
  double cpu_seconds = observables::none;  ///< of a process, or of the thread that computed
  double mebibytes = observables::none;    ///< largest resident set, of a process
};

struct Outcome {
  Ending ending = Ending::done;
  std::string reason;                ///< one line, empty when done
  double time = observables::none;   ///< s of the run, to which it came; none when nothing was computed
  std::string tier;                  ///< that computed
  Answer answer;                     ///< empty unless done
  Cost cost;
  std::optional<StoredResult> stored;  ///< of compute(): what there is
};

struct DoorOptions {
  /// The program that computes what this process cannot, and all where `processes` is set.
  std::filesystem::path program;
  /// Each case in a process of its own, so that its cost is known from outside.
  bool processes = false;
  int ranks = 1;                ///< by mpirun, of tiers that can use them
  std::filesystem::path cache;  ///< folder of whole results by what decides them; empty for none
};

/// The one door through which cases are computed: in process by the tiers of this program, by a process of
/// their own where the tier is here by name only. A case that fails is an outcome with its reason, never an
/// exception. Any number of threads may ask at once.
class Door {
 public:
  /// The tiers must outlive it.
  Door(const TierList& tiers, SceneSource source, DoorOptions options = {});

  /// Quantities and gradients, by the tier's own short way where it has one.
  Outcome ask(const Case& what, const Question& question, const RunControl& control = {}) const;

  /// The whole result, kept in `folder`, or in the cache or nowhere where it is empty.
  Outcome compute(const Case& what, const std::filesystem::path& folder = {},
                  const RunControl& control = {}) const;

  const SceneSource& source() const { return source_; }
  const TierList& tiers() const { return tiers_; }

 private:
  const TierList& tiers_;
  SceneSource source_;
  DoorOptions options_;
};

}  // namespace tunica::run
