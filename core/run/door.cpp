// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/door.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdlib.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
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

/// What a process took is kept beside its result in the cache, as it cannot be measured again without work.
constexpr const char* cost_file = "cost.json";

void keep_cost(const fs::path& folder, const Cost& cost) {
  const nlohmann::ordered_json kept{
      {"wall_seconds", cost.wall_seconds}, {"cpu_seconds", cost.cpu_seconds}, {"mebibytes", cost.mebibytes}};
  write_whole(folder / cost_file, kept.dump() + "\n");
}

std::optional<Cost> kept_cost(const fs::path& folder) {
  std::ifstream stream(folder / cost_file);
  const auto kept = nlohmann::ordered_json::parse(stream, nullptr, false);
  try {
    return Cost{kept.at("wall_seconds"), kept.at("cpu_seconds"), kept.at("mebibytes")};
  } catch (const nlohmann::json::exception&) {
    return {};
  }
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

std::string sensitivity_override(const std::vector<std::string>& keys) {
  return fmt::format("sensitivity.parameters=[\"{}\"]", fmt::join(keys, "\", \""));
}

Door::Door(const TierList& tiers, SceneSource source, DoorOptions options)
    : tiers_(tiers), source_(std::move(source)), options_(std::move(options)) {}

/// A case that a tier of this program computes.
class Door::InProcess final : public Prepared {
 public:
  InProcess(Scene scene, const Tier& tier, Keep keep)
      : scene_(std::move(scene)), tier_(tier), keep_(std::move(keep)) {
    const auto began = Clock::now();
    if (keep_.folder.empty())
      run_ = tier_.prepare(scene_);
    else
      stored_.emplace(tier_, scene_, keep_.folder, keep_.earlier);
    setup_seconds_ = seconds_since(began);
  }

  const Scene& scene() const override { return scene_; }
  const Tier& tier() const override { return tier_; }
  bool is_complete() const override { return stored_ && stored_->is_complete(); }
  std::vector<std::string> warnings() const override {
    return stored_ ? stored_->warnings() : run_->warnings();
  }

  Outcome execute(const RunControl& control,
                  const std::function<void(const std::string&)>& not_saved) override {
    const auto began = Clock::now();
    Outcome outcome;
    outcome.tier = tier_.name();
    if (!stored_) {
      outcome.stored.emplace();
      outcome.stored->result = run_->execute(control);
      outcome.stored->record = make_record(scene_, outcome.stored->result.record);
      take_ending(outcome.stored->result.record, outcome);
    } else {
      if (!is_complete()) {
        const Result result = stored_->execute(control, not_saved);
        std::error_code not_there;
        for (const std::string& file : keep_.derived) fs::remove(keep_.folder / file, not_there);
        stored_->store(result, [&] { keep_.beside(keep_.folder, result); });
        take_ending(result.record, outcome);
      }
      outcome.stored = read_result(keep_.folder);
    }
    outcome.time = last_time(outcome.stored->result.observables);
    outcome.cost.wall_seconds = setup_seconds_ + seconds_since(began);
    return outcome;
  }

 private:
  Scene scene_;
  const Tier& tier_;
  Keep keep_;
  double setup_seconds_ = 0;
  std::unique_ptr<TierRun> run_;     ///< where nothing is kept
  std::optional<StoredRun> stored_;  ///< else
};

/// A case that a process of its own computes.
class Door::ByProcess final : public Prepared {
 public:
  ByProcess(const Door& door, Scene scene, const Tier& tier, std::vector<std::string> overrides, Keep keep,
            bool is_cached)
      : door_(door),
        scene_(std::move(scene)),
        tier_(tier),
        overrides_(std::move(overrides)),
        keep_(std::move(keep)),
        is_cached_(is_cached) {
    if (keep_.folder.empty()) keep_.folder = passing_.emplace().path();
    if (is_cached_) cost_ = kept_cost(keep_.folder);
  }

  const Scene& scene() const override { return scene_; }
  const Tier& tier() const override { return tier_; }
  // Elsewhere than in the cache the process finds out.
  bool is_complete() const override { return cost_.has_value(); }
  std::vector<std::string> warnings() const override { return {}; }

  Outcome execute(const RunControl& control, const std::function<void(const std::string&)>&) override {
    Outcome outcome;
    outcome.tier = tier_.name();
    if (cost_) {
      outcome.stored = read_result(keep_.folder);
      outcome.time = last_time(outcome.stored->result.observables);
      outcome.cost = *cost_;
      return outcome;
    }
    const EndedProcess process = run_process(arguments(), control.interrupted);
    outcome.cost = {process.wall_seconds, process.cpu_seconds, process.mebibytes};
    try {
      outcome.stored = read_result(keep_.folder);
      outcome.time = last_time(outcome.stored->result.observables);
    } catch (const InvalidInput& error) {
      // One that was refused leaves none.
      if (process.exit_code == 0)
        throw OutputFailure(fmt::format("{}: the result of {} is not whole: {}", keep_.folder.string(),
                                        scene_.name(), error.what()));
    }
    take_ending(process, outcome.stored, outcome);
    if (is_cached_ && outcome.ending == Ending::done) keep_cost(keep_.folder, outcome.cost);
    if (!passing_ && outcome.stored) keep_.beside(keep_.folder, outcome.stored->result);
    return outcome;
  }

 private:
  std::vector<std::string> arguments() const {
    std::vector<std::string> all;
    if (door_.options_.ranks > 1 && !tier_.computes())
      all = {"mpirun", "-n", std::to_string(door_.options_.ranks)};
    for (const std::string& argument :
         {door_.options_.program.string(), std::string("run"), door_.source_.file().string(),
          std::string("--tier"), std::string(tier_.name()), std::string("--out"), keep_.folder.string(),
          std::string("--quiet"), std::string("--no-report")})
      all.push_back(argument);
    if (keep_.earlier == Earlier::resume) all.emplace_back("--resume");
    if (keep_.earlier == Earlier::replace) all.emplace_back("--replace");
    for (const auto* overrides : {&door_.source_.overrides(), &overrides_})
      for (const std::string& override : *overrides) {
        all.emplace_back("--set");
        all.push_back(override);
      }
    return all;
  }

  const Door& door_;
  Scene scene_;
  const Tier& tier_;
  std::vector<std::string> overrides_;
  Keep keep_;
  bool is_cached_;
  std::optional<Cost> cost_;                ///< of a whole result in the cache
  std::optional<TemporaryFolder> passing_;  ///< where nothing is kept
};

std::unique_ptr<Prepared> Door::prepare(Scene scene, const Tier& tier,
                                        const std::vector<std::string>& overrides, Keep keep) const {
  const bool is_cached = keep.folder.empty() && !options_.cache.empty();
  if (is_cached) keep.folder = cached(scene, tier);
  if (needs_process(tier))
    return std::make_unique<ByProcess>(*this, std::move(scene), tier, overrides, std::move(keep), is_cached);
  return std::make_unique<InProcess>(std::move(scene), tier, std::move(keep));
}

std::unique_ptr<Prepared> Door::prepare(const Case& what, const Keep& keep) const {
  Scene scene = source_.with(what.overrides);
  const Tier& tier = choose_tier(tiers_, what.tier, scene);
  return prepare(std::move(scene), tier, what.overrides, keep);
}

std::unique_ptr<Prepared> Door::prepare(const Tier& tier, const std::vector<std::string>& overrides,
                                        const Keep& keep) const {
  return prepare(source_.with(overrides), tier, overrides, keep);
}

Outcome Door::compute(const Case& what, const Keep& keep, const RunControl& control) const {
  Outcome outcome;
  guarded(outcome, [&] { outcome = prepare(what, keep)->execute(control); });
  return outcome;
}

Outcome Door::ask(const Case& what, const Question& question, const RunControl& control) const {
  const auto began = Clock::now();
  Outcome outcome;
  guarded(outcome, [&] {
    Case asked = what;
    if (!question.keys.empty()) asked.overrides.push_back(sensitivity_override(question.keys));
    const Scene scene = source_.with(asked.overrides);
    const Tier& tier = choose_tier(tiers_, what.tier, scene);
    outcome.tier = tier.name();
    if (needs_process(tier)) {
      outcome = prepare(scene, tier, asked.overrides, {})->execute(control);
      if (outcome.ending == Ending::done) outcome.answer = answer_of(*outcome.stored, question);
      outcome.stored.reset();
    } else if (auto answer = tier.answer(scene, question, control)) {
      outcome.answer = std::move(*answer);
      outcome.time = scene.text("time.mode") == "static"
                         ? 0
                         : static_cast<double>(scene.integer("time.beats")) * scene.number("inlet.period");
    } else {
      const Result result = tier.prepare(scene)->execute(control);
      outcome.time = last_time(result.observables);
      take_ending(result.record, outcome);
      if (outcome.ending == Ending::done)
        outcome.answer = answer_of(result, observables::last_beat(scene, result.observables), question);
    }
  });
  if (observables::is_none(outcome.cost.cpu_seconds)) outcome.cost.wall_seconds = seconds_since(began);
  return outcome;
}

fs::path Door::cached(const Scene& scene, const Tier& tier) const {
  const std::string decides = fmt::format("{}\n{}\n{}\n{} {}", describe(scene), tier.name(),
                                          input_files(scene).dump(), program_version(), program_commit());
  return options_.cache / fmt::format("{}-{}-{:016x}", scene.name(), tier.name(), checksum(decides));
}

}  // namespace tunica::run
