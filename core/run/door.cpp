// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/door.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdlib.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/observables/build_info.hpp"
#include "core/observables/inputs.hpp"
#include "core/observables/record.hpp"
#include "core/run/choose_tier.hpp"
#include "core/run/process.hpp"

namespace tunica::run {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A folder that is gone with this.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "tunica-XXXXXX").string();
    if (!::mkdtemp(name.data()))
      throw OutputFailure(fmt::format("{}: cannot be made: {}", name, std::strerror(errno)));
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code stays;
    fs::remove_all(path_, stays);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

double last_time(const observables::Table& table) {
  const auto* time = table.find("time");
  return time && !time->values.empty() ? time->values.back() : observables::none;
}

/// How a result that was computed here has ended.
void take_ending(const RunRecord& record, Outcome& outcome) {
  if (!record.failure.empty()) {
    outcome.ending = Ending::gave_up;
    outcome.reason = record.failure;
  } else if (record.interrupted) {
    outcome.ending = Ending::interrupted;
    outcome.reason = "interrupted";
  }
}

/// The same by a process, with what it left behind.
void take_ending(const EndedProcess& process, const std::optional<StoredResult>& stored, Outcome& outcome) {
  constexpr int bad_input = 2, gave_up = 3, interrupted = 130;
  const std::string failure = stored ? observables::record_text(stored->record, "failure") : "";
  std::string complaint = process.complaint;
  if (complaint.starts_with("tunica: ")) complaint.erase(0, 8);
  switch (process.exit_code) {
    case 0:
      return;
    case bad_input:
      outcome.ending = Ending::refused;
      outcome.reason = complaint;
      return;
    case interrupted:
      outcome.ending = Ending::interrupted;
      outcome.reason = "interrupted";
      return;
    case gave_up:
      outcome.ending = Ending::gave_up;
      outcome.reason = failure.empty() ? complaint : failure;
      return;
    default:
      outcome.ending = Ending::gave_up;
      outcome.reason = process.signal != 0
                           ? fmt::format("its process was ended by signal {}", process.signal)
                           : fmt::format("its process ended with code {}: {}", process.exit_code, complaint);
  }
}

/// Runs what computes, and makes an outcome of what it throws.
template <class Computation>
void guarded(Outcome& outcome, const Computation& computation) {
  const auto end = [&](Ending ending, std::string reason) {
    outcome.ending = ending;
    outcome.reason = std::move(reason);
  };
  try {
    computation();
  } catch (const InvalidInput& error) {
    end(Ending::refused, error.what());
  } catch (const SolverFailure& failure) {
    end(Ending::gave_up, failure.what());
    outcome.time = failure.time();
  } catch (const std::bad_alloc& error) {
    end(Ending::gave_up, memory_ran_out(error));
  } catch (const Interrupted&) {
    end(Ending::interrupted, "interrupted");
  }
}

}  // namespace

const char* name_of(Ending ending) {
  switch (ending) {
    case Ending::done:
      return "done";
    case Ending::gave_up:
      return "gave-up";
    case Ending::refused:
      return "refused";
    default:
      return "interrupted";
  }
}

Door::Door(const TierList& tiers, SceneSource source, DoorOptions options)
    : tiers_(tiers), source_(std::move(source)), options_(std::move(options)) {}

Outcome Door::ask(const Case& what, const Question& question, const RunControl& control) const {
  const auto began = Clock::now();
  Outcome outcome;
  guarded(outcome, [&] {
    Case asked = what;
    if (!question.keys.empty())
      asked.overrides.push_back(
          fmt::format("sensitivity.parameters=[\"{}\"]", fmt::join(question.keys, "\", \"")));
    const Scene scene = source_.with(asked.overrides);
    const Tier& tier = choose_tier(tiers_, what.tier, scene);
    outcome.tier = tier.name();
    if (needs_process(tier)) {
      const TemporaryFolder folder;
      outcome = by_process(asked, scene, tier, {folder.path()}, control);
      if (outcome.ending == Ending::done) outcome.answer = answer_of(*outcome.stored, question);
      outcome.stored.reset();
      return;
    }
    if (auto answer = tier.answer(scene, question, control)) {
      outcome.answer = std::move(*answer);
      outcome.time = scene.text("time.mode") == "static"
                         ? 0
                         : static_cast<double>(scene.integer("time.beats")) * scene.number("inlet.period");
      return;
    }
    const Result result = tier.prepare(scene)->execute(control);
    outcome.time = last_time(result.observables);
    take_ending(result.record, outcome);
    if (outcome.ending == Ending::done)
      outcome.answer = answer_of(result, observables::last_beat(scene, result.observables), question);
  });
  if (observables::is_none(outcome.cost.cpu_seconds)) outcome.cost.wall_seconds = seconds_since(began);
  return outcome;
}

