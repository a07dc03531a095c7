// SPDX-License-Identifier: GPL-3.0-or-later
// The engine of sweeps with a tier that answers at once: what a kill costs, that memory does not grow, and
// what becomes of folders in odd states.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <iostream>
#include <random>
#include <thread>

#include "core/error.hpp"
#include "tests/support/temporary_folder.hpp"
#include "verification/sweep/campaign.hpp"

using namespace tunica;
using namespace tunica::sweep;
using test_support::read_text;
using test_support::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

/// Answers every quantity with the scene's outlet resistance, and counts.
class PromptTier final : public Tier {
 public:
  explicit PromptTier(std::atomic<long>* answered = nullptr) : answered_(answered) {}
  std::string_view name() const override { return "prompt"; }
  std::string refusal(const Scene&) const override { return {}; }
  bool suits(const Scene&) const override { return true; }
  std::unique_ptr<TierRun> prepare(const Scene&) const override { throw std::logic_error("answers only"); }
  std::optional<run::Answer> answer(const Scene& scene, const run::Question& question,
                                    const RunControl&) const override {
    if (answered_) ++*answered_;
    return run::Answer{std::vector<double>(question.quantities.size(), scene.number("outlet.resistance")),
                       {}};
  }

 private:
  std::atomic<long>* answered_;
};

