// SPDX-License-Identifier: GPL-3.0-or-later
// `tunica calibrate` as users start it: that it finds what a run then gives, says when targets conflict, and
// refuses what makes no sense before it computes.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "core/observables/table.hpp"
#include "core/units.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using test_support::Ended;
using test_support::is_one_line;
using test_support::read_text;
using test_support::TemporaryFolder;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

namespace {

class Calibrate : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  Texts arguments(const std::string& out, const Texts& more) const {
    Texts all{"calibrate", std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml", "--out",
              path(out).string()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Ended calibrate(const std::string& out, const Texts& more) const {
    return test_support::tunica(arguments(out, more), folder_.path());
  }
  Json found(const std::string& out) const { return Json::parse(read_text(path(out) / "calibration.json")); }

  TemporaryFolder folder_;
};

const Texts keys{"--free", "outlet.resistance=5e5:2e6", "--free", "tether.stiffness=3e6:1e8"};

/// The pressures of the paper's artery and a swing of its diameter by a share of that at rest.
Texts with_targets(Texts all, const std::string& share) {
  for (const std::string& target : {std::string("pressure.max=130 mmHg"), std::string("pressure.min=75 mmHg"),
                                    "radial_displacement.P1.change=" + share + " of geometry.radius"}) {
    all.emplace_back("--target");
    all.push_back(target);
  }
  return all;
}

}  // namespace

TEST_F(Calibrate, FindsResistanceAndTetherFromAnywhere) {
  std::vector<double> resistances, stiffnesses;
  for (const char* seed : {"1", "2"}) {
    Texts all = with_targets(keys, "25 %");
    all.insert(all.end(), {"--seed", seed, "--set", "accuracy.tolerance=1e-4"});
    const Ended ended = calibrate(seed, all);
    ASSERT_EQ(ended.code, 0) << ended.errors;
    const Json json = found(seed);
    EXPECT_TRUE(json["converged"]);
    EXPECT_FALSE(json["conflict"]["conflicts"]);
    for (const Json& start : json["starts"]) EXPECT_TRUE(start["agrees"]) << start;
    resistances.push_back(json["parameters"][0]["value"]);
    stiffnesses.push_back(json["parameters"][1]["value"]);
  }
  // The places drawn are others, the answer is one, to a hundredth of its standard deviation.
  EXPECT_NEAR(resistances[0], resistances[1], 70);
  EXPECT_NEAR(stiffnesses[0], stiffnesses[1], 2e3);

  // The scene that is left gives what targets.csv says it does; pressures of output rows are below the vertex
  // of their parabola by parts in 1e5.
  const Ended run = test_support::tunica(
      {"run", (path("1") / "scene.toml").string(), "--quiet", "--no-report", "--out", path("run").string()},
      folder_.path());
  ASSERT_EQ(run.code, 0) << run.errors;
  const auto rows = observables::read_csv((path("run") / "observables.csv").string());
  const auto targets = observables::read_csv((path("1") / "targets.csv").string());
  const auto& times = rows.find("time")->values;
  const auto& pressures = rows.find("pressure")->values;
  double highest = 0;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (times[i] >= 0.8) highest = std::max(highest, pressures[i]);
  EXPECT_EQ(targets.find("quantity")->labels[0], "pressure.max");
  EXPECT_NEAR(std::stod(targets.find("reached")->labels[0]), highest, 1e-4 * highest);
  EXPECT_NEAR(highest, 130 * mmhg, 0.02 * 130 * mmhg);
  const std::string page = read_text(path("1") / "report.html");
  EXPECT_NE(page.find("outlet.resistance [dyn s/cm5]"), std::string::npos);
  EXPECT_EQ(page.find("{{"), std::string::npos);
}

TEST_F(Calibrate, SaysThatTargetsConflictAndByHowMuch) {
  const Ended ended = calibrate("conflict", with_targets(keys, "200 %"));
  ASSERT_EQ(ended.code, 0) << ended.errors;
  EXPECT_NE(ended.errors.find("the targets conflict; at the best compromise"), std::string::npos)
      << ended.errors;
  EXPECT_NE(ended.errors.find("radial_displacement.P1.change reaches"), std::string::npos) << ended.errors;
  const Json json = found("conflict");
  EXPECT_TRUE(json["conflict"]["conflicts"]);
  // A wall whose lumen opens to 3 R0 does not swing by 2 R0: it is missed by most of it.
  EXPECT_LT(json["conflict"]["targets"][2]["missed_by"], -0.5 * 2 * 0.033);
}

TEST_F(Calibrate, RefusesWhatMakesNoSenseInOneLine) {
  const Texts target{"--target", "pressure.max=130 mmHg"};
  const auto joined = [](Texts first, const Texts& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  };
  const std::vector<std::pair<Texts, std::string>> cases{
      {joined({"--free", "outlet.resistence=1:2"}, target), "did you mean outlet.resistance"},
      {joined({"--free", "outlet.resistance=2e6:1e6"}, target), "reversed"},
      {joined({"--free", "outlet.resistance=1e6:1e6"}, target), "empty"},
      {joined({"--free", "wall.law=EXP1,EXP2"}, target), "KEY=LO:HI"},
      {joined({"--free", "outlet.resistance=1 cm:2 cm"}, target), "another dimension"},
      {joined(keys, target), "2 free keys need as many targets"},
      {joined(keys, joined(target, target)), "is there twice"},
      {joined({"--free", "outlet.resistance=1e6:2e6"}, {"--target", "presure.max=1"}),
       "did you mean pressure.max"},
      {joined({"--free", "outlet.resistance=1e6:2e6", "--starts", "0"}, target), "--starts"},
      {joined({"--free", "outlet.resistance=1e6:2e6", "--seed", "-1"}, target), "--seed"},
  };
  for (const auto& [more, expected] : cases) {
    const Ended ended = calibrate("refused", more);
    EXPECT_EQ(ended.code, 2) << ended.errors;
    EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
    EXPECT_NE(ended.errors.find(expected), std::string::npos) << ended.errors;
  }
  EXPECT_FALSE(fs::exists(path("refused")));
}

TEST_F(Calibrate, KeepsWhatItHasWhenItIsInterrupted) {
  // By 2D a search takes tens of seconds.
  Texts all = arguments("stopped", with_targets(keys, "25 %"));
  all.insert(all.begin(), TUNICA_PROGRAM);
  all.insert(all.end(), {"--tier", "axisym", "--starts", "1"});
  test_support::Program program(all, folder_.path());
  for (int i = 0; i < 600 && !fs::exists(path("stopped")); ++i) ::usleep(10'000);
  ::usleep(500'000);
  program.send(SIGINT);
  EXPECT_EQ(program.wait(), 130) << program.errors();
  EXPECT_TRUE(found("stopped")["interrupted"]);
  EXPECT_FALSE(found("stopped")["converged"]);
}
