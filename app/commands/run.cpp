// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>

#include "app/commands/commands.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/report/report.hpp"
#include "app/result_folder.hpp"
#include "app/tell.hpp"
#include "core/error.hpp"
#include "core/observables/result.hpp"
#include "core/run/choose_tier.hpp"
#include "core/run/door.hpp"

namespace tunica {

namespace fs = std::filesystem;

namespace {

constexpr const char* report_file = "report.html";

}  // namespace

int run_command(const RunArguments& arguments, const Program& program) {
  const run::Door door(program.tiers(), run::SceneSource(arguments.scene, arguments.overrides));
  const Scene& scene = door.source().scene();
  const Tier& tier = run::choose_tier(program.tiers(), arguments.tier, scene);
  program.before_computing({&tier});
  std::vector<std::string> parts;
  if (arguments.tier != "auto") parts.push_back(arguments.tier);
  const fs::path folder = arguments.out.empty() ? result_folder(scene.name(), parts, arguments.overrides)
                                                : fs::path(arguments.out);
  heed_interrupts(arguments.quiet);
  run::Keep keep;
  keep.folder = folder;
  keep.earlier = arguments.resume    ? Earlier::resume
                 : arguments.replace ? Earlier::replace
                                     : Earlier::keep_stopped;
  keep.derived = {report_file};
  keep.beside = [&](const fs::path&, const Result& result) {
    if (arguments.report && result.observables.rows() > 0)
      write_whole(folder / report_file, make_report({read_result(folder)}));
  };
  // A scene that the tier refuses leaves nothing behind: the folder is made when the run is executed.
  const auto run = door.prepare(tier, {}, keep);
  // Of a scene that is refused nothing else is said.
  if (!arguments.quiet)
    for (const auto& remark : scene.remarks()) spdlog::warn(remark);
  if (run->is_complete()) {
    if (!arguments.quiet) fmt::print("{}: this run is complete\n", folder.string());
    return done;
  }
  if (!arguments.quiet)
    for (const auto& warning : run->warnings()) spdlog::warn(warning);
  computation_begins();
  run::Outcome outcome;
  {
    ProgressDisplay display(arguments.quiet);
    RunControl control;
    control.report = [&](const Progress& progress) { display.show(progress); };
    control.interrupted = stop_asked;
    outcome = run->execute(control, [&](const std::string& failure) {
      if (!arguments.quiet) spdlog::warn("the run goes on, but cannot be resumed from here: {}", failure);
    });
  }

  const auto& record = outcome.stored->record;
  if (!arguments.quiet)
    for (const std::string finding : record.at("findings")) spdlog::warn(finding);
  if (!arguments.quiet)
    tell(fmt::format(
             "{}: tier {}, {} rows, {} steps, {} Newton iterations, set-up {:.1f} ms, solver {:.1f} ms\n",
             folder.string(), outcome.tier, outcome.stored->result.observables.rows(),
             record.at("steps").get<long>(), record.at("newton_iterations").get<long>(),
             1e3 * record.at("seconds").at("setup").get<double>(),
             1e3 * record.at("seconds").at("solve").get<double>()),
         stdout);
  if (outcome.ending == run::Ending::gave_up) {
    tell(fmt::format("tunica: {}: the solver gave up {}; results up to there are in {}\n", scene.name(),
                     outcome.reason, folder.string()));
    return gave_up;
  }
  if (outcome.ending == run::Ending::interrupted) {
    tell(fmt::format("tunica: {}: interrupted; results so far are in {}, --resume {}\n", scene.name(),
                     folder.string(), has_checkpoint(folder) ? "completes them" : "begins again"));
    return interrupted;
  }
  return done;
}

}  // namespace tunica
