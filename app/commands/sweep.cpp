// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "app/commands/commands.hpp"
#include "app/commands/sweep_plan.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/report/sweep_page.hpp"
#include "app/result_folder.hpp"
#include "app/tell.hpp"
#include "core/error.hpp"
#include "core/threads.hpp"
#include "verification/sweep/campaign.hpp"
#include "verification/sweep/index_table.hpp"
#include "verification/sweep/surrogate_table.hpp"
#include "verification/uncertainty/surrogate.hpp"

namespace tunica {

namespace fs = std::filesystem;

namespace {

void tell_of_surrogates(const sweep::IndexSummary& indices) {
  if (indices.lost > 0) spdlog::warn("surrogates: {} points have no result and are left out", indices.lost);
  constexpr std::size_t most_told = 5;
  for (std::size_t k = 0; k < std::min(most_told, indices.poor.size()); ++k) spdlog::warn(indices.poor[k]);
  if (indices.poor.size() > most_told)
    spdlog::warn("and {} more quantities without a good surrogate; sweep.json has the reasons",
                 indices.poor.size() - most_told);
  spdlog::info("Sobol' indices by surrogates of {} points: {}", indices.points,
               std::isfinite(indices.widest)
                   ? fmt::format("the widest 95 % interval is {:.3g}", indices.widest)
                   : "some quantities have none");
}

/// indices.csv of a whole sweep that is for them; the widest interval.
double make_indices(sweep::SweepSummary& summary, const fs::path& folder, bool quiet) {
  if (summary.interrupted || summary.done == 0) return 0;
  if (!quiet && sweep::makes_surrogates(sweep::read_campaign(folder)))
    spdlog::info("making surrogates of {} points", summary.done);
  const sweep::IndexSummary indices = sweep::write_indices(folder, stop_asked);
  if (indices.interrupted) {
    summary.interrupted = true;
    return 0;
  }
  if (quiet) return indices.widest;
  if (indices.groups == 0) {
    tell_of_surrogates(indices);
    return indices.widest;
  }
  if (indices.lost > 0)
    spdlog::warn("Sobol' indices: {} of {} groups have a point without a result and are left out",
                 indices.lost, indices.groups);
  spdlog::info("Sobol' indices of {} groups: the widest 95 % interval is {:.3g}", indices.groups,
               indices.widest);
  return indices.widest;
}

/// How many points a folder's sweep had when it was last at work; 0 where there is none.
std::uint64_t points_before(const fs::path& folder) {
  return fs::exists(folder / sweep::campaign_file)
             ? sweep::read_campaign(folder).at("points").get<std::uint64_t>()
             : 0;
}

/// Writes the report of what there is and tells how it ended.
int conclude(const sweep::SweepSummary& summary, const fs::path& folder, bool quiet) {
  const std::uint64_t ended = summary.done + summary.gave_up + summary.refused;
  // A shard alone can have no point at all.
  if (ended > 0) write_whole(folder / "report.html", make_sweep_report(folder));
  if (summary.interrupted) {
    tell(fmt::format("tunica: interrupted; {} of {} points are in {}, --resume goes on\n", ended,
                     summary.count, folder.string()));
    return interrupted;
  }
  if (!quiet)
    tell(
        fmt::format("{}: {} points done{}{}: sweep.csv, sweep.db, sweep.json, report.html\n", folder.string(),
                    summary.done, summary.gave_up > 0 ? fmt::format(", {} gave up", summary.gave_up) : "",
                    summary.refused > 0 ? fmt::format(", {} refused", summary.refused) : ""),
        stdout);
  if (summary.done > 0) return done;
  if (summary.count == 0) return done;  // one of more parts than there are points
  tell(fmt::format("tunica: {}: no point has a result; sweep.csv says why, in its column reason\n",
                   folder.string()));
  return gave_up;
}

}  // namespace

int sweep_command(const SweepArguments& arguments, const Program& program) {
  // Of the processes of an MPI job one sweeps. It does not go over to the program of the 3D tier: points of
  // that tier are processes of their own.
  program.before_computing({});
  if (!arguments.merge.empty()) {
    if (!arguments.scene.empty() || arguments.out.empty())
      throw InvalidInput("sweep --merge: name the folders of the shards and --out, and nothing else");
    auto summary =
        sweep::merge({arguments.merge.begin(), arguments.merge.end()}, arguments.out, arguments.replace);
    if (sweep::has_indices(arguments.out)) make_indices(summary, arguments.out, arguments.quiet);
    return conclude(summary, arguments.out, arguments.quiet);
  }
  if (arguments.scene.empty()) throw InvalidInput("sweep: name a scene (see tunica sweep --help)");
  constexpr int most = 1024;
  if (arguments.jobs < 0 || arguments.jobs > most || arguments.ranks < 1 || arguments.ranks > most)
    throw InvalidInput(fmt::format("sweep: --jobs and --ranks are numbers from 1 to {}", most));
  run::DoorOptions options;
  options.program = fs::read_symlink("/proc/self/exe").parent_path() / "tunica";
  options.ranks = arguments.ranks;
  const run::Door door(program.tiers(), run::SceneSource(arguments.scene, arguments.overrides), options);
  const Scene& scene = door.source().scene();
  auto points = points_of(arguments, wants_surrogates(arguments, program.tiers(), scene));
  const SweepPlan plan = plan_sweep(arguments, program.tiers(), scene, *points);
  sweep::Shard shard;
  std::vector<std::string> parts{"sweep"};
  if (!arguments.shard.empty()) {
    shard = sweep::parse_shard(arguments.shard);
  } else if (const auto of_array = sweep::shard_of_slurm_array()) {
    shard = *of_array;
    if (!arguments.quiet)
      spdlog::info("task of a Slurm array: computing shard {} (--shard 1/1 computes all)", shard.text());
  }
  // Tasks of an array are given one command, and so one folder.
  fs::path folder = arguments.out.empty()
                        ? result_folder(door.source().scene().name(), parts, arguments.overrides)
                        : fs::path(arguments.out);
  if (!shard.is_whole() && arguments.shard.empty())
    folder /= fmt::format("shard-{}-of-{}", shard.index, shard.count);

  // A process computes with all the cores that it is given; several of them side by side would wait for each
  // other's memory.
  const int jobs = arguments.jobs > 0 ? arguments.jobs : plan.all_compute ? available_threads() : 1;
  heed_interrupts(arguments.quiet);
  SweepDisplay display(arguments.quiet);
  sweep::SweepControl control;
  control.resume = arguments.resume;
  control.replace = arguments.replace;
  control.interrupted = stop_asked;
  bool begun = false;
  control.report = [&](const sweep::SweepProgress& progress) {
    if (!std::exchange(begun, true)) computation_begins();
    display.show(progress);
  };
  const std::optional<double> until = arguments.until;
  const auto compute = [&](sweep::Points& of) {
    const sweep::Campaign campaign{
        door,  plan.tier,      of, plan.question, shard, jobs, arguments.keep_runs, arguments.timings,
        until, plan.surrogates};
    return sweep::run_sweep(campaign, folder, control);
  };
  // Up to where intervals would take days to halve, or points no longer enter a surrogate.
  const std::uint64_t most_points = plan.surrogates ? std::uint64_t{uncertainty::most_points} : 1U << 24;
  std::uint64_t times = 1;
  const auto grow = [&] {
    // Dear points come in batches; others as many again as there are, as intervals halve with four times.
    times = plan.surrogates ? times + 1 : 2 * times;
    points = points_of(arguments, plan.surrogates, times);
  };
  // What has grown before goes on from there.
  const std::uint64_t before = until && arguments.resume ? points_before(folder) : 0;
  while (points->count() < std::min(before, most_points)) grow();
  sweep::SweepSummary summary = compute(*points);
  if ((plan.surrogates || plan.pick_freeze) && shard.is_whole()) {
    double widest = make_indices(summary, folder, arguments.quiet);
    while (until && widest > *until && summary.count < most_points && !summary.interrupted) {
      grow();
      control.resume = true;
      control.replace = false;
      summary = compute(*points);
      widest = make_indices(summary, folder, arguments.quiet);
    }
    if (until && widest > *until)
      spdlog::warn(
          "--until {:g} is not reached: with {} points the widest interval is {:.3g}; ask for fewer "
          "quantities with --quantity",
          *until, summary.count, widest);
  }
  return conclude(summary, folder, arguments.quiet);
}

}  // namespace tunica
