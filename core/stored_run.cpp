// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stored_run.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/inlet.hpp"
#include "core/observables/beat_remarks.hpp"
#include "core/observables/inputs.hpp"
#include "core/observables/record.hpp"

namespace tunica {

namespace fs = std::filesystem;

namespace {

/// Whether the folder holds a whole result of this scene, its files and tier. That of another one is refused,
/// so that no result is mixed from two.
bool holds_whole_result(const fs::path& folder, const Scene& scene, const nlohmann::ordered_json& files,
                        const Tier& tier) {
  if (!fs::exists(folder / "record.json")) return false;
  const StoredResult stored = read_result(folder);
  const std::string of_tier = observables::record_text(stored.record, "tier");
  const auto kept_files = stored.record.value("input_files", nlohmann::ordered_json::object());
  const std::string change =
      of_tier != tier.name()
          ? fmt::format("it is of tier {}, not {}", of_tier, tier.name())
          : changed_input(scene, files, observables::record_text(stored.record, "scene_toml"), kept_files);
  if (change.empty()) return observables::record_flag(stored.record, "converged");
  // The result that lay here when a run was killed: its checkpoint is younger and says what is computed here.
  if (has_checkpoint(folder)) return false;
  throw InvalidInput(fmt::format(
      "{}: holds the result of another scene or tier, {}; leave out --resume to replace it, or name another "
      "folder with --out",
      folder.string(), change));
}

}  // namespace

StoredRun::StoredRun(const Tier& tier, const Scene& scene, fs::path folder, bool resume)
    : tier_(tier),
      scene_(scene),
      folder_(std::move(folder)),
      files_(input_files(scene)),
      pressure_is_given_(inlet_from_scene(scene).is_pressure) {
  if (resume) {
    if (holds_whole_result(folder_, scene, files_, tier)) return;
    if (has_checkpoint(folder_)) checkpoint_ = read_checkpoint(folder_, scene, tier.name());
  }
  run_ = tier.prepare(scene);
}

std::vector<std::string> StoredRun::warnings() const {
  return run_ ? run_->warnings() : std::vector<std::string>{};
}

Result StoredRun::execute(RunControl control, const std::function<void(const std::string&)>& not_saved) {
  make_result_folder(folder_);
  if (!checkpoint_) remove_checkpoint(folder_);
  control.resume = checkpoint_ ? &*checkpoint_ : nullptr;
  control.save = [&](const Checkpoint& checkpoint) {
    try {
      write_checkpoint(folder_, scene_, tier_.name(), files_, checkpoint);
    } catch (const OutputFailure& failure) {
      not_saved(failure.what());
    }
  };
  Result result = run_->execute(control);
  result.record.input_files = files_;
  for (std::string& remark : observables::beat_remarks(scene_, pressure_is_given_, result))
    result.record.findings.push_back(std::move(remark));
  return result;
}

void StoredRun::store(const Result& result) const {
  write_result(folder_, scene_, result);
  if (result.record.converged) remove_checkpoint(folder_);
}

}  // namespace tunica
