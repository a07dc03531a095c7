// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/tier.hpp"

namespace tunica {

/// A run of a tier whose results, and on the way its checkpoints, are kept in a folder.
class StoredRun {
 public:
  /// Sets the run up and looks at what the folder holds, but writes nothing. To resume, a whole result of
  /// this scene and tier is taken as it is, and a checkpoint as the place to go on from; without either the
  /// run begins. Scene and tier must outlive it.
  /// Throws InvalidInput as Tier::prepare and read_checkpoint do, and when the run is to be resumed in a
  /// folder that holds the result of another scene, of other contents of a file that it names, or of another
  /// tier.
  StoredRun(const Tier& tier, const Scene& scene, std::filesystem::path folder, bool resume);

  /// True when the folder already holds the whole result: there is nothing to execute.
  bool is_complete() const { return !run_; }
  bool goes_on() const { return checkpoint_.has_value(); }
  const std::filesystem::path& folder() const { return folder_; }
  /// What a user should know before the run; none when it is complete.
  std::vector<std::string> warnings() const;

  /// Makes the folder, removes the checkpoint of an earlier run and computes, once. `control` tells how to
  /// watch the run; its `save` and `resume` are set here. A checkpoint that cannot be written is told to
  /// `not_saved` and the run goes on. Throws OutputFailure.
  Result execute(
      RunControl control,
      const std::function<void(const std::string&)>& not_saved = [](const std::string&) {});

  /// Writes the result. The checkpoint goes with a whole result; else it stays for --resume.
  void store(const Result& result) const;

 private:
  const Tier& tier_;
  const Scene& scene_;
  std::filesystem::path folder_;
  nlohmann::ordered_json files_;  ///< input_files when the run was set up
  bool pressure_is_given_;        ///< at the inlet
  std::optional<Checkpoint> checkpoint_;
  std::unique_ptr<TierRun> run_;
};

}  // namespace tunica
