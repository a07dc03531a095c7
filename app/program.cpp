// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "app/program.hpp"

#include "app/commands/commands.hpp"
#include "app/launch.hpp"
#include "core/error.hpp"
#include "core/observables/build_info.hpp"

namespace {

int complain(const std::exception& error, int code) {
  if (tunica::is_first_process()) fmt::print(stderr, "tunica: {}\n", error.what());
  return code;
}

/// What was printed last waits in a buffer, and a full disk shows when it is written.
int after_output(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  const tunica::OutputFailure failure(
      fmt::format("the standard output cannot be written: {}", std::strerror(errno)));
  return complain(failure, code == tunica::done ? tunica::bad_input : code);
}

}  // namespace

int tunica::run_program(int argc, char** argv, const Program& program) {
  using namespace tunica;
  auto log = spdlog::stderr_color_mt("tunica");
  if (!is_first_process()) log->set_level(spdlog::level::off);
  log->set_pattern("tunica: %^%l%$: %v");
  spdlog::set_default_logger(std::move(log));

  CLI::App app{"Tunica: blood flow in elastic cerebral arteries"};
  app.set_version_flag("--version", fmt::format("tunica {}", program_version()));
  app.require_subcommand(1);

  RunArguments run;
  auto* run_app = app.add_subcommand("run", "Compute a scene");
  run_app->add_option("scene", run.scene, "Scene file (TOML)")->required()->type_name("SCENE");
  run_app
      ->add_option("--tier", run.tier,
                   "Model to compute with: auto (the cheapest that suits) or a tier's name")
      ->type_name("TIER");
  run_app->add_option("--set", run.overrides, "Override a key of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  run_app->add_option("--out", run.out, "Folder for the results (default: results/NAME)")->type_name("DIR");
  run_app->add_flag(
      "--resume", run.resume,
      "Go on with a run that was interrupted or killed, from its last checkpoint if it left one");
  run_app->add_flag("--quiet", run.quiet, "Print errors only");
  run_app->add_flag_callback(
      "--no-report", [&] { run.report = false; }, "Leave report.html out");

  VerifyArguments verify;
  auto* verify_app = app.add_subcommand("verify", "Compute a scene with several tiers and compare them");
  verify_app->add_option("scene", verify.scene, "Scene file (TOML)")->required()->type_name("SCENE");
  verify_app
      ->add_option(
          "--tiers", verify.tiers,
          "Tiers to compare, separated by commas (default: all that can compute the scene); the highest is "
          "the reference")
      ->type_name("A,B,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verify_app->add_option("--set", verify.overrides, "Override a key of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  verify_app->add_option("--out", verify.out, "Folder for the results (default: results/NAME-verify)")
      ->type_name("DIR");
  verify_app->add_flag("--quiet", verify.quiet, "Print errors only");

  SceneArguments scene;
  auto* scene_app = app.add_subcommand("scene", "Show a scene with every default, unit and meaning");
  scene_app->add_option("scene", scene.scene, "Scene file (TOML)")->type_name("SCENE");
  scene_app->add_option("--set", scene.overrides, "Override a key of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  scene_app->add_flag("--list", scene.list, "List the scenes that come with Tunica");
  scene_app->add_flag("--parameters", scene.parameters, "Print the manual of every key (Markdown)");

  ReportArguments report;
  auto* report_app = app.add_subcommand("report", "Make one HTML file of one or more results");
  report_app->add_option("folders", report.folders, "Folders of results")->required()->type_name("DIR...");
  report_app->add_option("--out", report.out, "File to write (default: report.html beside the results)")
      ->type_name("FILE");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return after_output(app.exit(success));
  } catch (const CLI::ParseError& error) {
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    const bool known =
        argc < 2 || std::any_of(commands.begin(), commands.end(),
                                [&](const CLI::App* command) { return command->get_name() == argv[1]; });
    if (!known && argv[1][0] != '-') {
      fmt::print(stderr,
                 "tunica: {} is not a command; there are: run, verify, scene, report (see tunica --help)\n",
                 argv[1]);
      return bad_input;
    }
    fmt::print(stderr, "tunica: {} (see tunica --help)\n", error.what());
    return bad_input;
  }

  try {
    if (*run_app) return after_output(run_command(run, program));
    if (*verify_app) return after_output(verify_command(verify, program));
    if (*scene_app) return after_output(scene_command(scene));
    return after_output(report_command(report));
  } catch (const InvalidInput& error) {
    return complain(error, bad_input);
  } catch (const OutputFailure& error) {
    return complain(error, bad_input);
  } catch (const SolverFailure& error) {
    return complain(error, gave_up);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return after_output(done);
    fmt::print(stderr, "tunica: internal error, please report it: {}\n", error.what());
    return gave_up;
  }
}
