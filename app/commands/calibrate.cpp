// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "app/commands/commands.hpp"
#include "app/commands/option_checks.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/report/calibration.hpp"
#include "app/result_folder.hpp"
#include "app/tell.hpp"
#include "core/error.hpp"
#include "core/observables/folder_lock.hpp"
#include "core/observables/result.hpp"
#include "core/run/choose_tier.hpp"
#include "core/scene/message.hpp"
#include "core/threads.hpp"
#include "verification/calibration/result.hpp"

namespace tunica {

namespace fs = std::filesystem;
namespace calibration = verification::calibration;

namespace {

constexpr const char* calibrate_examples =
    R"TEXT(Examples:
  tunica calibrate scenes/cylinder.toml --free outlet.resistance=5e5:2e6 --free tether.stiffness=1e6:1e8
      --target "pressure.max=130 mmHg" --target "pressure.min=75 mmHg"
      --target "radial_displacement.P1.change=25 % of geometry.radius +- 2 %"
  tunica calibrate mine.toml --tier axisym --free outlet.resistance=5e5:2e6 --target "pressure.mean=93 mmHg"

DIR has scene.toml (runs and gives the answer), calibration.csv, targets.csv, calibration.json, report.html.

Exit codes: 0 done (also where targets conflict: the best compromise is kept, and what it misses is said),
2 bad input (nothing was computed), 3 the search has not come to an end (what it has is kept), 130 interrupted
(likewise).)TEXT";

calibration::Task task_of(const CalibrateArguments& arguments, const run::SceneSource& source,
                          const Tier& tier) {
  calibration::Task task;
  task.tier = tier.name();
  for (const std::string& text : arguments.free) task.free.push_back(calibration::parse_free(text, source));
  for (const std::string& text : arguments.targets)
    task.targets.push_back(calibration::parse_target(text, source.scene(), task.free));
  task.starts = arguments.starts;
  task.seed = arguments.seed;
  // A process computes with all the cores that it is given.
  task.jobs = arguments.jobs > 0 ? arguments.jobs : tier.computes() ? available_threads() : 1;
  return task;
}

void write_results(const fs::path& folder, const run::SceneSource& source, const calibration::Task& task,
                   const calibration::Calibration& found) {
  const auto json = calibration::to_json(task, found, source.scene());
  if (found.has_answer())
    write_whole(folder / "scene.toml", calibration::calibrated_scene(source, task, found));
  write_whole(folder / "calibration.csv", calibration::parameters_csv(task, found));
  write_whole(folder / "targets.csv", calibration::targets_csv(task, found));
  write_whole(folder / "report.html", make_calibration_report(source.scene().name(), task, found));
  write_whole(folder / "calibration.json", json.dump(2) + "\n");
}

void tell_answer(const calibration::Task& task, const calibration::Calibration& found) {
  for (std::size_t k = 0; k < task.free.size(); ++k) {
    const double deviation = found.free[k].standard_deviation;
    tell(fmt::format("{} = {:.6g}{} {}\n", task.free[k].key, found.free[k].value,
                     observables::is_none(deviation) ? "" : fmt::format(" +- {:.2g}", deviation),
                     task.free[k].unit == "1" ? "" : task.free[k].unit),
         stdout);
  }
  for (std::size_t i = 0; i < task.targets.size(); ++i) {
    const calibration::Target& target = task.targets[i];
    const std::string unit = target.quantity.unit();
    tell(fmt::format("{}: {} of {}\n", target.quantity.name(), scene::with_unit(found.reached[i], ""),
                     scene::with_unit(target.value, unit)),
         stdout);
  }
}

}  // namespace

