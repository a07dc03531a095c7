// SPDX-License-Identifier: GPL-3.0-or-later
// `tunica sweep` as users start it: what it writes, and what becomes of it when it is killed, split,
// repeated, or asked for what makes no sense.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

#include "core/observables/result.hpp"
#include "core/observables/table.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using test_support::Ended;
using test_support::is_one_line;
using test_support::read_text;
using test_support::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

using Texts = std::vector<std::string>;

class Sweep : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string csv(const std::string& name) const { return read_text(folder_.path() / name / "sweep.csv"); }

  Texts arguments(const std::string& out, Texts more) const {
    Texts all{"sweep",
              std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml",
              "--quiet",
              "--tier",
              "lumped",
              "--quantity",
              "pressure.max",
              "--quantity",
              "recruitment.P1.on",
              "--out",
              path(out)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Ended sweep(const std::string& out, Texts more) const {
    return test_support::tunica(arguments(out, std::move(more)), folder_.path());
  }
  observables::Table table(const std::string& name) const { return observables::parse_csv(csv(name), name); }

  TemporaryFolder folder_;
};

const Texts grid{"--vary", "outlet.resistance=6e5:1.2e6:4", "--vary", "tether.stiffness=5e6:2e7:3:log"};
const Texts many{
    "--vary", "outlet.resistance=6e5:1.2e6", "--vary", "tether.stiffness=5e6:2e7:log", "--sample", "lhs:400"};

Texts joined(Texts first, const Texts& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

TEST_F(Sweep, TabulatesEveryPointOfAGrid) {
  const Ended ended = sweep("grid", grid);
  ASSERT_EQ(ended.code, 0) << ended.errors;
  const std::string text = csv("grid");
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "point,status,reason,tier,seconds[s],outlet.resistance[dyn s/cm5],tether.stiffness[dyn/cm3],"
            "pressure.max[dyn/cm2],recruitment.P1.on[s]");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 13);
  // A point is what a run of it alone gives.
  ASSERT_EQ(test_support::tunica({"run", std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml", "--quiet",
                                  "--tier", "lumped", "--no-report", "--set", "outlet.resistance=1.2e6",
                                  "--set", "tether.stiffness=1e7", "--out", path("one")})
                .code,
            0);
  const auto run = observables::read_csv(path("one/observables.csv"));
  const auto& time = run.find("time")->values;
  const auto& pressure = run.find("pressure")->values;
  double greatest = 0;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (time[k] >= 0.8 - 1e-9) greatest = std::max(greatest, pressure[k]);
  const double swept = table("grid").find("pressure.max")->values.at(10);
  // Rows of a millisecond miss the peak by some 1e-6 of it; the two may step differently, within the
  // tolerance.
  EXPECT_NEAR(swept, greatest, 2e-3 * greatest);
  EXPECT_TRUE(fs::exists(path("grid/sweep.db")));
  EXPECT_FALSE(fs::exists(path("grid/sweep.db-wal"))) << "the log is folded in at the end";
}

TEST_F(Sweep, IsTheSameWhateverItsJobs) {
  ASSERT_EQ(sweep("one", joined(grid, {"--jobs", "1"})).code, 0);
  ASSERT_EQ(sweep("three", joined(grid, {"--jobs", "3"})).code, 0);
  EXPECT_EQ(csv("one"), csv("three"));
}

