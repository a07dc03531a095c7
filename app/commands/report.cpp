// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/report.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "app/commands/commands.hpp"

namespace tunica {

namespace fs = std::filesystem;

int report_command(const ReportArguments& arguments) {
  std::vector<StoredResult> runs;
  for (const auto& folder : arguments.folders) runs.push_back(read_result(folder));
  fs::path file = arguments.out;
  if (file.empty()) {
    // A trailing separator would make the folder its own parent.
    const fs::path first = fs::absolute(arguments.folders.front()).lexically_normal() / "";
    const fs::path folder = first.parent_path();
    file = (runs.size() == 1 ? folder : folder.parent_path()) / "report.html";
  }
  write_whole(file, make_report(runs));
  fmt::print("{}\n", file.string());
  return done;
}

}  // namespace tunica
