// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that are interrupted, killed or give up, and go on: with a tier that is small, but whose every later
// value hangs on every bit of the earlier ones.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <random>

#include "core/error.hpp"
#include "core/observables/record.hpp"
#include "core/stored_run.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using test_support::read_text;
using test_support::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

constexpr long last_step = 400;
constexpr long steps_between_saves = 30;

/// The logistic map x -> 3.9 x (1 - x): two values that differ in the last bit are far apart after some 60
/// steps.
class ChaoticRun final : public TierRun {
 public:
  ChaoticRun(const Scene& scene, long gives_up_at) : gives_up_at_(gives_up_at) {
    here_.so_far.record.tier = "chaotic";
    here_.so_far.observables = observables::standard_table();
    x_ = {scene.number("geometry.radius")};
  }

  Result execute(const RunControl& control) override {
    if (control.resume) {
      here_ = *control.resume;
      x_ = unpack(here_.state.at("x"));
    }
    RunRecord& record = here_.so_far.record;
    while (record.steps < last_step) {
      if (control.interrupted()) {
        record.interrupted = true;
        return here_.so_far;
      }
      if (record.steps == gives_up_at_) {
        record.failure = "at a step that the test asks for";
        return here_.so_far;
      }
      x_[0] *= 3.9 * (1 - x_[0]);
      ++record.steps;
      observables::Sample row;
      row.time = static_cast<double>(record.steps);
      row.pressure = x_[0];
      observables::append(here_.so_far.observables, row);
      if (record.steps % steps_between_saves == 0) {
        here_.state["x"] = pack(x_);
        control.save(here_);
      }
      control.report({1, row.time, last_step, record.steps, 0});
    }
    record.converged = true;
    return here_.so_far;
  }

 private:
  long gives_up_at_;
  std::vector<double> x_;
  Checkpoint here_;
};

class ChaoticTier final : public Tier {
 public:
  explicit ChaoticTier(long gives_up_at = -1) : gives_up_at_(gives_up_at) {}
  std::string_view name() const override { return "chaotic"; }
  std::string refusal(const Scene&) const override { return {}; }
  bool suits(const Scene&) const override { return true; }
  std::unique_ptr<TierRun> prepare(const Scene& scene) const override {
    return std::make_unique<ChaoticRun>(scene, gives_up_at_);
  }

 private:
  long gives_up_at_;
};

Scene scene_of(double radius = 0.4) {
  return parse_scene("[geometry]\nradius = " + std::to_string(radius) + "\n", "some", ".");
}

RunControl stopping_at(long step) {
  auto passed = std::make_shared<long>(0);
  RunControl control;
  control.report = [=](const Progress& progress) { *passed = progress.step; };
  control.interrupted = [=] { return *passed >= step; };
  return control;
}

/// Runs in a process of its own, which ends like one that is killed at the given step: nothing is tidied up.
void run_and_kill(const Scene& scene, const fs::path& folder, bool resume, long step) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      RunControl control;
      control.report = [&](const Progress& progress) {
        if (progress.step >= step) ::_exit(0);
      };
      const ChaoticTier tier;
      StoredRun run(tier, scene, folder, resume);
      run.store(run.execute(control));
    } catch (...) {
    }
    ::_exit(1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "the run ended before it was killed";
}

/// observables.csv of a run that nothing disturbed.
std::string undisturbed(const Scene& scene) {
  const TemporaryFolder folder;
  const ChaoticTier tier;
  StoredRun run(tier, scene, folder.path(), false);
  run.store(run.execute({}));
  EXPECT_FALSE(has_checkpoint(folder.path()));
  return read_text(folder.path() / "observables.csv");
}

/// Resumes, runs to the end and gives observables.csv.
std::string resumed(const Scene& scene, const fs::path& folder, bool from_checkpoint) {
  const ChaoticTier tier;
  StoredRun run(tier, scene, folder, true);
  EXPECT_FALSE(run.is_complete());
  EXPECT_EQ(run.goes_on(), from_checkpoint);
  run.store(run.execute({}));
  EXPECT_FALSE(has_checkpoint(folder));
  EXPECT_EQ(read_result(folder).record.at("steps"), last_step);
  EXPECT_TRUE(StoredRun(tier, scene, folder, true).is_complete());
  return read_text(folder / "observables.csv");
}

}  // namespace