TEST_F(Sweep, ShardsMakeTheWhole) {
  ASSERT_EQ(sweep("whole", grid).code, 0);
  for (const char* part : {"1", "2", "3"})
    ASSERT_EQ(sweep(std::string("part") + part, joined(grid, {"--shard", std::string(part) + "/3"})).code, 0);
  const auto merge = [&](const Texts& parts, const std::string& out) {
    Texts all{"sweep", "--quiet", "--out", path(out), "--merge"};
    for (const std::string& part : parts) all.push_back(path(part));
    return test_support::tunica(all, folder_.path());
  };
  const Ended merged = merge({"part3", "part1", "part2"}, "merged");
  ASSERT_EQ(merged.code, 0) << merged.errors;
  EXPECT_EQ(csv("merged"), csv("whole"));

  // More parts than points: those that have none are done, too, and belong to the whole.
  const Texts two{"--vary", "outlet.resistance=6e5:1.2e6:2"};
  ASSERT_EQ(sweep("two", two).code, 0);
  for (const char* part : {"1", "2", "3"}) {
    const Ended ended =
        sweep(std::string("of-two") + part, joined(two, {"--shard", std::string(part) + "/3"}));
    ASSERT_EQ(ended.code, 0) << ended.errors;
  }
  ASSERT_EQ(merge({"of-two1", "of-two2", "of-two3"}, "merged-two").code, 0);
  EXPECT_EQ(csv("merged-two"), csv("two"));

  for (const auto& [parts, why] :
       std::vector<std::pair<Texts, std::string>>{{{"part1", "part3"}, "shard 2/3 is missing"},
                                                  {{"part1", "part1", "part2"}, "both shard 1/3"},
                                                  {{"part1", "whole"}, "do not fit"},
                                                  {{"part1", "nothing"}, "no sweep here"}}) {
    const Ended refused = merge(parts, "refused");
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(is_one_line(refused.errors));
    EXPECT_NE(refused.errors.find(why), std::string::npos) << refused.errors;
    EXPECT_FALSE(fs::exists(path("refused")));
  }
  ASSERT_EQ(sweep("other", joined({"--vary", "outlet.resistance=6e5:1.2e6:5"}, {"--shard", "2/3"})).code, 0);
  EXPECT_NE(merge({"part1", "other", "part3"}, "refused").errors.find("what varies differs"),
            std::string::npos);
}

TEST_F(Sweep, IsAShardByItselfInASlurmArray) {
  ASSERT_EQ(sweep("whole", grid).code, 0);
  for (const char* task : {"11", "13"}) {
    const auto environment = [task] {
      ::setenv("SLURM_ARRAY_TASK_ID", task, 1);
      ::setenv("SLURM_ARRAY_TASK_COUNT", "2", 1);
      ::setenv("SLURM_ARRAY_TASK_MIN", "11", 1);
      ::setenv("SLURM_ARRAY_TASK_STEP", "2", 1);
    };
    ASSERT_EQ(test_support::tunica(arguments("array", grid), folder_.path(), environment).code, 0);
  }
  ASSERT_EQ(test_support::tunica({"sweep", "--quiet", "--out", path("merged"), "--merge",
                                  path("array/shard-1-of-2"), path("array/shard-2-of-2")})
                .code,
            0);
  EXPECT_EQ(csv("merged"), csv("whole"));
}

TEST_F(Sweep, TheSlurmScriptRunsATaskAndGoesOn) {
  ASSERT_EQ(sweep("whole", grid).code, 0);
  const auto run_task = [&](const std::string& task) {
    Texts all{std::string(TUNICA_SOURCE_DIR) + "/tools/sweep-array.sbatch", path("array")};
    const Texts own = arguments("unused", grid);
    // Without the command's name and with another folder.
    for (std::size_t k = 1; k < own.size(); ++k)
      if (own[k] == "--out")
        ++k;
      else
        all.push_back(own[k]);
    test_support::Program script(all, folder_.path(), [&] {
      ::setenv("TUNICA", TUNICA_PROGRAM, 1);
      ::setenv("SLURM_ARRAY_TASK_ID", task.c_str(), 1);
      ::setenv("SLURM_ARRAY_TASK_COUNT", "2", 1);
      ::setenv("SLURM_ARRAY_TASK_MIN", "1", 1);
      ::setenv("SLURM_CPUS_PER_TASK", "2", 1);
      // The first of the tasks of srun and any other compute alike.
      ::setenv("SLURM_PROCID", "1", 1);
      ::setenv("PMI_RANK", "1", 1);
      ::setenv("PMI_SIZE", "2", 1);
    });
    const int code = script.wait();
    EXPECT_EQ(code, 0) << script.errors();
  };
  for (const char* task : {"1", "2", "2"}) run_task(task);
  ASSERT_EQ(test_support::tunica({"sweep", "--quiet", "--out", path("merged"), "--merge",
                                  path("array/shard-1-of-2"), path("array/shard-2-of-2")})
                .code,
            0);
  EXPECT_EQ(csv("merged"), csv("whole"));
}

