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
#include "core/stored_run.hpp"

namespace tunica {

namespace fs = std::filesystem;

namespace {

constexpr const char* report_file = "report.html";

}  // namespace

int run_command(const RunArguments& arguments, const Program& program) {
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  const Tier& tier = run::choose_tier(program.tiers(), arguments.tier, scene);
  program.before_computing({&tier});
  std::vector<std::string> parts;
  if (arguments.tier != "auto") parts.push_back(arguments.tier);
  const fs::path folder = arguments.out.empty() ? result_folder(scene.name(), parts, arguments.overrides)
                                                : fs::path(arguments.out);
  heed_interrupts(arguments.quiet);
  // A scene that the tier refuses leaves nothing behind: the folder is made when the run is executed.
  StoredRun run(tier, scene, folder,
                arguments.resume    ? Earlier::resume
                : arguments.replace ? Earlier::replace
                                    : Earlier::keep_stopped);
  // Of a scene that is refused nothing else is said.
  if (!arguments.quiet)
    for (const auto& remark : scene.remarks()) spdlog::warn(remark);
  if (run.is_complete()) {
    if (!arguments.quiet) fmt::print("{}: this run is complete\n", folder.string());
    return done;
  }
  if (!arguments.quiet)
    for (const auto& warning : run.warnings()) spdlog::warn(warning);
  computation_begins();
  Result result;
  {
    ProgressDisplay display(arguments.quiet);
    RunControl control;
    control.report = [&](const Progress& progress) { display.show(progress); };
    control.interrupted = stop_asked;
    result = run.execute(control, [&](const std::string& failure) {
      if (!arguments.quiet) spdlog::warn("the run goes on, but cannot be resumed from here: {}", failure);
    });
  }
  // A report that was made of an earlier result must not stand beside this one.
  std::error_code no_report;
  fs::remove(folder / report_file, no_report);
  run.store(result, [&] {
    if (arguments.report && result.observables.rows() > 0)
      write_whole(folder / report_file, make_report({read_result(folder)}));
  });

  const RunRecord& record = result.record;
  if (!arguments.quiet)
    for (const auto& finding : record.findings) spdlog::warn(finding);
  if (!arguments.quiet)
    tell(fmt::format(
             "{}: tier {}, {} rows, {} steps, {} Newton iterations, set-up {:.1f} ms, solver {:.1f} ms\n",
             folder.string(), record.tier, result.observables.rows(), record.steps, record.newton_iterations,
             1e3 * record.setup_seconds, 1e3 * record.solve_seconds),
         stdout);
  if (!record.failure.empty()) {
    tell(fmt::format("tunica: {}: the solver gave up {}; results up to there are in {}\n", scene.name(),
                     record.failure, folder.string()));
    return gave_up;
  }
  if (record.interrupted) {
    tell(fmt::format("tunica: {}: interrupted; results so far are in {}, --resume {}\n", scene.name(),
                     folder.string(), has_checkpoint(folder) ? "completes them" : "begins again"));
    return interrupted;
  }
  return done;
}

}  // namespace tunica
