// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/report.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/interrupt.hpp"
#include "app/report/sweep_page.hpp"
#include "app/report/sweep_table.hpp"
#include "app/tell.hpp"
#include "core/error.hpp"
#include "core/run/door.hpp"
#include "verification/sweep/campaign.hpp"

namespace tunica {

namespace fs = std::filesystem;

namespace {

/// Report.html of a folder; a trailing separator would make the folder its own parent.
fs::path file_beside(const std::string& folder) {
  return (fs::absolute(folder).lexically_normal() / "").parent_path() / "report.html";
}

/// Computes a point of a sweep and keeps its whole result, unless it is there. Returns an exit code.
int keep_point(const run::Door& door, const nlohmann::ordered_json& campaign, const sweep::Row& row,
               const fs::path& folder) {
  std::vector<std::string> values;
  const auto& parameters = campaign.at("design").at("parameters");
  for (std::size_t k = 0; k < row.keys.size(); ++k)
    if (!row.keys[k].empty())  // else the point has what the scene says
      values.push_back(fmt::format("{}={}", parameters.at(k).at("key").get<std::string>(), row.keys[k]));
  const std::string tier = row.tier.empty() ? campaign.at("tier").get<std::string>() : row.tier;
  run::Keep keep;
  keep.folder = folder / "points" / fmt::format("{}", row.point);
  RunControl control;
  control.interrupted = stop_asked;
  const run::Outcome outcome = door.compute({tier, values}, keep, control);
  if (outcome.ending == run::Ending::done) return done;
  if (outcome.ending == run::Ending::interrupted) {
    tell(fmt::format("tunica: interrupted at point {}; the same command goes on\n", row.point));
    return interrupted;
  }
  tell(fmt::format("tunica: {}, point {}: {}\n", folder.string(), row.point, outcome.reason));
  return outcome.ending == run::Ending::refused ? bad_input : gave_up;
}

/// The door of the scene as it was when the sweep was made. Throws InvalidInput when it has changed.
run::Door door_of(const nlohmann::ordered_json& campaign, const fs::path& folder, const Program& program) {
  run::DoorOptions options;
  options.program = fs::read_symlink("/proc/self/exe").parent_path() / "tunica";
  const auto file = campaign.at("scene_file").get<std::string>();
  run::SceneSource source(file, campaign.at("overrides").get<std::vector<std::string>>());
  if (describe(source.scene()) != campaign.at("scene_toml").get<std::string>())
    throw InvalidInput(
        fmt::format("--point: {} is not the scene any more that {} was made of; make the sweep "
                    "again, or restore the file",
                    file, folder.string()));
  return {program.tiers(), std::move(source), options};
}

int report_sweep(const ReportArguments& arguments, const Program& program) {
  const std::string& folder = arguments.folders.front();
  int code = done;
  if (!arguments.points.empty()) {
    const auto campaign = sweep::read_campaign(folder);
    std::vector<sweep::Row> rows;
    for (const std::uint64_t point : arguments.points) rows.push_back(report::read_point(folder, point));
    const run::Door door = door_of(campaign, folder, program);
    heed_interrupts(false);
    computation_begins();
    for (const sweep::Row& row : rows) {
      code = keep_point(door, campaign, row, folder);
      if (code != done) return code;
    }
  }
  const fs::path file = arguments.out.empty() ? file_beside(folder) : fs::path(arguments.out);
  write_whole(file, make_sweep_report(folder, arguments.points));
  fmt::print("{}\n", file.string());
  return code;
}

}  // namespace

int report_command(const ReportArguments& arguments, const Program& program) {
  const auto of_sweep = std::find_if(arguments.folders.begin(), arguments.folders.end(),
                                     [](const std::string& folder) { return sweep::holds_sweep(folder); });
  if (of_sweep != arguments.folders.end()) {
    if (arguments.folders.size() == 1) return report_sweep(arguments, program);
    throw InvalidInput(fmt::format("{}: holds a sweep, whose report shows it alone", *of_sweep));
  }
  if (!arguments.points.empty())
    throw InvalidInput(fmt::format("--point: {} holds no sweep", arguments.folders.front()));
  std::vector<StoredResult> runs;
  for (const auto& folder : arguments.folders) runs.push_back(read_result(folder));
  fs::path file = arguments.out;
  if (file.empty()) {
    file = file_beside(arguments.folders.front());
    if (runs.size() > 1) file = file.parent_path().parent_path() / "report.html";
  }
  write_whole(file, make_report(runs));
  fmt::print("{}\n", file.string());
  return done;
}

}  // namespace tunica
