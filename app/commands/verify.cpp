// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "app/commands/commands.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/report/report.hpp"
#include "app/result_folder.hpp"
#include "app/tell.hpp"
#include "core/error.hpp"
#include "core/observables/folder_lock.hpp"
#include "verification/cross_tier.hpp"

namespace tunica {

namespace fs = std::filesystem;

namespace {

/// Throws InvalidInput unless the names are those of tiers, each once.
void check_names(const TierList& tiers, const std::vector<std::string>& names) {
  std::vector<std::string_view> known;
  for (const auto& tier : tiers) known.push_back(tier->name());
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InvalidInput(
          fmt::format("--tiers {}: not a tier of this program, which has: {}", name, fmt::join(known, ", ")));
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InvalidInput(
          fmt::format("--tiers {}: {} is there twice; name each tier once", fmt::join(names, ","), name));
  }
}

/// The tiers of these names or, without any, all that can compute the scene; the cheapest first, whatever the
/// order. `refused` tells of the others.
std::vector<const Tier*> chosen(const TierList& tiers, const std::vector<std::string>& names,
                                const Scene& scene, std::vector<std::string>& refused) {
  check_names(tiers, names);
  std::vector<const Tier*> all;
  for (const auto& tier : tiers) {
    if (!names.empty() && std::find(names.begin(), names.end(), tier->name()) == names.end()) continue;
    const std::string reason = tier->refusal(scene);
    if (reason.empty())
      all.push_back(tier.get());
    else
      refused.push_back(fmt::format("tier {}: {}", tier->name(), reason));
  }
  if (!names.empty() && !refused.empty())
    throw InvalidInput(fmt::format("{}: {}", scene.name(), refused.front()));
  if (all.size() < 2)
    throw InvalidInput(
        fmt::format("{}: verify compares at least two tiers, and here is {}{}{}; tunica run takes one",
                    scene.name(), all.empty() ? "none" : fmt::format("only {}", all.front()->name()),
                    refused.empty() ? "" : "; ", fmt::join(refused, "; ")));
  return all;
}

/// What is left of an earlier verification does not stand beside the runs of this one.
void remove_earlier(const fs::path& folder) {
  std::error_code nothing_there;
  for (const char* file : {"verify.json", "report.html"}) fs::remove(folder / file, nothing_there);
}

}  // namespace

int verify_command(const VerifyArguments& arguments, const Program& program) {
  const run::Door door(program.tiers(), run::SceneSource(arguments.scene, arguments.overrides));
  const Scene& scene = door.source().scene();
  std::vector<std::string> refused;
  const auto compared = chosen(program.tiers(), arguments.tiers, scene, refused);
  program.before_computing(compared);
  std::vector<std::string> parts{"verify"};
  parts.insert(parts.end(), arguments.tiers.begin(), arguments.tiers.end());
  const fs::path folder = arguments.out.empty() ? result_folder(scene.name(), parts, arguments.overrides)
                                                : fs::path(arguments.out);
  if (!arguments.quiet)
    for (const auto& reason : refused) spdlog::warn("not compared: {}", reason);

  heed_interrupts(arguments.quiet);
  // Each run locks its own folder; what is written beside them is for one verification too.
  std::optional<FolderLock> lock;
  std::error_code unreadable;
  if (fs::is_directory(folder, unreadable)) lock.emplace(folder);
  verification::CrossTier found;
  {
    std::unique_ptr<ProgressDisplay> display;
    verification::VerifyControl control;
    control.replace = arguments.replace;
    // Of a scene that is refused nothing else is said.
    bool remarked = arguments.quiet;
    control.begin = [&](const std::string& label) {
      computation_begins();
      if (!lock) {
        make_result_folder(folder);
        lock.emplace(folder);
      }
      if (!std::exchange(remarked, true))
        for (const auto& remark : scene.remarks()) spdlog::warn(remark);
      remove_earlier(folder);
      display.reset();
      if (!arguments.quiet) spdlog::info("computing {}", label);
      display = std::make_unique<ProgressDisplay>(arguments.quiet);
    };
    control.report = [&](const Progress& progress) { display->show(progress); };
    control.interrupted = stop_asked;
    control.warn = [&](const std::string& line) {
      display = std::make_unique<ProgressDisplay>(arguments.quiet);
      if (!arguments.quiet) spdlog::warn(line);
    };
    found = verification::verify(door, compared, folder, control);
  }
  if (found.interrupted) {
    tell(fmt::format(
        "tunica: {}: interrupted; the runs so far are in {}, nothing was compared; the same command "
        "begins anew, tunica run with --resume completes one of them\n",
        scene.name(), folder.string()));
    return interrupted;
  }
  const auto results = found.tier_results();
  if (!results.empty()) write_whole(folder / "report.html", make_report(results, &found));
  write_whole(folder / "verify.json",
              to_json(found).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  if (!arguments.quiet)
    tell(fmt::format("{}{}: report.html, verify.json\n", to_text(found), folder.string()), stdout);
  if (const std::string failure = found.failure(); !failure.empty()) {
    tell(fmt::format("tunica: {}: {}; results up to there are in {}\n", scene.name(), failure,
                     folder.string()));
    return gave_up;
  }
  return done;
}

}  // namespace tunica