TEST_F(Sweep, KilledItGoesOnToTheSameTable) {
  ASSERT_EQ(sweep("undisturbed", many).code, 0);
  {
    Texts all{TUNICA_PROGRAM};
    test_support::Program program(joined(all, arguments("killed", many)), folder_.path());
    const fs::path database = path("killed/sweep.db-wal");
    std::error_code not_there;
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (program.running() && std::chrono::steady_clock::now() < give_up) {
      const auto size = fs::file_size(database, not_there);
      if (!not_there && size > 30'000) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ASSERT_TRUE(program.running()) << "it was over before it could be killed";
    program.send(SIGKILL);
    program.wait();
  }
  EXPECT_FALSE(fs::exists(path("killed/sweep.csv")));
  const Ended again = sweep("killed", many);
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.errors.find("--resume goes on"), std::string::npos) << again.errors;
  const Ended resumed = sweep("killed", joined(many, {"--resume"}));
  ASSERT_EQ(resumed.code, 0) << resumed.errors;
  EXPECT_EQ(csv("killed"), csv("undisturbed"));
}

TEST_F(Sweep, InterruptedItSaysSoAndGoesOn) {
  Texts all{TUNICA_PROGRAM};
  test_support::Program program(joined(all, arguments("stopped", many)), folder_.path());
  std::error_code not_there;
  for (int k = 0;
       k < 10'000 && !(fs::file_size(path("stopped/sweep.db-wal"), not_there) > 30'000 && !not_there); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  program.send(SIGINT);
  EXPECT_EQ(program.wait(), 130);
  EXPECT_NE(program.errors().find("--resume goes on"), std::string::npos) << program.errors();
  EXPECT_GT(table("stopped").rows(), 0U);
  EXPECT_LT(table("stopped").rows(), 400U);
  ASSERT_EQ(sweep("stopped", joined(many, {"--resume"})).code, 0);
  ASSERT_EQ(sweep("undisturbed", many).code, 0);
  EXPECT_EQ(csv("stopped"), csv("undisturbed"));
}

TEST_F(Sweep, ResumesNothingButItself) {
  ASSERT_EQ(sweep("out", grid).code, 0);
  // All points are there: nothing is computed, the table stays.
  const std::string before = csv("out");
  ASSERT_EQ(sweep("out", joined(grid, {"--resume"})).code, 0);
  EXPECT_EQ(csv("out"), before);
  for (const auto& [more, why] : std::vector<std::pair<Texts, std::string>>{
           {joined(grid, {"--set", "geometry.radius=0.04"}), "geometry.radius was 0.033 and is 0.04"},
           {joined(grid, {"--quantity", "pressure.min"}), "the list of quantities was"},
           {{"--vary", "outlet.resistance=6e5:1.2e6:3"}, "what varies differs"},
           {joined(grid, {"--shard", "1/2"}), "holds shard 1/1, not 1/2"}}) {
    const Ended refused = sweep("out", joined(more, {"--resume"}));
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.errors.find(why), std::string::npos) << refused.errors;
    EXPECT_EQ(csv("out"), before);
  }
  ASSERT_EQ(sweep("out", {"--vary", "outlet.resistance=6e5:1.2e6:3", "--replace"}).code, 0);
  EXPECT_NE(csv("out"), before);
}

TEST_F(Sweep, APointThatFailsIsARow) {
  // Of so soft a wall without a tether the higher pressures have no equilibrium.
  const Ended ended = sweep("soft", {"--set", "wall.law=neo-Hookean", "--set", "wall.stiffness=2e5", "--set",
                                     "tether.stiffness=0", "--vary", "outlet.resistance=1e5:2e6:3"});
  ASSERT_EQ(ended.code, 0) << ended.errors;
  const std::string text = csv("soft");
  EXPECT_NE(text.find("\n0,done,,lumped"), std::string::npos) << text;
  EXPECT_NE(text.find("\n2,gave-up,"), std::string::npos) << text;
  EXPECT_NE(text.find("at t ="), std::string::npos) << text;
  // None with a result.
  EXPECT_EQ(sweep("none", {"--set", "wall.law=neo-Hookean", "--set", "wall.stiffness=2e5", "--set",
                           "tether.stiffness=0", "--vary", "outlet.resistance=2e6:3e6:2"})
                .code,
            3);
  EXPECT_NE(csv("none").find("gave-up"), std::string::npos);
}

