// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <string_view>

#include "app/commands/commands.hpp"
#include "app/progress.hpp"
#include "app/report/report.hpp"
#include "app/tiers.hpp"
#include "core/error.hpp"
#include "core/observables/result.hpp"
#include "core/stored_run.hpp"

namespace tunica {

namespace fs = std::filesystem;

namespace {

constexpr const char* report_file = "report.html";

std::atomic<bool> stop_asked = false;
std::atomic<bool> setting_up = true;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

/// A run that computes keeps what it has; before that there is nothing to keep.
void ask_to_stop(int) {
  stop_asked = true;
  if (!setting_up) return;
  constexpr std::string_view message = "tunica: interrupted before anything was computed\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message.data(), message.size());
  ::_exit(interrupted);
}

}  // namespace

int run_command(const RunArguments& arguments) {
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  const TierList tiers = available_tiers();
  const Tier& tier = choose_tier(tiers, arguments.tier, scene);
  const fs::path folder =
      arguments.out.empty() ? fs::path("results") / scene.name() : fs::path(arguments.out);
  if (!arguments.quiet)
    for (const auto& remark : scene.remarks()) spdlog::warn(remark);

  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  // A scene that the tier refuses leaves nothing behind: the folder is made when the run is executed.
  StoredRun run(tier, scene, folder, arguments.resume);
  if (run.is_complete()) {
    if (!arguments.quiet) fmt::print("{}: this run is complete\n", folder.string());
    return done;
  }
  setting_up = false;
  Result result;
  {
    ProgressDisplay display(arguments.quiet);
    RunControl control;
    control.report = [&](const Progress& progress) { display.show(progress); };
    control.interrupted = [] { return stop_asked.load(); };
    result = run.execute(control, [&](const std::string& failure) {
      if (!arguments.quiet) spdlog::warn("the run goes on, but cannot be resumed from here: {}", failure);
    });
  }
  // A report that was made of an earlier result must not stand beside this one.
  std::error_code no_report;
  fs::remove(folder / report_file, no_report);
  run.store(result);
  if (arguments.report && result.observables.rows() > 0)
    write_whole(folder / report_file, make_report({read_result(folder)}));

  const RunRecord& record = result.record;
  if (!arguments.quiet)
    fmt::print("{}: tier {}, {} rows, {} steps, {} Newton iterations, set-up {:.1f} ms, solver {:.1f} ms\n",
               folder.string(), record.tier, result.observables.rows(), record.steps,
               record.newton_iterations, 1e3 * record.setup_seconds, 1e3 * record.solve_seconds);
  if (!record.failure.empty()) {
    fmt::print(stderr, "tunica: {}: the solver gave up {}; results up to there are in {}\n", scene.name(),
               record.failure, folder.string());
    return gave_up;
  }
  if (record.interrupted) {
    fmt::print(stderr, "tunica: {}: interrupted; results so far are in {}, --resume completes them\n",
               scene.name(), folder.string());
    return interrupted;
  }
  return done;
}

}  // namespace tunica