Outcome Door::compute(const Case& what, const Keep& keep, const Watch& watch) const {
  const auto began = Clock::now();
  Outcome outcome;
  guarded(outcome, [&] {
    const Scene scene = source_.with(what.overrides);
    const Tier& tier = choose_tier(tiers_, what.tier, scene);
    outcome.tier = tier.name();
    Keep kept = keep;
    if (kept.folder.empty() && !options_.cache.empty()) kept.folder = cached(scene, tier);
    if (needs_process(tier)) {
      std::optional<TemporaryFolder> passing;
      if (kept.folder.empty()) kept.folder = passing.emplace().path();
      watch.begin(scene, {});
      outcome = by_process(what, scene, tier, kept, watch);
      if (!passing) kept.beside(kept.folder);
      return;
    }
    if (kept.folder.empty()) {
      const auto run = tier.prepare(scene);
      watch.begin(scene, run->warnings());
      outcome.stored.emplace();
      outcome.stored->result = run->execute(watch);
      outcome.stored->record = make_record(scene, outcome.stored->result.record);
      take_ending(outcome.stored->result.record, outcome);
    } else {
      StoredRun run(tier, scene, kept.folder, kept.earlier);
      if (!run.is_complete()) {
        watch.begin(scene, run.warnings());
        const Result result = run.execute(watch, watch.not_saved);
        run.store(result, [&] { kept.beside(kept.folder); });
        take_ending(result.record, outcome);
      }
      outcome.stored = read_result(kept.folder);
    }
    outcome.time = last_time(outcome.stored->result.observables);
  });
  if (observables::is_none(outcome.cost.cpu_seconds)) outcome.cost.wall_seconds = seconds_since(began);
  return outcome;
}

Outcome Door::by_process(const Case& what, const Scene& scene, const Tier& tier, const Keep& keep,
                         const RunControl& control) const {
  std::vector<std::string> arguments;
  if (options_.ranks > 1 && !tier.computes()) arguments = {"mpirun", "-n", std::to_string(options_.ranks)};
  for (const std::string& argument :
       {options_.program.string(), std::string("run"), source_.file().string(), std::string("--tier"),
        std::string(tier.name()), std::string("--out"), keep.folder.string(), std::string("--quiet"),
        std::string("--no-report")})
    arguments.push_back(argument);
  if (keep.earlier == Earlier::resume) arguments.emplace_back("--resume");
  if (keep.earlier == Earlier::replace) arguments.emplace_back("--replace");
  for (const auto* overrides : {&source_.overrides(), &what.overrides})
    for (const std::string& override : *overrides) {
      arguments.emplace_back("--set");
      arguments.push_back(override);
    }
  const EndedProcess process = run_process(arguments, control.interrupted);
  Outcome outcome;
  outcome.tier = tier.name();
  outcome.cost = {process.wall_seconds, process.cpu_seconds, process.mebibytes};
  try {
    outcome.stored = read_result(keep.folder);
    outcome.time = last_time(outcome.stored->result.observables);
  } catch (const InvalidInput& error) {
    // One that was refused leaves none.
    if (process.exit_code == 0)
      throw OutputFailure(fmt::format("{}: the result of {} is not whole: {}", keep.folder.string(),
                                      scene.name(), error.what()));
  }
  take_ending(process, outcome.stored, outcome);
  return outcome;
}

fs::path Door::cached(const Scene& scene, const Tier& tier) const {
  const std::string decides = fmt::format("{}\n{}\n{}\n{} {}", describe(scene), tier.name(),
                                          input_files(scene).dump(), program_version(), program_commit());
  return options_.cache / fmt::format("{}-{}-{:016x}", scene.name(), tier.name(), checksum(decides));
}

}  // namespace tunica::run