class SweepExecution : public testing::Test {
 protected:
  SweepSummary sweep(const std::string& name, std::uint64_t count, bool resume = false,
                     std::atomic<long>* answered = nullptr, Shard shard = {}) const {
    TierList tiers;
    tiers.push_back(std::make_unique<PromptTier>(answered));
    const run::Door door(tiers, run::SceneSource(std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml"));
    const auto points =
        sample_points({parse_axis("outlet.resistance=1e6:2e6"), parse_axis("tether.stiffness=1e6:3e7")},
                      uncertainty::Sampling::sobol, count, 0);
    run::Question question;
    question.quantities = {run::parse_quantity("pressure.max"), run::parse_quantity("von_mises.max")};
    SweepControl control;
    control.resume = resume;
    return run_sweep({door, "prompt", *points, question, shard, jobs}, path(name), control);
  }
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  std::string csv(const std::string& name) const { return read_text(path(name) / table_file); }
  std::size_t rows_in(const std::string& name) const {
    return Table(path(name) / database_file, Table::Mode::open,
                 {{"outlet.resistance", "dyn s/cm5"}, {"tether.stiffness", "dyn/cm3"}},
                 {{"pressure.max", "dyn/cm2"}, {"von_mises.max", "dyn/cm2"}})
        .points()
        .size();
  }
  static constexpr int jobs = 2;

 private:
  TemporaryFolder folder_;
};

double peak_mebibytes() {
  rusage usage{};
  EXPECT_EQ(::getrusage(RUSAGE_SELF, &usage), 0);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

std::string refusal_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_F(SweepExecution, AKillCostsThePointsInFlightAndNoMore) {
  constexpr std::uint64_t count = 10'000;
  // Counted in memory that outlives the process that is killed.
  void* const shared =
      ::mmap(nullptr, sizeof(std::atomic<long>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  auto* const answered = new (shared) std::atomic<long>(0);
  const unsigned seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937 engine(seed);
  const long enough = std::uniform_int_distribution<long>(count / 10, count / 2)(engine);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    sweep("killed", count, false, answered);
    ::_exit(0);
  }
  while (*answered < enough && ::waitpid(child, nullptr, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status)) << "it was over before it could be killed";
  const long kept = static_cast<long>(rows_in("killed"));
  EXPECT_LE(*answered - kept, 2 * jobs) << "seed " << seed;
  EXPECT_LT(kept, static_cast<long>(count));

  *answered = 0;
  EXPECT_EQ(sweep("killed", count, true, answered).done, count);
  EXPECT_EQ(*answered, static_cast<long>(count) - kept) << "what has a row is not computed again";
  sweep("undisturbed", count);
  EXPECT_TRUE(csv("killed") == csv("undisturbed"));
  ASSERT_EQ(::munmap(shared, sizeof(std::atomic<long>)), 0);
}

TEST_F(SweepExecution, MemoryDoesNotGrowWithThePoints) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "freed memory is kept apart under AddressSanitizer";
#endif
  sweep("few", 2'000);
  const double before = peak_mebibytes();
  sweep("many", 20'000);
  // 18,000 rows kept in memory would take 3 MiB at the very least, and SQLite's cache takes 2 when it fills.
  EXPECT_LT(peak_mebibytes() - before, 2.9);
}

TEST_F(SweepExecution, GoesOnFromWhateverAKillAtTheBeginningLeaves) {
  sweep("whole", 10);
  const std::string whole = csv("whole");
  const auto leave_only = [&](std::initializer_list<const char*> files) {
    for (const auto& entry : fs::directory_iterator(path("whole")))
      if (std::none_of(files.begin(), files.end(),
                       [&](const char* f) { return entry.path().filename() == f; }))
        fs::remove(entry.path());
  };
  // The campaign alone, and beside it a database that has nothing yet.
  leave_only({campaign_file});
  sweep("whole", 10, true);
  EXPECT_EQ(csv("whole"), whole);
  leave_only({campaign_file});
  std::ofstream(path("whole") / database_file).close();
  sweep("whole", 10, true);
  EXPECT_EQ(csv("whole"), whole);
  // A folder without anything: nothing to go on with is no reason not to begin.
  sweep("new", 10, true);
  EXPECT_EQ(csv("new"), whole);
}

TEST_F(SweepExecution, TellsDamageByName) {
  sweep("damaged", 10);
  const std::string before = read_text(path("damaged") / campaign_file);
  std::ofstream(path("damaged") / database_file) << std::string(5000, 'x');
  EXPECT_NE(refusal_of([&] { sweep("damaged", 10, true); }).find("not the table of a sweep"),
            std::string::npos);
  std::ofstream(path("damaged") / campaign_file) << before.substr(0, before.size() / 2);
  EXPECT_NE(refusal_of([&] { sweep("damaged", 10, true); }).find("no sweep here"), std::string::npos);
}

TEST_F(SweepExecution, AResumedTableIsOfTheSameVersion) {
  sweep("old", 10);
  auto campaign = read_campaign(path("old"));
  campaign["version"] = "0.0.9";
  std::ofstream(path("old") / campaign_file) << campaign.dump();
  EXPECT_NE(refusal_of([&] { sweep("old", 10, true); }).find("version was 0.0.9 and is "), std::string::npos)
      << refusal_of([&] { sweep("old", 10, true); });
}

TEST_F(SweepExecution, AShardIsNoPlaceForTheWhole) {
  sweep("a", 10);
  const std::string before = csv("a");
  EXPECT_NE(refusal_of([&] {
              merge({path("a"), path("b")}, path("a"), true);
            }).find("is a shard itself"),
            std::string::npos);
  EXPECT_EQ(csv("a"), before);
}

TEST_F(SweepExecution, WhatAShardHasIsInItsTable) {
  sweep("part1", 11, false, nullptr, {1, 2});
  sweep("part2", 11, false, nullptr, {2, 2});
  sweep("whole", 11);
  // The campaign of a sweep that was killed at its end counts fewer points than there are rows.
  auto campaign = read_campaign(path("part1"));
  campaign["counts"]["done"] = 0;
  std::ofstream(path("part1") / campaign_file) << campaign.dump();
  EXPECT_EQ(merge({path("part1"), path("part2")}, path("merged"), false).done, 11U);
  EXPECT_EQ(csv("merged"), csv("whole"));
  fs::remove(path("part2") / database_file);
  EXPECT_THROW(merge({path("part1"), path("part2")}, path("again"), false), OutputFailure);
  EXPECT_FALSE(fs::exists(path("part2") / database_file)) << "a shard is not made by looking at it";
  EXPECT_FALSE(fs::exists(path("again")));
}

// Quantities alone are handed over in a fraction of the time that they take with their gradients.
TEST_F(SweepExecution, ATableIsReadAsFarAsItIsAskedFor) {
  const std::vector<Varied> keys{{"outlet.resistance", "dyn s/cm5"}};
  const std::vector<NumberColumn> numbers{{"pressure.max", "dyn/cm2"},
                                          {"von_mises.max", "dyn/cm2"},
                                          {"d(pressure.max)/d(outlet.resistance)", "cm3/s"}};
  fs::create_directories(path("of rows"));
  Table table(path("of rows") / database_file, Table::Mode::create, keys, numbers);
  for (const std::uint64_t point : {7U, 3U})
    table.insert({point, "done", "", "prompt", 0.5, {"1e6"}, {1.5, observables::none, 2.5}});
  for (std::size_t first = 0; first <= numbers.size(); ++first) {
    std::vector<std::uint64_t> points;
    table.each(
        [&](const Row& row) {
          points.push_back(row.point);
          ASSERT_EQ(row.numbers.size(), first);
          EXPECT_EQ(row.tier, "prompt");
          EXPECT_EQ(row.keys.size(), 1U);
          if (first > 0) {
            EXPECT_EQ(row.numbers[0], 1.5);
          }
          if (first > 1) {
            EXPECT_TRUE(observables::is_none(row.numbers[1]));
          }
          if (first > 2) {
            EXPECT_EQ(row.numbers[2], 2.5);
          }
        },
        first);
    EXPECT_EQ(points, (std::vector<std::uint64_t>{3, 7}));
  }
}

// The compliance belongs to one kind of outlet: points of the other have none, here and in the table.
TEST_F(SweepExecution, KeysMayActOnSomePointsOnly) {
  TierList tiers;
  tiers.push_back(std::make_unique<PromptTier>());
  const run::Door door(tiers, run::SceneSource(std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml"));
  fs::create_directory(path("list"));
  std::ofstream(path("list") / "points.csv")
      << "outlet.kind,outlet.compliance,outlet.resistance\nresistance,,1e6\nrcr,2e-8,1e6\nrcr,,\n";
  const auto points = list_points(path("list") / "points.csv");
  const run::Question question{{run::parse_quantity("pressure.max")}, {}};
  EXPECT_EQ(run_sweep({door, "prompt", *points, question, {}, jobs}, path("list"), {}).done, 3U);
  std::ifstream table(path("list") / table_file);
  std::string line;
  for (const char* keys :
       {"outlet.compliance[cm5/dyn]", ",resistance,,1000000,", ",rcr,2e-08,1000000,", ",rcr,,,"}) {
    std::getline(table, line);
    EXPECT_NE(line.find(keys), std::string::npos) << line;
  }

  std::ofstream(path("list") / "points.csv") << "outlet.kind,outlet.compliance\nresistance,2e-8\n";
  const auto useless = list_points(path("list") / "points.csv");
  EXPECT_THROW(run_sweep({door, "prompt", *useless, question, {}, jobs}, path("useless"), {}), InvalidInput);
}

TEST_F(SweepExecution, RefusedPointsAtTheBeginningDoNotRefuseTheSweep) {
  TierList tiers;
  tiers.push_back(std::make_unique<PromptTier>());
  const run::Door door(tiers, run::SceneSource(std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml"));
  std::string file = "outlet.resistance\n";
  for (int k = 0; k < 100; ++k) file += "-1\n";
  for (int k = 0; k < 100; ++k) file += "1e6\n";
  fs::create_directory(path("list"));
  std::ofstream(path("list") / "points.csv") << file;
  const auto points = list_points(path("list") / "points.csv");
  const SweepSummary summary = run_sweep(
      {door, "prompt", *points, {{run::parse_quantity("pressure.max")}, {}}, {}, jobs}, path("list"), {});
  EXPECT_EQ(summary.refused, 100U);
  EXPECT_EQ(summary.done, 100U);
}

TEST_F(SweepExecution, AKeyMayActOnAFewPointsOfALongList) {
  TierList tiers;
  tiers.push_back(std::make_unique<PromptTier>());
  const run::Door door(tiers, run::SceneSource(std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml"));
  fs::create_directory(path("list"));
  const run::Question question{{run::parse_quantity("pressure.max")}, {}};
  // Whichever points are looked at first, most of these are not.
  for (const int place : {1, 7, 499, 998}) {
    std::string file = "outlet.kind,outlet.compliance,outlet.resistance\n";
    for (int k = 0; k < 1000; ++k) file += k == place ? "rcr,2e-8,1e6\n" : ",,1e6\n";
    std::ofstream(path("list") / "points.csv") << file;
    const auto points = list_points(path("list") / "points.csv");
    SweepControl control;
    control.replace = true;
    EXPECT_EQ(run_sweep({door, "prompt", *points, question, {}, jobs}, path("list"), control).done, 1000U)
        << place;
  }
}
