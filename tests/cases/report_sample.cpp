// SPDX-License-Identifier: GPL-3.0-or-later
// Writes reports of made-up runs for the browser tests: report_sample FOLDER.
#include <filesystem>
#include <iostream>

#include "app/report/report.hpp"
#include "tests/support/synthetic.hpp"

using namespace tunica;
using test_support::synthetic_run;

namespace {

std::vector<StoredResult> four_laws() {
  return {synthetic_run({.law = "EXP1", .displacement_scale = 0.0200}),
          synthetic_run({.law = "EXP2", .displacement_scale = 0.0212}),
          synthetic_run({.law = "EXP1+EXP2-ZS", .displacement_scale = 0.0190}),
          synthetic_run({.law = "EXP1+EXP2-FS", .displacement_scale = 0.0205, .with_sensitivities = true})};
}

/// A run whose every text tries to leave its place in the page.
StoredResult hostile() {
  const std::string attack =
      "</script><script>document.documentElement.dataset.broken='yes'</script>"
      "<img src=x onerror=\"document.documentElement.dataset.broken='yes'\">{{data}}&amp;'\"";
  StoredResult run = synthetic_run({.name = attack});
  run.folder = attack;
  run.record["scene"]["wall.law"] = attack;
  run.record["scene_toml"] = attack + "\nbad byte \xff";
  run.record["failure"] = attack;
  run.record["remarks"] = {attack};
  run.record["tier"] = attack;
  for (auto& label : run.result.events[1].labels) label = attack;
  return run;
}

StoredResult finer_in_time() {
  return synthetic_run({.name = "fine", .interval = 0.0007});
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  write_whole(folder / "four.html", make_report(four_laws()));
  write_whole(folder / "one.html", make_report({synthetic_run({})}));
  write_whole(folder / "isotropic.html", make_report({synthetic_run({.law = "EXP1"})}));
  write_whole(folder / "hostile.html", make_report({hostile()}));
  write_whole(folder / "grids.html", make_report({synthetic_run({.law = "EXP1"}), finer_in_time()}));
  return 0;
}