TEST_F(Sweep, KeepsRunsWhenAsked) {
  ASSERT_EQ(sweep("kept", {"--vary", "outlet.resistance=6e5:1.2e6:2", "--keep-runs"}).code, 0);
  ASSERT_EQ(sweep("lean", {"--vary", "outlet.resistance=6e5:1.2e6:2"}).code, 0);
  EXPECT_TRUE(fs::exists(path("kept/points/1/observables.csv")));
  EXPECT_FALSE(fs::exists(path("lean/points")));
}

TEST_F(Sweep, RefusesWhatMakesNoSense) {
  for (const auto& [more, why] : std::vector<std::pair<Texts, std::string>>{
           {{}, "say what varies"},
           {{"--vary", "outlet.resistance=2e6:1e6:3"}, "reversed"},
           {{"--vary", "outlet.resistance=1e6:1e6:3"}, "empty"},
           {{"--vary", "outlet.resistance=1e6:2e6:1"}, "at least 2"},
           {{"--vary", "outlet.resistence=1e6:2e6:3"}, "did you mean outlet.resistance?"},
           {{"--vary", "outlet.resistance=-1e6:2e6:3"}, "is not allowed"},
           {{"--vary", "outlet.resistance=1e6:2e6"}, "--sample"},
           {{"--vary", "outlet.resistance=1e6:2e6", "--sample", "sobol:0"}, "1 or more"},
           {{"--vary", "outlet.resistance=normal(1e6, 1e6)", "--sample", "sobol:8"}, "leaves the range"},
           {{"--vary", "geometry.bend_angle=90:180:2"}, "geometry.bend_angle is not used"},
           {{"--vary", "outlet.resistance=1e6:2e6:3", "--shard", "3/2"}, "--shard"},
           {{"--vary", "wall.law=EXP1,EXP3"}, "\"EXP3\" is none of EXP1"},
           {{"--vary", "time.beats=1:2:3"}, "takes whole numbers, not 1.5"},
           {{"--vary", "wall.layers[0].fraction=0.2:0.4:2"}, "it has 0 [[wall.layers]]"},
           {{"--vary", "outlet.resistance=1e6:2e6", "--sample", "lhs:3", "--seed", "-1"}, "--seed"},
           {{"--vary", "outlet.resistance=1e6:2e6", "--sample", "lhs:3", "--seed", "99999999999999999999"},
            "from 0 to 18446744073709551615"},
           {{"--vary", "accuracy.tolerance=1e-3:1e-2:2", "--gradients"},
            "no derivatives by accuracy.tolerance"},
           {{"--vary", "outlet.resistance=1e6:2e6:3", "--jobs", "100000"}, "from 1 to 1024"},
           {{"--vary", "outlet.resistance=1 mmHg:2e6:3"}, "another dimension"},
           {{"--vary", "outlet.resistance=1e6:2e6:3", "--quantity", "pressure.mx"},
            "did you mean pressure.max?"},
           {{"--vary", "outlet.resistance=1e6:2e6:3", "--points", "x.csv"}, "say what varies"},
           {{"--points", path("none.csv")}, "none.csv"}}) {
    const Ended refused = sweep("refused", more);
    EXPECT_EQ(refused.code, 2) << refused.errors;
    EXPECT_TRUE(is_one_line(refused.errors)) << refused.errors;
    EXPECT_NE(refused.errors.find(why), std::string::npos) << refused.errors;
    EXPECT_FALSE(fs::exists(path("refused"))) << why;
  }
}

TEST_F(Sweep, AFullDiskLosesNothing) {
  // Files of at most 200,000 bytes: the table fills them.
  const auto limit = [] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit most{200'000, 200'000};
    ::setrlimit(RLIMIT_FSIZE, &most);
  };
  const Ended full = test_support::tunica(arguments("full", joined(many, {"--quantity", "von_mises.max"})),
                                          folder_.path(), limit);
  EXPECT_EQ(full.code, 2) << full.errors;
  EXPECT_NE(full.errors.find("sweep.db"), std::string::npos) << full.errors;
  const Ended resumed = sweep("full", joined(many, {"--quantity", "von_mises.max", "--resume"}));
  ASSERT_EQ(resumed.code, 0) << resumed.errors;
  EXPECT_EQ(table("full").rows(), 400U);
}

