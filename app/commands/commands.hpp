// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "app/program.hpp"

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

struct SceneArguments {
  std::string scene;
  std::vector<std::string> overrides;
  bool list = false;
  bool parameters = false;
};
int scene_command(const SceneArguments& arguments);

struct ReportArguments {
  std::vector<std::string> folders;
  std::string out;  ///< empty: report.html in the folder, or in the folder that holds the first of several
};
int report_command(const ReportArguments& arguments);

}  // namespace tunica
