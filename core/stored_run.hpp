// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/observables/folder_lock.hpp"
#include "core/tier.hpp"

namespace tunica {

/// What a run does with an earlier one that lies in its folder.
enum class Earlier {
  keep_stopped,  ///< begins anew, unless that would discard the checkpoint of another scene or tier
  resume,  ///< takes a whole result of this scene and tier as it is, goes on from a checkpoint of theirs
  replace  ///< begins anew, whatever lies there
};

/// A run of a tier whose results, and on the way its checkpoints, are kept in a folder, which is locked for
/// it from when both are there until the result is stored.
class StoredRun {
 public:
  /// Sets the run up and looks at what the folder holds, but writes nothing. Scene and tier must outlive it.
  /// A solver that gives up in the set-up is told by execute(), like one that does so later.
  /// Throws InvalidInput as Tier::prepare and read_checkpoint do, when another run is at work in the folder,
  /// when what could be resumed would be discarded without a word, and when the run is to be resumed in a
  /// folder that holds the result of another scene, of other contents of a file that it names, or of another
  /// tier.
  StoredRun(const Tier& tier, const Scene& scene, std::filesystem::path folder, Earlier earlier);
  StoredRun(const Tier& tier, const Scene& scene, std::filesystem::path folder, bool resume)
      : StoredRun(tier, scene, std::move(folder), resume ? Earlier::resume : Earlier::keep_stopped) {}

  /// True when the folder already holds the whole result: there is nothing to execute.
  bool is_complete() const { return is_complete_; }
  bool goes_on() const { return checkpoint_.has_value(); }
  const std::filesystem::path& folder() const { return folder_; }
  /// What a user should know before the run, what lies in the folder included; none when it is complete.
  std::vector<std::string> warnings() const;

  /// Makes the folder, removes the checkpoint of an earlier run and computes, once. `control` tells how to
  /// watch the run; its `save` and `resume` are set here. A checkpoint that cannot be written is told to
  /// `not_saved` and the run goes on. Throws OutputFailure, and InvalidInput when another run has begun in
  /// the folder since this one was set up.
  Result execute(
      RunControl control,
      const std::function<void(const std::string&)>& not_saved = [](const std::string&) {});

  /// Writes the result and calls `beside`, which may add to the folder; then the folder is free for others.
  /// The checkpoint goes with a whole result; else it stays for --resume.
  void store(
      const Result& result, const std::function<void()>& beside = [] {});

 private:
  void look(Earlier earlier);
  void lock_anew();
  Result failed_result(std::string failure) const;

  const Tier& tier_;
  const Scene& scene_;
  std::filesystem::path folder_;
  std::optional<FolderLock> lock_;
  nlohmann::ordered_json files_;  ///< input_files when the run was set up
  bool pressure_is_given_;        ///< at the inlet
  std::optional<Checkpoint> checkpoint_;
  bool is_complete_ = false;
  std::vector<std::string> replaces_;  ///< what of the folder's a user may miss, one line each
  std::unique_ptr<TierRun> run_;
  std::string failure_;  ///< of the set-up
};

}  // namespace tunica