TEST(StoredRun, GoesOnAfterAnInterruptToTheSameResult) {
  const Scene scene = scene_of();
  const ChaoticTier tier;
  const TemporaryFolder folder;
  StoredRun run(tier, scene, folder.path(), false);
  const Result part = run.execute(stopping_at(100));
  EXPECT_TRUE(part.record.interrupted);
  run.store(part);
  EXPECT_TRUE(has_checkpoint(folder.path()));
  EXPECT_EQ(read_result(folder.path()).result.observables.rows(), 100U);
  EXPECT_EQ(resumed(scene, folder.path(), true), undisturbed(scene));
}

TEST(StoredRun, GoesOnAfterKillsAtRandomMomentsToTheSameResult) {
  const Scene scene = scene_of();
  const std::string whole = undisturbed(scene);
  const auto seed = std::random_device()();
  std::mt19937 random(seed);
  for (int repeat = 0; repeat < 10; ++repeat) {
    const TemporaryFolder folder;
    // Killed, resumed and killed again further on, so that what is saved is once that of a resumed run.
    const long first = 1 + static_cast<long>(random() % (last_step - 40));
    const long second = first + static_cast<long>(random() % static_cast<unsigned long>(last_step - first));
    run_and_kill(scene, folder.path(), false, first);
    EXPECT_EQ(has_checkpoint(folder.path()), first >= steps_between_saves) << first << ", seed " << seed;
    EXPECT_FALSE(fs::exists(folder.path() / "record.json"));
    run_and_kill(scene, folder.path(), true, second);
    EXPECT_EQ(resumed(scene, folder.path(), second >= steps_between_saves), whole)
        << first << " and " << second << ", seed " << seed;
  }
}

TEST(StoredRun, WithoutResumeAnOldCheckpointGoes) {
  const Scene scene = scene_of();
  const TemporaryFolder folder;
  run_and_kill(scene, folder.path(), false, 200);
  ASSERT_TRUE(has_checkpoint(folder.path()));
  run_and_kill(scene, folder.path(), false, 2);
  EXPECT_FALSE(has_checkpoint(folder.path()));
}

/// A wall that no solver can set up, or whose solver is lost on the way.
class HopelessTier final : public Tier {
 public:
  explicit HopelessTier(bool sets_up) : sets_up_(sets_up) {}
  std::string_view name() const override { return "chaotic"; }
  std::string refusal(const Scene&) const override { return {}; }
  bool suits(const Scene&) const override { return true; }
  std::unique_ptr<TierRun> prepare(const Scene&) const override {
    struct Lost final : TierRun {
      Result execute(const RunControl&) override { throw SolverFailure("the wall does not settle"); }
    };
    if (!sets_up_) throw SolverFailure("the wall does not settle");
    return std::make_unique<Lost>();
  }

 private:
  bool sets_up_;
};

class Hopeless : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(StoredRun, Hopeless, testing::Bool());

TEST_P(Hopeless, RunLeavesItsOwnRecord) {
  const Scene old_scene = scene_of(0.3), scene = scene_of();
  const TemporaryFolder folder;
  const ChaoticTier sound;
  StoredRun old(sound, old_scene, folder.path(), false);
  old.store(old.execute({}));
  ASSERT_EQ(read_result(folder.path()).record.at("converged"), true);
  const HopelessTier tier(GetParam());
  StoredRun run(tier, scene, folder.path(), false);
  EXPECT_FALSE(run.is_complete());
  const Result result = run.execute({});
  EXPECT_FALSE(result.record.converged);
  run.store(result);
  const StoredResult stored = read_result(folder.path());
  EXPECT_EQ(stored.record.at("converged"), false);
  EXPECT_EQ(stored.record.at("failure"),
            std::string(GetParam() ? "" : "in the set-up: ") + "the wall does not settle");
  EXPECT_EQ(stored.record.at("scene").at("geometry.radius"), 0.4);
  EXPECT_EQ(stored.result.observables.rows(), 0U);
  // Where the solver has been mended the same command with --resume computes.
  EXPECT_EQ(resumed(scene, folder.path(), false), undisturbed(scene));
}

