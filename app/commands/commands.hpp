// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/program.hpp"

namespace CLI {
class App;
}

namespace tunica {

/// Exit codes of the program.
enum ExitCode { done = 0, bad_input = 2, gave_up = 3, interrupted = 130 };

struct RunArguments {
  std::string scene;
  std::string tier = "auto";
  std::vector<std::string> overrides;
  std::string out;  ///< empty: result_folder
  bool resume = false;
  bool replace = false;  ///< also what could be resumed
  bool quiet = false;
  bool report = true;
};
int run_command(const RunArguments& arguments, const Program& program);

struct VerifyArguments {
  std::string scene;
  std::vector<std::string> tiers;  ///< empty: all that can compute the scene
  std::vector<std::string> overrides;
  std::string out;  ///< empty: result_folder
  bool replace = false;
  bool quiet = false;
};
int verify_command(const VerifyArguments& arguments, const Program& program);

struct SweepArguments {
  std::string scene;
  std::string tier = "auto";
  std::vector<std::string> overrides, vary, quantities;
  std::string sample;  ///< "sobol:100"; empty for a grid
  std::string points;  ///< CSV file
  std::uint64_t seed = 0;
  bool gradients = false, keep_runs = false, timings = false;
  bool indices = false;
  bool surrogate = false, no_surrogate = false;  ///< for indices; neither: where runs are dear
  std::vector<std::string> fidelities;           ///< "lumped", "axisym:200"; empty: the one tier
  std::optional<double> until;  ///< width of intervals of indices; none: as many points as --sample says
  int jobs = 0;                 ///< 0: all cores
  int ranks = 1;
  std::string shard;  ///< "1/4"; empty: all, or what a Slurm array says
  std::vector<std::string> merge;
  std::string out;
  bool resume = false, replace = false, quiet = false;
};
int sweep_command(const SweepArguments& arguments, const Program& program);
/// Declares the command and what it is given; the arguments have to outlive the parsing.
CLI::App* add_sweep_command(CLI::App& app, SweepArguments& arguments);

struct CalibrateArguments {
  std::string scene;
  std::string tier = "auto";
  std::vector<std::string> overrides, free, targets;
  int starts = 5;
  std::uint64_t seed = 0;
  int jobs = 0;     ///< 0: all cores
  std::string out;  ///< empty: result_folder
  bool quiet = false;
};
int calibrate_command(const CalibrateArguments& arguments, const Program& program);
CLI::App* add_calibrate_command(CLI::App& app, CalibrateArguments& arguments);

struct ServeArguments {
  std::string scene;
  std::string tier = "auto";
  std::vector<std::string> inputs, outputs, overrides;
  std::string host = "127.0.0.1";
  int port = 4242;
  int jobs = 0;  ///< 0: all cores
  bool quiet = false;
};
int serve_command(const ServeArguments& arguments, const Program& program);
CLI::App* add_serve_command(CLI::App& app, ServeArguments& arguments);

struct SceneArguments {
  std::string scene;
  std::vector<std::string> overrides;
  bool list = false;
  bool parameters = false;
};
int scene_command(const SceneArguments& arguments);

struct ReportArguments {
  std::vector<std::string> folders;
  std::vector<std::uint64_t> points;  ///< of a sweep, whose whole results are computed and shown
  std::string out;  ///< empty: report.html in the folder, or in the folder that holds the first of several
};
int report_command(const ReportArguments& arguments, const Program& program);
/// Declares the command and what it is given; the arguments have to outlive the parsing.
CLI::App* add_report_command(CLI::App& app, ReportArguments& arguments);

}  // namespace tunica