TEST_F(Sweep, OneSweepIsAtWorkInAFolder) {
  Texts all{TUNICA_PROGRAM};
  test_support::Program program(joined(all, arguments("busy", many)), folder_.path());
  while (program.running() && !fs::exists(path("busy/sweep.db")))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const Ended refused = sweep("busy", joined(many, {"--resume"}));
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(is_one_line(refused.errors)) << refused.errors;
  EXPECT_NE(refused.errors.find("another run is at work"), std::string::npos) << refused.errors;
  program.send(SIGKILL);
  program.wait();
}

// Some other program, such as a viewer of databases, writes to the table and does not end.
TEST_F(Sweep, ATableThatAnotherProgramLocksIsToldOf) {
  ASSERT_EQ(sweep("locked", grid).code, 0);
  const std::string before = csv("locked");
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(path("locked/sweep.db").c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "DELETE FROM sweep WHERE point = 3", nullptr, nullptr, nullptr), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  const Ended refused = sweep("locked", joined(grid, {"--resume"}));
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(is_one_line(refused.errors)) << refused.errors;
  EXPECT_NE(refused.errors.find("another program keeps the table locked"), std::string::npos)
      << refused.errors;
  ASSERT_EQ(sqlite3_exec(other, "ROLLBACK", nullptr, nullptr, nullptr), SQLITE_OK);
  ASSERT_EQ(sqlite3_close(other), SQLITE_OK);
  ASSERT_EQ(sweep("locked", joined(grid, {"--resume"})).code, 0);
  EXPECT_EQ(csv("locked"), before);
}

// The pressure's maximum is the resistance's doing, and the tether governs how far the lumen opens; shards
// make the same table, and a width that is asked for is reached by growing the sample.
TEST_F(Sweep, IndicesSayWhatGoverns) {
  const Texts sample{
      "--vary",   "outlet.resistance=5e5:2e6", "--vary", "tether.stiffness=3e6:3e7", "--sample", "sobol:64",
      "--indices"};
  ASSERT_EQ(sweep("whole", sample).code, 0);
  const std::string indices = read_text(path("whole/indices.csv"));
  EXPECT_EQ(indices.substr(0, indices.find('\n')),
            "quantity,parameter,first,first_low,first_high,total,total_low,total_high");
  const auto value = [&](const std::string& row, int column) {
    std::size_t at = indices.find('\n' + row) + 1;
    for (int k = 0; k < column; ++k) at = indices.find(',', at) + 1;
    return std::stod(indices.substr(at));
  };
  EXPECT_GT(value("pressure.max,outlet.resistance", 5), 0.9);
  EXPECT_LT(value("pressure.max,tether.stiffness", 5), 0.1);
  EXPECT_LT(value("pressure.max,outlet.resistance", 3), value("pressure.max,outlet.resistance", 4));
  EXPECT_EQ(table("whole").rows(), 64U * 4);

  for (const char* part : {"1", "2"})
    ASSERT_EQ(sweep(std::string("part") + part, joined(sample, {"--shard", std::string(part) + "/2"})).code,
              0);
  ASSERT_EQ(test_support::tunica(
                {"sweep", "--quiet", "--out", path("merged"), "--merge", path("part1"), path("part2")})
                .code,
            0);
  EXPECT_EQ(read_text(path("merged/indices.csv")), indices);

  ASSERT_EQ(sweep("until", joined(sample, {"--until", "0.5"})).code, 0);
  const auto grown = table("until").rows();
  EXPECT_GT(grown, 64U * 4);
  // What it has grown to is the same as if it had been asked for.
  Texts all = sample;
  all[5] = "sobol:" + std::to_string(grown / 4);
  ASSERT_EQ(sweep("at once", all).code, 0);
  EXPECT_EQ(csv("until"), csv("at once"));
  EXPECT_EQ(read_text(path("until/indices.csv")), read_text(path("at once/indices.csv")));

  // Nor does it shrink where less would do now.
  ASSERT_EQ(sweep("until", joined(sample, {"--until", "1.5", "--resume"})).code, 0);
  EXPECT_EQ(csv("until"), csv("at once"));
  EXPECT_EQ(read_text(path("until/indices.csv")), read_text(path("at once/indices.csv")));

  // Too few groups for an interval are no reason to stop.
  all[5] = "sobol:2";
  ASSERT_EQ(sweep("few", joined(all, {"--until", "1.5"})).code, 0);
  EXPECT_GT(table("few").rows(), 4U * 4);
  EXPECT_EQ(read_text(path("few/indices.csv")).find(",,"), std::string::npos);

  for (const auto& [more, why] : std::vector<std::pair<Texts, std::string>>{
           {{"--vary", "outlet.resistance=1e6:2e6:3", "--indices"}, "--sample sobol:N"},
           {{"--vary", "outlet.resistance=1e6:2e6", "--sample", "lhs:8", "--indices", "--until", "0.1"},
            "does not grow"},
           {{"--vary", "outlet.resistance=1e6:2e6", "--sample", "sobol:8", "--until", "0.1"}, "--indices"},
           {{"--vary", "outlet.resistance=1e6:2e6", "--sample", "sobol:8", "--indices", "--until", "-1"},
            "above 0"},
           {{"--vary", "outlet.resistance=1e6:2e6", "--sample", "sobol:8", "--indices", "--until", "0"},
            "above 0"},
           {{"--vary", "outlet.resistance=1e6:2e6", "--sample", "sobol:8", "--indices", "--until", "nan"},
            "above 0"},
           {{"--vary", "outlet.resistance=1e6:2e6", "--sample", "sobol:8", "--indices", "--until", "inf"},
            "above 0"},
           {{"--vary", "outlet.resistance=1e6:2e6", "--sample", "sobol:8", "--indices", "--until", ""},
            "above 0"}}) {
    const Ended refused = sweep("refused", more);
    EXPECT_EQ(refused.code, 2) << refused.errors;
    EXPECT_FALSE(fs::exists(path("refused"))) << why;
    EXPECT_NE(refused.errors.find(why), std::string::npos) << refused.errors;
  }
}

