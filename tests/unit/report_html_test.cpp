// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "app/report/html.hpp"
#include "app/report/report.hpp"
#include "app/report/summary.hpp"
#include "core/error.hpp"
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
  const auto run = [](const char* name, const char* law, const char* tether) {
    return synthetic_run({.name = name, .law = law, .tether = tether});
  };
  EXPECT_EQ(labels({run("a", "EXP1", "normal"), run("a", "EXP2", "normal")}), (Labels{"EXP1", "EXP2"}));
  EXPECT_EQ(labels({run("a", "EXP1", "normal"), run("b", "EXP1", "normal")}), (Labels{"EXP1, a", "EXP1, b"}));
  EXPECT_EQ(labels({run("a", "EXP1", "normal"), run("a", "EXP1", "current")}),
            (Labels{"EXP1, lumped, tether\u00a0normal", "EXP1, lumped, tether\u00a0current"}));
  EXPECT_EQ(labels({run("a", "EXP1", "normal"), run("a", "EXP1", "normal")}),
            (Labels{"EXP1, results/a-EXP1 (1)", "EXP1, results/a-EXP1 (2)"}));
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
