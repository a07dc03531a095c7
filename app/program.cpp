// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>

#include "app/program.hpp"

#include "app/commands/commands.hpp"
#include "app/tell.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/observables/build_info.hpp"

namespace {

constexpr const char* about = R"(Tunica: blood flow in elastic cerebral arteries

Tiers, the cheapest first; without --tier the first one that suits the scene is taken:
  lumped   0D: a nonlinear Windkessel; milliseconds
  axisym   2D: axisymmetric blood and wall in the (r, z) plane; seconds
  full3d   3D: blood and wall in cylinders, bends and meshes of your own; minutes, faster by mpirun)";

constexpr const char* examples = R"(Examples:
  tunica scene --list
  tunica run scenes/cylinder.toml
  tunica run scenes/cylinder.toml --tier axisym --set wall.law=EXP1 --out results/mine
  mpirun -n 2 tunica run scenes/torus.toml
  tunica verify scenes/cylinder.toml
  tunica report results/mine results/other --out both.html

Exit codes:
  0    done
  2    the input, the folder or the machine does not allow it; one line says what to change
  3    the solver gave up; what it has is kept, and record.json says where and why
  130  interrupted: what there is is kept, --resume goes on)";

constexpr const char* run_examples =
    R"(Tiers: lumped (0D, milliseconds), axisym (2D, seconds), full3d (3D, minutes).

Examples:
  tunica run scenes/cylinder.toml
  tunica run scenes/cylinder.toml --tier axisym --set accuracy.tolerance=0.1% --out results/fine
  tunica run scenes/torus.toml --resume
  mpirun -n 2 tunica run scenes/torus.toml

Exit codes: 0 done, 2 bad input (nothing was computed), 3 the solver gave up (results so far are kept),
130 interrupted (likewise).)";

int complain(const tunica::Program& program, const std::string& what, int code) {
  if (program.speaks()) tunica::tell(fmt::format("tunica: {}\n", what));
  return code;
}

/// What was printed last waits in a buffer, and a full disk shows when it is written.
int after_output(const tunica::Program& program, int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  return complain(program, fmt::format("the standard output cannot be written: {}", std::strerror(errno)),
                  code == tunica::done ? tunica::bad_input : code);
}

}  // namespace

int tunica::run_program(int argc, char** argv, const Program& program) {
  using namespace tunica;
  auto log = spdlog::stderr_color_mt("tunica");
  if (!program.speaks()) log->set_level(spdlog::level::off);
  log->set_pattern("tunica: %^%l%$: %v");
  spdlog::set_default_logger(std::move(log));

  CLI::App app{about};
  app.footer(examples);
  app.set_version_flag("--version", fmt::format("tunica {}", program_version()));
  app.require_subcommand(1);

  RunArguments run;
  auto* run_app = app.add_subcommand("run", "Compute a scene");
  run_app->footer(run_examples);
  run_app->add_option("scene", run.scene, "Scene file (TOML)")->required()->type_name("SCENE");
  run_app
      ->add_option("--tier", run.tier,
                   "Model to compute with: auto (the cheapest that suits), lumped, axisym or full3d")
      ->type_name("TIER");
  run_app->add_option("--set", run.overrides, "Override a key of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  run_app
      ->add_option("--out", run.out,
                   "Folder for the results (default: results/NAME, with --tier and --set behind it)")
      ->type_name("DIR");
  auto* resume_flag = run_app->add_flag(
      "--resume", run.resume,
      "Go on with a run that was interrupted or killed, from its last checkpoint if it left one");
  run_app
      ->add_flag("--replace", run.replace,
                 "Begin anew also where that discards the stopped run of another scene or tier")
      ->excludes(resume_flag);
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
  verify_app
      ->add_option("--out", verify.out,
                   "Folder for the results (default: results/NAME-verify, with --tiers and --set behind it)")
      ->type_name("DIR");
  verify_app->add_flag("--replace", verify.replace,
                       "Begin anew also where that discards stopped runs of another scene");
  verify_app->add_flag("--quiet", verify.quiet, "Print errors only");

  SweepArguments sweep;
  auto* sweep_app = add_sweep_command(app, sweep);

  CalibrateArguments calibrate;
  auto* calibrate_app = add_calibrate_command(app, calibrate);

  ServeArguments serve;
  auto* serve_app = add_serve_command(app, serve);

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
  add_report_command(app, report);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return after_output(program, app.exit(success));
  } catch (const CLI::ParseError& error) {
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    const bool known =
        argc < 2 || std::any_of(commands.begin(), commands.end(),
                                [&](const CLI::App* command) { return command->get_name() == argv[1]; });
    if (!known && argv[1][0] != '-') {
      return complain(
          program,
          fmt::format(
              "{} is not a command; there are: run, verify, sweep, calibrate, serve, scene, report (see "
              "tunica --help)",
              argv[1]),
          bad_input);
    }
    return complain(program, fmt::format("{} (see tunica --help)", error.what()), bad_input);
  }

  try {
    if (*run_app) return after_output(program, run_command(run, program));
    if (*verify_app) return after_output(program, verify_command(verify, program));
    if (*sweep_app) return after_output(program, sweep_command(sweep, program));
    if (*calibrate_app) return after_output(program, calibrate_command(calibrate, program));
    if (*serve_app) return after_output(program, serve_command(serve, program));
    if (*scene_app) return after_output(program, scene_command(scene));
    return after_output(program, report_command(report, program));
  } catch (const InvalidInput& error) {
    return complain(program, error.what(), bad_input);
  } catch (const OutputFailure& error) {
    return complain(program, error.what(), bad_input);
  } catch (const SolverFailure& error) {
    return complain(program, error.what(), gave_up);
  } catch (const std::bad_alloc& error) {
    return complain(program, memory_ran_out(error), bad_input);
  } catch (const std::system_error& error) {
    if (std::ferror(stdout) != 0) return after_output(program, done);
    return complain(program, fmt::format("the system refuses what a run needs: {}", error.what()), bad_input);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return after_output(program, done);
    tell(fmt::format("tunica: internal error, please report it: {}\n", error.what()));
    return gave_up;
  }
}
