// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>

#include "app/commands/commands.hpp"

namespace tunica {

CLI::App* add_report_command(CLI::App& app, ReportArguments& arguments) {
  auto* command = app.add_subcommand("report", "Make one HTML file of one or more results, or of a sweep");
  command->add_option("folders", arguments.folders, "Folders of results, or the folder of a sweep")
      ->required()
      ->type_name("DIR...");
  command
      ->add_option("--point", arguments.points,
                   "Of a sweep: compute this point's whole result, keep it in DIR/points/NUMBER and show its "
                   "curves; may be repeated")
      ->type_name("NUMBER")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--out", arguments.out, "File to write (default: report.html beside the results)")
      ->type_name("FILE");
  return command;
}

}  // namespace tunica
