// SPDX-License-Identifier: GPL-3.0-or-later
// The run door: a case that fails is an outcome, a whole result is taken and not computed again, a process of
// its own is as good as the tier in this one.
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "core/error.hpp"
#include "core/run/door.hpp"
#include "core/run/process.hpp"
#include "core/threads.hpp"
#include "tests/support/fake_tier.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using run::Case;
using run::Door;
using run::Ending;
using run::SceneSource;
using test_support::FakeTier;
using test_support::TemporaryFolder;

namespace {

std::atomic<int> computed = 0;

/// One beat whose pressure is the outlet's resistance throughout; gives up from 2e6 on.
Result answer(const Scene& scene, const RunControl& control) {
  ++computed;
  const double resistance = scene.number("outlet.resistance");
  Result result;
  result.observables = observables::standard_table();
  result.record.interrupted = control.interrupted();
  result.record.converged = !result.record.interrupted && resistance < 2e6;
  if (resistance >= 2e6) result.record.failure = "at t = 0.4 s (beat 1): the test asks for it";
  const double end = result.record.converged ? scene.number("inlet.period") : 0.4;
  for (const double time : {0.0, 0.5 * end, end}) {
    observables::Sample row;
    row.time = time;
    row.pressure = resistance;
    observables::append(result.observables, row);
  }
  return result;
}

class RunDoor : public testing::Test {
 protected:
  RunDoor() {
    computed = 0;
    tiers_.push_back(std::make_unique<FakeTier>("fake", answer, [](const Scene& scene) {
      return scene.text("geometry.kind") == "torus" ? std::string("no bends") : std::string();
    }));
  }
  Door door(run::DoorOptions options = {}) const {
    return {tiers_, SceneSource(std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml", {"time.beats=1"}),
            std::move(options)};
  }
  static run::Question pressure() { return {{run::parse_quantity("pressure.max")}, {}}; }

  TierList tiers_;
  TemporaryFolder folder_;
};

}  // namespace

TEST_F(RunDoor, AnswersACaseWithItsOverrides) {
  const auto outcome = door().ask({"auto", {"outlet.resistance=1.5e6"}}, pressure());
  EXPECT_EQ(outcome.ending, Ending::done) << outcome.reason;
  EXPECT_EQ(outcome.tier, "fake");
  EXPECT_EQ(outcome.answer.values.at(0), 1.5e6);
  EXPECT_NEAR(outcome.time, 0.8, 1e-12);
}

TEST_F(RunDoor, MakesAnOutcomeOfEveryFailure) {
  const auto gave_up = door().ask({"auto", {"outlet.resistance=3e6"}}, pressure());
  EXPECT_EQ(gave_up.ending, Ending::gave_up);
  EXPECT_EQ(gave_up.reason, "at t = 0.4 s (beat 1): the test asks for it");
  EXPECT_EQ(gave_up.time, 0.4);
  EXPECT_TRUE(gave_up.answer.values.empty());

  EXPECT_EQ(door().ask({"auto", {"outlet.resistence=1"}}, pressure()).ending, Ending::refused);
  EXPECT_EQ(door().ask({"fake", {"geometry.kind=torus"}}, pressure()).ending, Ending::refused);
  EXPECT_EQ(door().compute({"of another name"}).ending, Ending::refused);

  RunControl control;
  control.interrupted = [] { return true; };
  EXPECT_EQ(door().ask({}, pressure(), control).ending, Ending::interrupted);
}

TEST_F(RunDoor, KeepsWhatItComputesAndTakesItFromThere) {
  run::Keep keep;
  keep.folder = folder_.path() / "out";
  int beside = 0;
  keep.beside = [&](const auto& folder, const Result&) { beside += folder == keep.folder; };
  for (int time = 0; time < 2; ++time) {
    const auto outcome = door().compute({}, keep);
    ASSERT_EQ(outcome.ending, Ending::done) << outcome.reason;
    EXPECT_EQ(run::answer_of(*outcome.stored, pressure()).values[0], 1.032e6);
  }
  EXPECT_EQ(computed, 1);
  EXPECT_EQ(beside, 1);
  // What gave up is computed anew.
  keep.folder = folder_.path() / "other";
  for (int time = 0; time < 2; ++time)
    EXPECT_EQ(door().compute({"fake", {"outlet.resistance=3e6"}}, keep).ending, Ending::gave_up);
  EXPECT_EQ(computed, 3);
}

TEST_F(RunDoor, CachesByWhatDecidesTheResult) {
  run::DoorOptions options;
  options.cache = folder_.path();
  const Door cached = door(options);
  for (int time = 0; time < 2; ++time)
    for (const char* resistance : {"1e6", "1.1e6"})
      ASSERT_EQ(cached.compute({"auto", {std::string("outlet.resistance=") + resistance}}).ending,
                Ending::done);
  EXPECT_EQ(computed, 2);
  // The same number written otherwise, and named by its tier.
  ASSERT_EQ(cached.compute({"fake", {"outlet.resistance=1000000.0"}}).ending, Ending::done);
  EXPECT_EQ(computed, 2);
}

TEST_F(RunDoor, BearsManyThreads) {
  const Door shared = door();
  std::atomic<int> right = 0;
  for_each_index(8, 64, [&](int k) {
    const double resistance = 1e6 + k;
    const auto outcome =
        shared.ask({"auto", {"outlet.resistance=" + std::to_string(resistance)}}, pressure());
    right += outcome.ending == Ending::done && outcome.answer.values[0] == resistance;
  });
  EXPECT_EQ(right, 64);
}

TEST(RunProcess, TellsHowItEnded) {
  const auto never = [] { return false; };
  EXPECT_EQ(run::run_process({"true"}, never).exit_code, 0);
  const auto ended = run::run_process({"sh", "-c", "echo first >&2; echo last words >&2; exit 3"}, never);
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_EQ(ended.complaint, "last words");
  // As mpirun has it.
  EXPECT_EQ(run::run_process({"sh", "-c", "printf -- '----\\nno slots\\n----\\n' >&2"}, never).complaint,
            "no slots");
  EXPECT_EQ(run::run_process({"sh", "-c", "kill -9 $$"}, never).signal, SIGKILL);
  EXPECT_THROW(run::run_process({"/no/such/program"}, never), InvalidInput);
  const auto busy =
      run::run_process({"sh", "-c", "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done"}, never);
  EXPECT_GT(busy.cpu_seconds, 0.01);
  EXPECT_GT(busy.wall_seconds, 0.5 * busy.cpu_seconds);
  EXPECT_GT(busy.mebibytes, 0.1);
}

TEST(RunProcess, IsAskedToStopOnce) {
  const TemporaryFolder folder;
  const auto ready = folder.path() / "ready";
  const std::string script = "n=0; trap 'n=$((n+1)); [ $n = 1 ] && sleep 0.2; exit $n' INT; touch " +
                             ready.string() + "; sleep 20 & wait";
  const auto ended = run::run_process({"sh", "-c", script}, [&] { return std::filesystem::exists(ready); });
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_LT(ended.wall_seconds, 10);
}