CLI::App* add_calibrate_command(CLI::App& app, CalibrateArguments& arguments) {
  auto* command = app.add_subcommand("calibrate", "Find values of keys with which a scene meets targets");
  command->footer(calibrate_examples);
  command->add_option("scene", arguments.scene, "Scene file (TOML)")->required()->type_name("SCENE");
  const auto repeated = [&](const char* name, std::vector<std::string>& texts, const char* text,
                            const char* type) {
    return command->add_option(name, texts, text)->type_name(type)->take_all()->allow_extra_args(false);
  };
  repeated("--free", arguments.free, "A key to find, and its bounds; may be repeated", "KEY=LO:HI")
      ->required();
  repeated("--target", arguments.targets,
           "What a quantity of the last beat is to be, if known with its standard deviation (else 1 % of "
           "it): "
           "\"130 mmHg\", \"130+-5 mmHg\", \"25 % of geometry.radius\"; may be repeated",
           "QUANTITY=VALUE[+-SD]")
      ->required();
  command->add_option("--tier", arguments.tier, "Model to compute with: auto, lumped, axisym or full3d")
      ->type_name("TIER");
  command
      ->add_option("--starts", arguments.starts,
                   "Searches, from the scene's values and from places drawn (default 5)")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
  command->add_option("--seed", arguments.seed, "Of the places drawn (default 0)")
      ->check(check_seed)
      ->type_name("S");
  command->add_option("--jobs", arguments.jobs, "Searches side by side (default: all cores)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  repeated("--set", arguments.overrides, "Override a key of the scene; may be repeated", "KEY=VALUE");
  command->add_option("--out", arguments.out, "Folder for the results (default: results/NAME-calibrate)")
      ->type_name("DIR");
  command->add_flag("--quiet", arguments.quiet, "Print errors only");
  return command;
}

int calibrate_command(const CalibrateArguments& arguments, const Program& program) {
  run::DoorOptions options;
  options.program = fs::read_symlink("/proc/self/exe").parent_path() / "tunica";
  const run::Door door(program.tiers(), run::SceneSource(arguments.scene, arguments.overrides), options);
  const run::SceneSource& source = door.source();
  const Tier& tier = run::choose_tier(program.tiers(), arguments.tier, source.scene());
  const calibration::Task task = task_of(arguments, source, tier);
  calibration::check(task);
  std::vector<std::string> parts{"calibrate"};
  if (arguments.tier != "auto") parts.push_back(arguments.tier);
  const fs::path folder = arguments.out.empty()
                              ? result_folder(source.scene().name(), parts, arguments.overrides)
                              : fs::path(arguments.out);
  heed_interrupts(arguments.quiet);
  make_result_folder(folder);
  const FolderLock lock(folder);
  if (!arguments.quiet)
    for (const auto& remark : source.scene().remarks()) spdlog::warn(remark);

  computation_begins();
  calibration::Calibration found;
  {
    ProgressLine line(arguments.quiet);
    calibration::Watch watch;
    watch.interrupted = stop_asked;
    watch.report = [&](long runs, double misfit) {
      if (line.is_due()) line.show(fmt::format("{} runs, least misfit {:.4g}", runs, misfit));
    };
    found = calibration::calibrate(door, task, watch);
  }
  write_results(folder, source, task, found);
  const std::string where = folder.string();
  if (!found.has_answer()) {
    if (found.interrupted) {
      tell(fmt::format("tunica: {}: interrupted before there was an answer\n", source.scene().name()));
      return interrupted;
    }
    tell(fmt::format("tunica: {}: no start has a result: {}\n", source.scene().name(), found.reason));
    return gave_up;
  }
  if (!arguments.quiet) {
    tell_answer(task, found);
    tell(fmt::format("{}: {} runs, {} of {} starts agree\n", where, found.runs, found.agreeing(),
                     found.starts.size()),
         stdout);
  }
  for (const std::string& finding : calibration::findings(task, found))
    if (!arguments.quiet) spdlog::warn(finding);
  if (found.interrupted) {
    tell(fmt::format("tunica: {}: interrupted; the best so far is in {}: calibrate {} goes on from it\n",
                     source.scene().name(), where, (folder / "scene.toml").string()));
    return interrupted;
  }
  if (!found.converged) {
    tell(fmt::format("tunica: {}: the search has not converged: {}; the best so far is in {}\n",
                     source.scene().name(), found.reason, where));
    return gave_up;
  }
  return done;
}

}  // namespace tunica