// The derivative at the middle of three points against the difference of the outer ones. What is left is of
// second order in the step of 0.1 %, and the tolerance of the integration.
TEST_F(Sweep, GradientsAreThoseOfTheTable) {
  // Differences of a thousandth show the steps of looser tolerances.
  ASSERT_EQ(sweep("slope", {"--vary", "outlet.resistance=0.999e6:1.001e6:3", "--gradients", "--set",
                            "accuracy.tolerance=1e-7"})
                .code,
            0);
  const auto found = table("slope");
  for (const std::string quantity : {"pressure.max", "recruitment.P1.on"}) {
    const auto& values = found.find(quantity)->values;
    const auto* slope = found.find("d(" + quantity + ")/d(outlet.resistance)");
    ASSERT_NE(slope, nullptr) << csv("slope");
    const double difference = (values[2] - values[0]) / 2e3;
    EXPECT_NEAR(slope->values[1], difference, 1e-3 * std::abs(difference)) << quantity;
  }
}

// Where one key chooses which others count, a point has the derivatives that a run of it alone has.
TEST_F(Sweep, GradientsAreEmptyWhereAKeyDoesNotAct) {
  const std::string heads = "outlet.kind,outlet.compliance,outlet.proximal_resistance,outlet.resistance\n";
  const std::string rcr = "rcr,1e-7,1e5,1.1e6\n";
  write_whole(path("both.csv"), heads + "resistance,,,1e6\n" + rcr);
  write_whole(path("rcr.csv"), heads + rcr);
  for (const Texts& more : {Texts{}, Texts{"--keep-runs"}}) {
    const Texts how = joined({"--gradients", "--replace"}, more);
    const Ended ended = sweep("both", joined({"--points", path("both.csv")}, how));
    ASSERT_EQ(ended.code, 0) << ended.errors;
    ASSERT_EQ(sweep("rcr", joined({"--points", path("rcr.csv")}, how)).code, 0);
    const auto both = table("both"), alone = table("rcr");
    for (const char* key : {"outlet.compliance", "outlet.proximal_resistance", "outlet.resistance"}) {
      const std::string name = std::string("d(pressure.max)/d(") + key + ')';
      ASSERT_NE(both.find(name), nullptr) << csv("both");
      EXPECT_EQ(both.find(name)->values[1], alone.find(name)->values[0]) << name;
      EXPECT_NE(alone.find(name)->values[0], 0) << name;
      EXPECT_EQ(observables::is_none(both.find(name)->values[0]), key != std::string("outlet.resistance"))
          << name;
    }
    EXPECT_GT(both.find("pressure.max")->values[0], 1e5);
  }
}
