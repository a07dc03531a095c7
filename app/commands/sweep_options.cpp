// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>

#include "app/commands/commands.hpp"
#include "app/commands/option_checks.hpp"

namespace tunica {

namespace {

constexpr const char* sweep_examples =
    R"TEXT(Examples:
  tunica sweep scenes/cylinder.toml --vary outlet.resistance=5e5:2e6:15:log --vary tether.stiffness=3e6:3e7:15:log
  tunica sweep scenes/cylinder.toml --vary "wall.activation_stretch=1.2:1.7" --sample sobol:1000 --tier lumped
  tunica sweep scenes/cylinder.toml --vary "outlet.resistance=lognormal(1e6, 1e5)" --sample lhs:200 --gradients
  tunica sweep scenes/cylinder.toml --vary outlet.resistance=5e5:2e6 --vary tether.stiffness=3e6:3e7:log
               --sample sobol:256 --indices --until 0.05 --tier lumped
  tunica sweep scenes/cylinder.toml --vary outlet.resistance=5e5:2e6 --vary tether.stiffness=3e6:3e7:log
               --sample sobol:2000 --fidelities lumped,axisym:100
  tunica sweep scenes/cylinder.toml --points mine.csv --quantity pressure.max --quantity von_mises.max
  tunica sweep scenes/cylinder.toml --vary ... --shard 1/4 --out part1
  tunica sweep --merge part1 part2 part3 part4 --out all

Exit codes: 0 done (points without a result are rows with the reason), 2 bad input (nothing was computed),
3 no point has a result, 130 interrupted: --resume goes on.)TEXT";

}  // namespace

CLI::App* add_sweep_command(CLI::App& app, SweepArguments& arguments) {
  auto* command = app.add_subcommand("sweep", "Compute a scene at many points and tabulate quantities");
  command->footer(sweep_examples);
  const auto option = [&](const char* name, auto& value, const char* text, const char* type) {
    return command->add_option(name, value, text)->type_name(type);
  };
  option("scene", arguments.scene, "Scene file (TOML)", "SCENE");
  option("--vary", arguments.vary,
         "A key and its values: KEY=LO:HI:N[:log] or KEY=A,B for a grid; KEY=LO:HI[:log] or "
         "KEY=DISTRIBUTION(...) with --sample; may be repeated",
         "KEY=...")
      ->take_all()
      ->allow_extra_args(false);
  option("--sample", arguments.sample, "Draw points: sobol:N, lhs:N or random:N", "DESIGN");
  option("--seed", arguments.seed, "Of the sample (default 0; sobol is shifted at random by any other)", "S")
      ->check(check_seed);
  option("--points", arguments.points, "CSV file with a header of keys, units in brackets optional", "FILE");
  option("--tier", arguments.tier, "Model to compute with, as in tunica run", "TIER");
  option("--set", arguments.overrides, "Override a key of the scene for all points; may be repeated",
         "KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  option("--quantity", arguments.quantities,
         "OBSERVABLE.STATISTIC of the last beat, such as pressure.max (default: all); may be repeated", "Q")
      ->take_all()
      ->allow_extra_args(false);
  auto* indices =
      command->add_flag("--indices", arguments.indices,
                        "First and total Sobol' indices with 95 % intervals, in indices.csv: in 0D N of "
                        "--sample counts groups of d + 2 points for d keys; elsewhere, and with --points, "
                        "they come from surrogates of the points");
  auto* surrogate = command->add_flag("--surrogate", arguments.surrogate,
                                      "With --indices: from surrogates also in 0D; N counts points");
  surrogate->needs(indices);
  command
      ->add_flag("--no-surrogate", arguments.no_surrogate,
                 "With --indices: not from surrogates, whatever the tier; N counts groups")
      ->needs(indices)
      ->excludes(surrogate);
  option("--fidelities", arguments.fidelities,
         "Tiers from cheap to dear, separated by commas: the first computes all points, each other one the "
         "first N of them (default: a sixteenth of those before it); indices and means of the dearest in "
         "sweep.json, and where the tiers differ in fidelities.csv",
         "TIER[:N],...")
      ->delimiter(',')
      ->allow_extra_args(false);
  option("--until", arguments.until,
         "With --indices: take more points until every interval is at most so wide (0.02)", "WIDTH")
      ->check(check_width)
      ->needs(indices);
  command->add_flag("--gradients", arguments.gradients,
                    "Add the derivatives by the keys that vary (0D and 2D tiers)");
  option("--jobs", arguments.jobs, "Points computed at once (default: as many as there are cores)", "N");
  option("--ranks", arguments.ranks, "Processes of each 3D point, by mpirun", "N");
  auto* shard = option("--shard", arguments.shard,
                       "Compute the i-th of n parts (default in a Slurm array: its task's)", "i/n");
  auto* merge = option("--merge", arguments.merge, "Make one sweep of the shards in these folders", "DIR...");
  merge->excludes(shard);
  command->add_flag("--keep-runs", arguments.keep_runs,
                    "Keep each point's whole result in DIR/points/NUMBER");
  command->add_flag("--timings", arguments.timings,
                    "Fill seconds[s] in sweep.csv, which then differs from computation to computation");
  option("--out", arguments.out, "Folder for the results (default: results/NAME-sweep)", "DIR");
  auto* resume =
      command->add_flag("--resume", arguments.resume, "Go on with a sweep that was stopped or killed");
  command->add_flag("--replace", arguments.replace, "Begin anew, whatever sweep lies in the folder")
      ->excludes(resume);
  command->add_flag("--quiet", arguments.quiet, "Print errors only");
  return command;
}

}  // namespace tunica
