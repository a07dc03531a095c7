// SPDX-License-Identifier: GPL-3.0-or-later
// Writes reports of made-up runs for the browser tests: report_sample FOLDER.
#include <filesystem>
#include <iostream>

#include "app/report/report.hpp"
#include "app/report/sweep_page.hpp"
#include "core/units.hpp"
#include "tests/support/bent_tube.hpp"
#include "tests/support/fake_tier.hpp"
#include "tests/support/made_scene.hpp"
#include "tests/support/made_sweep.hpp"
#include "tests/support/synthetic.hpp"
#include "verification/cross_tier.hpp"

using namespace tunica;
using test_support::synthetic_run;
using test_support::synthetic_state;

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

/// Runs that one key tells apart.
std::vector<StoredResult> ten() {
  std::vector<StoredResult> runs;
  for (int k = 1; k <= 10; ++k) {
    StoredResult run = synthetic_run({.lowest_pressure = 60.0 + 5 * k, .highest_pressure = 110.0 + 5 * k});
    run.folder = "results/sweeps/of/the/outlets/resistance/run-" + std::to_string(k);
    run.record["scene"]["outlet.resistance"] = 2e5 * k;
    run.record["scene_set"].push_back("outlet.resistance");
    runs.push_back(std::move(run));
  }
  return runs;
}

/// A bent artery of one beat with a picture at peak flow.
StoredResult with_peak() {
  StoredResult run = synthetic_run({.law = "EXP2", .beats = 1});
  run.record["tier"] = "full3d";
  run.record["scene"]["geometry.kind"] = "torus";
  run.record["scene_set"].push_back("geometry.kind");
  run.result.fields = test_support::bent_tube({});
  for (auto& series : run.result.fields) series.frames[2].time = 0.2112;
  return run;
}

/// Made-up curves whose pressure and displacement are larger by so many parts.
Result larger_by(double share) {
  Result result = synthetic_run({.lowest_pressure = 75 * (1 + share),
                                 .highest_pressure = 130 * (1 + share),
                                 .displacement_scale = 0.02 * (1 + share)})
                      .result;
  result.record.converged = true;
  return result;
}

/// A verification of two made-up tiers with a rung on each side.
verification::CrossTier verified(const std::filesystem::path& folder) {
  const test_support::FakeTier low{"low", [](const Scene& scene, const RunControl&) {
                                     return larger_by(scene.flag("lumped.inertance") ? 0.02 : 0.0);
                                   }};
  const test_support::FakeTier high{"high", [](const Scene& scene, const RunControl&) {
                                      return larger_by(scene.number("wall.density") == 2 ? 0.021 : 0.05);
                                    }};
  return verification::verify(test_support::door_of_made_scene(), {&low, &high}, folder, {},
                              {{"low",
                                "high",
                                {{"inertance", {"lumped.inertance=true"}, "inertia"}},
                                {{"ends", {"wall.density=2"}, "<b>ends</b>"}}}});
}

StoredResult in_space(const char* law, const test_support::BentTube& tube) {
  StoredResult run = synthetic_run({.law = law});
  run.result.fields = test_support::bent_tube(tube);
  return run;
}

/// Static states that one pressure tells apart, not in its order.
std::vector<StoredResult> states_by_key() {
  std::vector<StoredResult> states;
  for (const double pressure : {120.0, 80.0, 100.0}) {
    states.push_back(synthetic_state({.highest_pressure = pressure, .displacement_scale = 2e-4 * pressure}));
    states.back().record["scene"]["inlet.pressure"] = pressure * mmhg;
  }
  return states;
}

/// A sweep in which two points have whole results.
std::string sweep_page(const std::filesystem::path& folder) {
  std::filesystem::remove_all(folder);
  test_support::make_sweep(
      folder, {.reason = "</script><script>document.documentElement.dataset.broken='yes'</script>",
               .with_indices = true});
  for (const char* point : {"4", "7"}) {
    const std::string length = std::string("geometry.length=0.") + point;
    const run::Door door = test_support::door_of_made_scene({length});
    write_result(folder / "points" / point, door.source().scene(), synthetic_run({}).result);
  }
  return make_sweep_report(folder, {7});
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  write_whole(folder / "four.html", make_report(four_laws()));
  write_whole(folder / "one.html", make_report({synthetic_run({})}));
  write_whole(folder / "length.html",
              make_report({synthetic_run({.with_length = true}), synthetic_run({.law = "EXP1"})}));
  write_whole(folder / "isotropic.html", make_report({synthetic_run({.law = "EXP1"})}));
  write_whole(folder / "ten.html", make_report(ten()));
  const std::vector<StoredResult> states{
      synthetic_state({.law = "EXP1+EXP2-FS", .highest_pressure = 80}),
      synthetic_state({.law = "EXP1+EXP2-FS", .highest_pressure = 100, .displacement_scale = 0.022}),
      synthetic_state({.law = "EXP1", .highest_pressure = 100})};
  write_whole(folder / "states.html", make_report(states));
  write_whole(folder / "states-by-key.html", make_report(states_by_key()));
  write_whole(folder / "mixed.html", make_report({states[0], synthetic_run({})}));
  write_whole(folder / "peak.html", make_report({with_peak()}));
  write_whole(folder / "hostile.html", make_report({hostile()}));
  write_whole(folder / "grids.html", make_report({synthetic_run({.law = "EXP1"}), finer_in_time()}));
  write_whole(folder / "space.html", make_report({in_space("EXP1+EXP2-FS", {})}));
  write_whole(
      folder / "spaces.html",
      make_report({in_space("EXP1+EXP2-FS", {.bend = 0, .is_quarter = true}), synthetic_run({.law = "EXP1"}),
                   in_space("EXP2", {.is_half = true, .of_tetrahedra = true, .displacement = 0.008})}));
  // As large as a run of two beats with some 3000 quadratic cells, each shown as eight.
  write_whole(
      folder / "large.html",
      make_report({in_space("EXP1+EXP2-FS", {.per_side = 12, .through = 4, .along = 72, .frames = 33})}));
  const verification::CrossTier found = verified(folder / "verify");
  write_whole(folder / "verify.html", make_report(found.tier_results(), &found));
  write_whole(folder / "sweep.html", sweep_page(folder / "sweep of 'many' points"));
  return 0;
}
