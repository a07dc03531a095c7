// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stored_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <new>

#include "core/error.hpp"
#include "core/inlet.hpp"
#include "core/memory.hpp"
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
  if (!fs::exists(folder / record_file)) return false;
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

StoredRun::StoredRun(const Tier& tier, const Scene& scene, fs::path folder, Earlier earlier)
    : tier_(tier),
      scene_(scene),
      folder_(std::move(folder)),
      files_(input_files(scene)),
      pressure_is_given_(inlet_from_scene(scene).is_pressure) {
  std::error_code unreadable;
  if (fs::is_directory(folder_, unreadable)) {
    try {
      // Processes whose mpirun has been killed end a second after it: who resumes at once is not refused.
      lock_.emplace(folder_, std::chrono::seconds(earlier == Earlier::resume ? 4 : 0));
    } catch (const OutputFailure&) {
      // What is complete can be told where nothing can be written.
      if (earlier != Earlier::resume) throw;
    }
    look(earlier);
    if (is_complete_) return;
  }
  try {
    run_ = tier.prepare(scene);
  } catch (const SolverFailure& failure) {
    failure_ = failure.what();
  } catch (const std::bad_alloc& error) {
    throw InvalidInput(fmt::format("{}: {}", scene.name(), memory_ran_out(error)));
  }
}

void StoredRun::look(Earlier earlier) {
  if (earlier == Earlier::resume) {
    is_complete_ = holds_whole_result(folder_, scene_, files_, tier_);
    if (!is_complete_ && has_checkpoint(folder_))
      checkpoint_ = read_checkpoint(folder_, scene_, tier_.name());
    return;
  }
  if (const std::string other = other_checkpoint(folder_, scene_, tier_.name()); !other.empty()) {
    if (earlier != Earlier::replace)
      throw InvalidInput(
          fmt::format("{}: holds a run that was stopped and can be resumed, {}; name another folder with "
                      "--out, or write --replace to discard it",
                      folder_.string(), other));
  } else if (has_checkpoint(folder_)) {
    replaces_.push_back(
        fmt::format("{}: the run begins anew, --resume would have gone on from where it was "
                    "stopped",
                    folder_.string()));
  }
  try {
    const std::string of_tier = observables::record_text(read_record(folder_), "tier");
    if (!of_tier.empty() && of_tier != tier_.name())
      replaces_.push_back(
          fmt::format("{}: the result of tier {} that lies here is replaced", folder_.string(), of_tier));
  } catch (const InvalidInput&) {
    // No result, or none that anybody could miss.
  }
}

std::vector<std::string> StoredRun::warnings() const {
  std::vector<std::string> all = replaces_;
  if (!run_) return all;
  const auto of_run = run_->warnings();
  all.insert(all.end(), of_run.begin(), of_run.end());
  return all;
}

void StoredRun::lock_anew() {
  lock_.emplace(folder_);
  if (has_checkpoint(folder_) || fs::exists(folder_ / record_file))
    throw InvalidInput(
        fmt::format("{}: another run has put its result here since this one began; name another folder with "
                    "--out, or begin again",
                    folder_.string()));
}

Result StoredRun::failed_result(std::string failure) const {
  Result result;
  result.observables = observables::standard_table();
  result.record.tier = tier_.name();
  result.record.resolution = nlohmann::ordered_json::object();
  result.record.remarks = scene_.remarks();
  result.record.failure = std::move(failure);
  return result;
}

Result StoredRun::execute(RunControl control, const std::function<void(const std::string&)>& not_saved) {
  make_result_folder(folder_);
  if (!lock_) lock_anew();
  if (!checkpoint_) remove_checkpoint(folder_);
  control.resume = checkpoint_ ? &*checkpoint_ : nullptr;
  control.save = [&](const Checkpoint& checkpoint) {
    try {
      write_checkpoint(folder_, scene_, tier_.name(), files_, checkpoint);
    } catch (const OutputFailure& failure) {
      not_saved(failure.what());
    }
  };
  Result result;
  try {
    result = run_ ? run_->execute(control) : failed_result("in the set-up: " + failure_);
  } catch (const SolverFailure& failure) {
    // Of a run that could not even tell what it has: an older record would be taken for its own.
    result = failed_result(failure.what());
  }
  result.record.input_files = files_;
  for (std::string& remark : observables::beat_remarks(scene_, pressure_is_given_, result))
    result.record.findings.push_back(std::move(remark));
  return result;
}

void StoredRun::store(const Result& result, const std::function<void()>& beside) {
  write_result(folder_, scene_, result);
  if (result.record.converged) remove_checkpoint(folder_);
  beside();
  lock_.reset();
}

}  // namespace tunica
