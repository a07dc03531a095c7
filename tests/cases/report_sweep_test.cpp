// SPDX-License-Identifier: GPL-3.0-or-later
// `tunica report` of a sweep as users start it: a point's curves, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/observables/result.hpp"
#include "core/scene/scene.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using test_support::is_one_line;
using test_support::read_text;
namespace fs = std::filesystem;

namespace {

class SweepReport : public testing::Test {
 protected:
  void SetUp() override {
    write_whole(folder_.path() / "scene.toml",
                read_text(std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml"));
    const auto ended = run({"sweep", "scene.toml", "--quiet", "--tier", "lumped", "--vary",
                            "outlet.resistance=6e5:1.2e6:3", "--quantity", "pressure.max", "--out", "all"});
    ASSERT_EQ(ended.code, 0) << ended.errors;
  }
  test_support::Ended run(const std::vector<std::string>& arguments) const {
    return test_support::tunica(arguments, folder_.path());
  }
  fs::path path(const std::string& name) const { return folder_.path() / name; }

  test_support::TemporaryFolder folder_;
};

}  // namespace

TEST_F(SweepReport, APointsCurvesAreThoseOfItsRow) {
  EXPECT_NE(read_text(path("all/report.html")).find("\"curve_points\":[]"), std::string::npos);
  const auto ended = run({"report", "all", "--point", "1"});
  ASSERT_EQ(ended.code, 0) << ended.errors;
  EXPECT_NE(read_text(path("all/report.html")).find("\"curve_points\":[1]"), std::string::npos);
  const StoredResult stored = read_result(path("all/points/1"));
  const auto& time = stored.result.observables.find("time")->values;
  const auto& pressure = stored.result.observables.find("pressure")->values;
  double largest = 0;
  for (std::size_t row = 0; row < time.size(); ++row)
    if (time[row] >= 0.8) largest = std::max(largest, pressure[row]);
  const observables::Table table = observables::read_csv(path("all/sweep.csv").string());
  // A row of output lies within half an interval of the peak, which the table finds by a parabola.
  EXPECT_NEAR(largest / table.find("pressure.max")->values[1], 1, 1e-3);
}

TEST_F(SweepReport, WhatIsNoPointOfTheSweepIsRefused) {
  for (const auto& [arguments, reason] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"report", "all", "--point", "3"}, "numbered 0 to 2"},
           {{"report", "all", "all"}, "holds a sweep"},
           {{"report", ".", "--point", "1"}, "holds no sweep"}}) {
    const auto ended = run(arguments);
    EXPECT_EQ(ended.code, 2);
    EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
    EXPECT_NE(ended.errors.find(reason), std::string::npos) << ended.errors;
  }
  EXPECT_FALSE(fs::exists(path("all/points")));
}

TEST_F(SweepReport, ASceneThatHasChangedSinceIsTold) {
  write_whole(path("scene.toml"), read_text(path("scene.toml")) + "\n[lumped]\ncompartments = 3\n");
  const auto ended = run({"report", "all", "--point", "1"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  EXPECT_NE(ended.errors.find("not the scene any more"), std::string::npos) << ended.errors;
  EXPECT_FALSE(fs::exists(path("all/points")));
}

TEST_F(SweepReport, APointOfAListHasTheScenesValueWhereItsCellIsEmpty) {
  write_whole(path("points.csv"), "outlet.resistance,tether.stiffness\n,2e7\n1.1e6,\n");
  ASSERT_EQ(run({"sweep", "scene.toml", "--quiet", "--tier", "lumped", "--points", "points.csv", "--quantity",
                 "pressure.max", "--out", "list"})
                .code,
            0);
  const auto ended = run({"report", "list", "--point", "0", "--point", "1"});
  ASSERT_EQ(ended.code, 0) << ended.errors;
  // Those of scenes/cylinder.toml beside the lists'.
  const auto scene_of = [&](const char* point) {
    const auto record = nlohmann::json::parse(read_text(path("list/points") / point / "record.json"));
    return parse_scene(record.at("scene_toml").get<std::string>(), point, folder_.path());
  };
  const Scene first = scene_of("0"), second = scene_of("1");
  EXPECT_EQ(first.number("outlet.resistance"), 1.032e6);
  EXPECT_EQ(first.number("tether.stiffness"), 2e7);
  EXPECT_EQ(second.number("outlet.resistance"), 1.1e6);
  EXPECT_EQ(second.number("tether.stiffness"), 1e7);
}
