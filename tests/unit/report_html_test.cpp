// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "app/report/html.hpp"
#include "app/report/report.hpp"
#include "app/report/summary.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "tests/support/synthetic.hpp"

using namespace tunica;
using namespace tunica::report;
using test_support::synthetic_run;

TEST(ReportHtml, TextIsEscaped) {
  EXPECT_EQ(escape("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
}

TEST(ReportHtml, JsonCannotEndItsScript) {
  const std::string json = script_json({{"name", "</script><!--"}, {"bad", "\xff"}});
  EXPECT_EQ(json.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(json)["name"], "</script><!--");
}

TEST(ReportHtml, NumbersHaveARealMinusAndNoMinusZero) {
  EXPECT_EQ(number(-1.25, 1), "−1.2");
  EXPECT_EQ(number(-0.001, 2), "0.00");
  EXPECT_EQ(number(observables::none, 2), "–");
}

TEST(ReportHtml, FilledInTextIsNotFilledInAgain) {
  EXPECT_EQ(fill("a {{x}} b {{y}}", {{"x", "{{y}}"}, {"y", "2"}}), "a {{y}} b 2");
  EXPECT_THROW(fill("{{z}}", {}), std::logic_error);
  EXPECT_THROW(fill("{{z", {}), std::logic_error);
}

TEST(ReportSummary, LabelsTellRunsApart) {
  const auto labels = [](const std::vector<StoredResult>& runs) {
    std::vector<std::string> found;
    for (const RunSummary& run : summarize(runs)) found.push_back(run.label);
    return found;
  };
  using Labels = std::vector<std::string>;
  const auto run = [](const char* name, const char* law,
                      std::vector<std::pair<std::string, nlohmann::json>> set = {}) {
    StoredResult made = synthetic_run({.name = name, .law = law});
    for (const auto& [key, value] : set) {
      made.record["scene"][key] = value;
      made.record["scene_set"].push_back(key);
    }
    return made;
  };
  EXPECT_EQ(labels({run("a", "EXP1")}), (Labels{"EXP1"}));
  EXPECT_EQ(labels({run("a", "EXP1"), run("a", "EXP2")}), (Labels{"EXP1", "EXP2"}));
  EXPECT_EQ(labels({run("a", "EXP1"), run("b", "EXP1")}), (Labels{"a", "b"}));
  EXPECT_EQ(labels({run("a", "EXP1"), run("a", "EXP1", {{"tether.traction", "current"}})}),
            (Labels{"tether\u00a0normal", "tether\u00a0current"}));
  // Numbers with the unit that people read, whole or not; what both have is not told.
  EXPECT_EQ(labels({run("a", "EXP1", {{"outlet.resistance", 1.2e6}, {"geometry.length", 0.5}}),
                    run("a", "EXP1", {{"outlet.resistance", 500000}, {"geometry.length", 0.5}})}),
            (Labels{"resistance\u00a01.2e6\u00a0dyn\u00a0s/cm5", "resistance\u00a05e5\u00a0dyn\u00a0s/cm5"}));
  EXPECT_EQ(labels({run("a", "EXP1", {{"inlet.pressure", 80 * mmhg}, {"outlet.pressure", 10 * mmhg}}),
                    run("a", "EXP1", {{"inlet.pressure", 90 * mmhg}, {"outlet.pressure", 0.0}})}),
            (Labels{"inlet.pressure\u00a080\u00a0mmHg, outlet.pressure\u00a010\u00a0mmHg",
                    "inlet.pressure\u00a090\u00a0mmHg, outlet.pressure\u00a00\u00a0mmHg"}));
  // A constant of one law is told where it was set, and not of the other law.
  EXPECT_EQ(labels({run("a", "EXP1+EXP2-FS", {{"wall.fiber_angle", 30.0}}), run("a", "EXP1+EXP2-FS"),
                    run("a", "EXP1+EXP2-ZS")}),
            (Labels{"EXP1+EXP2-FS, fiber\u00a0angle\u00a030°", "EXP1+EXP2-FS, fiber\u00a0angle\u00a042.82°",
                    "EXP1+EXP2-ZS"}));
  // Nor do constants count that other laws do not have: scenes/cylinder.toml sets some.
  EXPECT_EQ(labels({run("a", "EXP1", {{"wall.density", 1.2}}), run("b", "EXP1+EXP2-FS",
                                                                   {{"wall.activation_stretch", 1.5009},
                                                                    {"wall.fiber_angle", 42.82},
                                                                    {"wall.fiber_stiffness", 1e5},
                                                                    {"wall.fiber_stiffening", 0.2}})}),
            (Labels{"EXP1, density\u00a01.2\u00a0g/cm3", "EXP1+EXP2-FS"}));
  // Numbers come after physics, and output is no difference.
  EXPECT_EQ(labels({run("a", "EXP1", {{"accuracy.tolerance", 0.01}, {"output.interval", 0.1}}),
                    run("a", "EXP1", {{"accuracy.tolerance", 1e-3}, {"output.interval", 0.2}})}),
            (Labels{"tolerance\u00a00.01", "tolerance\u00a00.001"}));
  // Scenes that differ in much have names.
  const std::vector<std::pair<std::string, nlohmann::json>> much{{"geometry.length", 2.0},
                                                                 {"geometry.radius", 0.2},
                                                                 {"outlet.resistance", 1e5},
                                                                 {"tether.stiffness", 1e6}};
  auto finer = much;
  finer.emplace_back("accuracy.tolerance", 1e-4);
  EXPECT_EQ(labels({run("ours", "EXP1"), run("theirs", "EXP1", much)}), (Labels{"ours", "theirs"}));
  auto plain = much;
  plain.emplace_back("accuracy.tolerance", 1e-2);
  EXPECT_EQ(
      labels({run("ours", "EXP1", {{"accuracy.tolerance", 1e-2}}), run("theirs", "EXP1", plain),
              run("theirs", "EXP1", finer)}),
      (Labels{"ours, tolerance\u00a00.01", "theirs, tolerance\u00a00.01", "theirs, tolerance\u00a00.0001"}));
  // Nothing but the folder, its last part, tells repetitions apart; where that is the same too, a number
  // does.
  StoredResult again = run("a", "EXP1");
  again.folder = "results/again/";
  EXPECT_EQ(labels({run("a", "EXP1"), again}), (Labels{"a-EXP1", "again"}));
  EXPECT_EQ(labels({run("a", "EXP1"), run("a", "EXP1")}), (Labels{"a-EXP1 (1)", "a-EXP1 (2)"}));
}

TEST(ReportSummary, TiersAreToldApart) {
  StoredResult lumped = synthetic_run({}), axisym = synthetic_run({});
  axisym.record["tier"] = "axisym";
  const auto runs = std::vector<StoredResult>{lumped, axisym};
  EXPECT_EQ(summarize(runs)[0].label, "lumped");
  EXPECT_EQ(summarize(runs)[1].label, "axisym");
}

TEST(ReportSummary, AStaticStateHasFibres) {
  const std::vector<StoredResult> runs{test_support::synthetic_state({.law = "EXP1+EXP2-FS"})};
  const RunSummary state = summarize(runs).front();
  EXPECT_TRUE(state.is_state);
  // At the peak all four thresholds are passed.
  for (const double share : state.recruited_share) EXPECT_EQ(share, 1);
  const std::string page = make_report(runs);
  EXPECT_EQ(page.find("no fibres</td>"), std::string::npos);
  EXPECT_NE(page.find("Static states"), std::string::npos);
  EXPECT_EQ(make_report({synthetic_run({})}).find("Static states"), std::string::npos);
}

TEST(Report, RemarksStandOnceBelowTheKeyNumbers) {
  StoredResult one = synthetic_run({.law = "EXP1"}), two = synthetic_run({.law = "EXP2"});
  for (StoredResult* run : {&one, &two}) run->record["remarks"] = {"both <say> it"};
  two.record["findings"] = {"only this one"};
  const std::string page = make_report({one, two});
  const std::size_t first = page.find("<li>both &lt;say&gt; it</li>");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(page.find("both &lt;say", first + 10), std::string::npos);
  EXPECT_NE(page.find("<li>only this one <small>(EXP2)</small></li>"), std::string::npos);
}

TEST(ReportSummary, HeadlineNumbersAreThoseTheRunWasMadeWith) {
  const std::vector<StoredResult> runs{synthetic_run({})};
  const RunSummary run = summarize(runs).front();
  EXPECT_NEAR(run.pressure.lowest, 75, 1e-3);
  EXPECT_NEAR(run.pressure.highest, 130, 1e-3);
  EXPECT_NEAR(run.transmural_pressure.highest, 15, 1e-3);
  EXPECT_NEAR(run.radius_change, 0.4 * 0.020 / 0.033, 1e-4);
  EXPECT_NEAR(run.largest_radius, 0.020 / 0.033, 1e-4);
  EXPECT_NEAR(run.systole, 0.2112, 1e-5);
  EXPECT_NEAR(run.angle_at_systole.lowest, 42.82 - 9.5, 1e-4);
  EXPECT_NEAR(run.angle_at_systole.highest, 42.82 - 9.5 * 0.75, 1e-4);
  EXPECT_EQ(run.state, "done");
}

TEST(ReportSummary, AStoppedRunSaysWhy) {
  StoredResult stopped = synthetic_run({});
  stopped.record["failure"] = "no equilibrium at 0.3 s";
  const std::vector<StoredResult> runs{stopped};
  EXPECT_EQ(summarize(runs).front().state, "no equilibrium at 0.3 s");
  EXPECT_FALSE(summarize(runs).front().is_complete);
  EXPECT_NE(make_report(runs).find("no equilibrium at 0.3 s"), std::string::npos);
}

TEST(Report, NeedsRunsWithRows) {
  EXPECT_THROW(make_report({}), InvalidInput);
  StoredResult empty = synthetic_run({});
  empty.result.observables = observables::standard_table();
  EXPECT_THROW(make_report({empty}), InvalidInput);
}

TEST(Report, ARecordOfOddTypesIsNoCrash) {
  StoredResult odd = synthetic_run({});
  for (const char* key : {"scene", "scene_toml", "scene_set", "name", "tier", "seconds", "remarks", "failure",
                          "interrupted", "converged", "unknowns"})
    odd.record[key] = 7;
  EXPECT_NO_THROW(make_report({odd}));
  odd.record = nlohmann::ordered_json::object();
  EXPECT_NO_THROW(make_report({odd}));
}