TEST(StoredRun, IsAloneInItsFolderUntilItHasStored) {
  const Scene scene = scene_of(), other = scene_of(0.5);
  const ChaoticTier tier;
  const TemporaryFolder folder;
  const auto refusal = [&] {
    try {
      const StoredRun second(tier, other, folder.path(), false);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  std::string during, beside;
  RunControl control;
  control.report = [&](const Progress& progress) {
    if (progress.step == 5) during = refusal();
  };
  StoredRun run(tier, scene, folder.path(), false);
  const Result result = run.execute(control);
  run.store(result, [&] { beside = refusal(); });
  for (const std::string& message : {during, beside})
    EXPECT_NE(message.find("another run is at work in this folder"), std::string::npos) << message;
  EXPECT_EQ(refusal(), "");
}

// Both find no folder; the quicker one has stored its result when the other begins.
TEST(StoredRun, DoesNotReplaceTheResultOfOneThatWasQuicker) {
  const Scene scene = scene_of(), other = scene_of(0.5);
  const ChaoticTier tier;
  const TemporaryFolder folder;
  const fs::path results = folder.path() / "r";
  StoredRun slow(tier, other, results, false), quick(tier, scene, results, false);
  quick.store(quick.execute({}));
  const std::string rows = read_text(results / "observables.csv");
  EXPECT_THROW(slow.execute({}), InvalidInput);
  EXPECT_EQ(read_text(results / "observables.csv"), rows);
}

TEST(StoredRun, WhatCouldBeResumedIsDiscardedOnlyWhenAsked) {
  const Scene scene = scene_of(), other = scene_of(0.5);
  const ChaoticTier tier;
  const TemporaryFolder folder;
  run_and_kill(scene, folder.path(), false, 200);
  ASSERT_TRUE(has_checkpoint(folder.path()));
  try {
    const StoredRun run(tier, other, folder.path(), Earlier::keep_stopped);
    ADD_FAILURE() << "not refused";
  } catch (const InvalidInput& error) {
    const std::string message = error.what();
    for (const char* word : {"geometry.radius was 0.4 and is 0.5", "--replace", "--out"})
      EXPECT_NE(message.find(word), std::string::npos) << message;
  }
  EXPECT_TRUE(has_checkpoint(folder.path()));
  // Of the same scene and tier whoever leaves out --resume begins anew, and is told.
  const auto warnings = StoredRun(tier, scene, folder.path(), Earlier::keep_stopped).warnings();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("--resume would have gone on"), std::string::npos) << warnings[0];
  EXPECT_TRUE(has_checkpoint(folder.path())) << "nothing is written before the run begins";
  StoredRun run(tier, other, folder.path(), Earlier::replace);
  run.store(run.execute({}));
  EXPECT_EQ(read_text(folder.path() / "observables.csv"), undisturbed(other));
}

TEST(StoredRun, GivingUpKeepsTheCheckpoint) {
  const Scene scene = scene_of();
  const ChaoticTier tier(95);
  const TemporaryFolder folder;
  StoredRun run(tier, scene, folder.path(), false);
  run.store(run.execute({}));
  EXPECT_TRUE(has_checkpoint(folder.path()));
  EXPECT_EQ(observables::record_text(read_result(folder.path()).record, "failure"),
            "at a step that the test asks for");
  EXPECT_EQ(resumed(scene, folder.path(), true), undisturbed(scene));
}

TEST(StoredRun, ACheckpointGoesBeforeTheOlderResultOfAnotherScene) {
  const Scene old_scene = scene_of(0.3), scene = scene_of();
  const ChaoticTier tier;
  const TemporaryFolder folder;
  StoredRun old(tier, old_scene, folder.path(), false);
  old.store(old.execute({}));
  const std::string old_rows = read_text(folder.path() / "observables.csv");
  EXPECT_THROW(StoredRun(tier, scene, folder.path(), true), InvalidInput);
  run_and_kill(scene, folder.path(), false, 200);
  EXPECT_EQ(read_text(folder.path() / "observables.csv"), old_rows) << "lost before there was another result";
  EXPECT_TRUE(StoredRun(tier, old_scene, folder.path(), true).is_complete());
  EXPECT_EQ(resumed(scene, folder.path(), true), undisturbed(scene));
}

TEST(StoredRun, ACheckpointThatCannotBeWrittenDoesNotEndTheRun) {
  const Scene scene = scene_of();
  const ChaoticTier tier;
  const TemporaryFolder folder;
  StoredRun run(tier, scene, folder.path(), false);
  int complaints = 0;
  RunControl control;
  // A folder in its place cannot be replaced by a file.
  control.report = [&](const Progress& progress) {
    if (progress.step == 1) fs::create_directory(folder.path() / "checkpoint");
    if (progress.step == last_step) fs::remove(folder.path() / "checkpoint");
  };
  const Result result = run.execute(control, [&](const std::string& what) {
    ++complaints;
    EXPECT_NE(what.find("checkpoint: cannot be written"), std::string::npos) << what;
  });
  EXPECT_EQ(complaints, last_step / steps_between_saves);
  run.store(result);
  EXPECT_EQ(read_text(folder.path() / "observables.csv"), undisturbed(scene));
}

TEST(StoredRun, ResumeNoticesThatAnInputHasChanged) {
  const TemporaryFolder inputs, folder;
  const auto write = [&](const char* peak) {
    write_whole(inputs.path() / "flow.csv",
                std::string("time[s],flow[cm3/s]\n0,0.1\n0.1,") + peak + "\n0.2,0.15\n0.3,0.12\n0.8,0.1\n");
  };
  const auto scene = [&](const std::string& radius) {
    return parse_scene("[geometry]\nkind = \"mesh\"\nfile = \"artery.msh\"\nradius = " + radius +
                           "\n[inlet]\nwaveform = \"flow.csv\"\n",
                       "some.toml", inputs.path());
  };
  const auto refusal = [&](const std::string& radius = "0.4") -> std::string {
    try {
      const Scene now = scene(radius);
      const bool is_complete = StoredRun(ChaoticTier(), now, folder.path(), true).is_complete();
      return is_complete ? "complete" : "goes on";
    } catch (const InvalidInput& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_NE(message.find("leave out --resume"), std::string::npos) << message;
      return message;
    }
  };
  const auto expect_noticed = [&](const std::string& otherwise) {
    write_whole(inputs.path() / "artery.msh", "another mesh");
    EXPECT_NE(refusal().find("contents of geometry.file = \"artery.msh\" have changed"), std::string::npos)
        << refusal();
    write_whole(inputs.path() / "artery.msh", "a mesh");
    write("0.3");
    EXPECT_NE(refusal().find("contents of inlet.waveform = \"flow.csv\" have changed"), std::string::npos)
        << refusal();
    write("0.2");
    EXPECT_NE(refusal("0.5").find("some.toml: geometry.radius was 0.4 and is 0.5"), std::string::npos)
        << refusal("0.5");
    EXPECT_EQ(refusal(), otherwise);
  };
  write_whole(inputs.path() / "artery.msh", "a mesh");
  write("0.2");
  const Scene first = scene("0.4");
  run_and_kill(first, folder.path(), false, 200);
  expect_noticed("goes on");
  // What counts is what the run read, not what lies there when it ends.
  const ChaoticTier tier;
  StoredRun run(tier, first, folder.path(), true);
  write_whole(inputs.path() / "artery.msh", "another mesh");
  run.store(run.execute({}));
  expect_noticed("complete");
}
