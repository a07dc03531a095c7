// SPDX-License-Identifier: GPL-3.0-or-later
// Whose results a folder holds: runs that fail, that run side by side, that were stopped, that a batch system
// or mpirun has started, and where results go by default.
#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <memory>

#include "core/observables/checkpoint.hpp"
#include "core/observables/folder_lock.hpp"
#include "core/observables/result.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

namespace fs = std::filesystem;
using test_support::broken_file;
using test_support::Ended;
using test_support::is_one_line;
using test_support::Program;
using test_support::read_text;
using test_support::TemporaryFolder;
using Arguments = std::vector<std::string>;

const std::string scene = std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml";

/// A run into "r", and so for each setting.
Arguments run_with(const Arguments& settings, const Arguments& more = {}) {
  Arguments all{"run", scene, "--out", "r", "--quiet", "--no-report"};
  all.insert(all.end(), more.begin(), more.end());
  for (const auto& setting : settings) all.insert(all.end(), {"--set", setting});
  return all;
}

/// The program with variables of the environment.
Ended tunica_in(const Arguments& environment, const Arguments& arguments, const fs::path& folder) {
  Arguments all{"/usr/bin/env"};
  all.insert(all.end(), environment.begin(), environment.end());
  all.emplace_back(TUNICA_PROGRAM);
  all.insert(all.end(), arguments.begin(), arguments.end());
  Program program(all, folder);
  const int code = program.wait();
  return {code, program.output(), program.errors()};
}

// Whether fibres that hardly turn from the axis can be computed or not: the record is that of the run.
TEST(Folder, HoldsTheRecordOfTheLatestRunAlsoWhereItsSetUpFails) {
  for (const char* setting : {"wall.fiber_angle=88", "wall.fiber_stiffening=1000"}) {
    const TemporaryFolder folder;
    ASSERT_EQ(test_support::tunica(run_with({}), folder.path()).code, 0);
    const std::string before = read_text(folder.path() / "r/record.json");
    const Ended ended = test_support::tunica(run_with({setting}), folder.path());
    if (ended.code == 2) {
      EXPECT_TRUE(read_text(folder.path() / "r/record.json") == before) << "nothing was computed";
      continue;
    }
    ASSERT_TRUE(ended.code == 0 || ended.code == 3) << ended.errors;
    const auto record = read_result(folder.path() / "r").record;
    EXPECT_EQ(record.at("converged"), ended.code == 0) << setting;
    EXPECT_EQ(record.at("failure") == "", ended.code == 0) << setting;
    const std::string key = std::string(setting).substr(0, std::string(setting).find('='));
    EXPECT_EQ(record.at("scene").at(key), std::stod(std::string(setting).substr(key.size() + 1)));
    EXPECT_EQ(broken_file(folder.path() / "r"), "");
  }
}

// Runs of four walls into one folder: what is there in the end is that of one of them, and each run has
// either left its own or was told that it could not.
TEST(Folder, IsForOneOfManyRunsAtOnce) {
  const Arguments laws{"EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS"};
  const auto arguments = [](const std::string& law) {
    Arguments all = run_with({"time.beats=1", "wall.law=" + law});
    all.insert(all.begin(), TUNICA_PROGRAM);
    return all;
  };
  std::map<std::string, std::string> rows;
  for (const auto& law : laws) {
    const TemporaryFolder alone;
    ASSERT_EQ(Program(arguments(law), alone.path()).wait(), 0);
    rows[law] = read_text(alone.path() / "r/observables.csv");
  }
  int refused = 0;
  for (int round = 0; round < 5; ++round) {
    const TemporaryFolder folder;
    if (round % 2 == 1) fs::create_directory(folder.path() / "r");
    std::vector<std::unique_ptr<Program>> programs;
    for (const auto& law : laws) programs.push_back(std::make_unique<Program>(arguments(law), folder.path()));
    int completed = 0;
    for (const auto& program : programs) {
      const int code = program->wait();
      if (code == 0) {
        ++completed;
        continue;
      }
      EXPECT_EQ(code, 2);
      EXPECT_TRUE(is_one_line(program->errors())) << program->errors();
      EXPECT_NE(program->errors().find("another run"), std::string::npos) << program->errors();
      ++refused;
    }
    EXPECT_GE(completed, 1);
    EXPECT_EQ(broken_file(folder.path() / "r"), "");
    const StoredResult stored = read_result(folder.path() / "r");
    const std::string law = stored.record.at("scene").at("wall.law");
    EXPECT_EQ(stored.record.at("converged"), true);
    EXPECT_TRUE(read_text(folder.path() / "r/observables.csv") == rows.at(law))
        << "rows of another run than " << law;
    EXPECT_FALSE(fs::exists(folder.path() / "r/.lock"));
  }
  EXPECT_GT(refused, 0) << "no two runs met";
}

TEST(Folder, ThatAnotherRunHasIsRefusedByName) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "r");
  const FolderLock lock(folder.path() / "r");
  const std::string me = "process " + std::to_string(::getpid());
  for (const Arguments& arguments : {run_with({}), Arguments{"verify", scene, "--out", "r", "--quiet"}}) {
    const Ended ended = test_support::tunica(arguments, folder.path());
    EXPECT_EQ(ended.code, 2);
    EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
    EXPECT_NE(ended.errors.find(me), std::string::npos) << ended.errors;
  }
  EXPECT_EQ(test_support::count_entries(folder.path() / "r"), 1U) << "something was written";
}

TEST(Folder, OfAStoppedRunOfAnotherTierIsNotReplacedUnasked) {
  const TemporaryFolder folder;
  const fs::path results = folder.path() / "r";
  fs::create_directory(results);
  write_checkpoint(results, read_scene(scene), "full3d", nlohmann::ordered_json::object(), {});
  const Ended refused = test_support::tunica(run_with({}), folder.path());
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(is_one_line(refused.errors)) << refused.errors;
  for (const char* word : {"r: holds a run that was stopped", "tier full3d", "--replace", "--out"})
    EXPECT_NE(refused.errors.find(word), std::string::npos) << refused.errors;
  EXPECT_TRUE(has_checkpoint(results));
  EXPECT_FALSE(fs::exists(results / "record.json"));
  const Ended asked = test_support::tunica(run_with({}, {"--replace"}), folder.path());
  EXPECT_EQ(asked.code, 0) << asked.errors;
  EXPECT_FALSE(has_checkpoint(results));
  const Ended both = test_support::tunica(run_with({}, {"--replace", "--resume"}), folder.path());
  EXPECT_EQ(both.code, 2);
  EXPECT_TRUE(is_one_line(both.errors)) << both.errors;
}

TEST(Folder, ThatHoldsAnotherTiersResultIsReplacedWithAWord) {
  const TemporaryFolder folder;
  Arguments arguments = run_with({"time.beats=1", "accuracy.tolerance=10%"}, {"--tier", "axisym"});
  ASSERT_EQ(test_support::tunica(arguments, folder.path()).code, 0);
  arguments = run_with({"time.beats=1"});
  std::erase(arguments, "--quiet");
  const Ended ended = test_support::tunica(arguments, folder.path());
  EXPECT_EQ(ended.code, 0) << ended.errors;
  EXPECT_NE(ended.errors.find("r: the result of tier axisym that lies here is replaced"), std::string::npos)
      << ended.errors;
  const Ended again = test_support::tunica(arguments, folder.path());
  EXPECT_EQ(again.errors.find("is replaced"), std::string::npos) << again.errors;
}

TEST(Folder, ByDefaultIsNamedAfterTheCommand) {
  const TemporaryFolder folder;
  const auto run = [&](const Arguments& more) {
    Arguments all{"run", scene, "--no-report", "--set", "time.beats=1"};
    all.insert(all.end(), more.begin(), more.end());
    const Ended ended = test_support::tunica(all, folder.path());
    EXPECT_EQ(ended.code, 0) << ended.errors;
    return ended.output.substr(0, ended.output.find(": "));
  };
  EXPECT_EQ(run({}), "results/cylinder-time.beats=1");
  EXPECT_EQ(run({"--set", "wall.law=EXP1"}), "results/cylinder-time.beats=1-wall.law=EXP1");
  EXPECT_EQ(run({"--tier", "lumped"}), "results/cylinder-lumped-time.beats=1");
  const auto law = [&](const char* name) {
    return read_result(folder.path() / "results" / name).record.at("scene").at("wall.law");
  };
  EXPECT_EQ(law("cylinder-time.beats=1"), "EXP1+EXP2-FS");
  EXPECT_EQ(law("cylinder-time.beats=1-wall.law=EXP1"), "EXP1");
  EXPECT_EQ(run({"--resume", "--set", "wall.law=EXP1"}), "results/cylinder-time.beats=1-wall.law=EXP1");
}

// A task of a batch system has a command of its own, whatever its number; so has what a process of an MPI job
// starts by itself.
TEST(BatchTasks, ComputeWhatTheyAreToldTo) {
  for (const Arguments& environment :
       {Arguments{"SLURM_PROCID=5", "SLURM_NTASKS=8"},
        Arguments{"SLURM_PROCID=5", "PMI_RANK=5", "PMI_SIZE=8"}, Arguments{"SLURM_PROCID=5", "PMIX_RANK=5"},
        Arguments{"OMPI_COMM_WORLD_RANK=1", "OMPI_COMM_WORLD_SIZE=1"}}) {
    SCOPED_TRACE(environment.back());
    const TemporaryFolder folder;
    Arguments arguments = run_with({"time.beats=1"});
    std::erase(arguments, "--quiet");
    const Ended ended = tunica_in(environment, arguments, folder.path());
    EXPECT_EQ(ended.code, 0) << ended.errors;
    EXPECT_NE(ended.output.find("r: tier lumped"), std::string::npos) << ended.output;
    ASSERT_TRUE(fs::exists(folder.path() / "r/record.json"));
    EXPECT_EQ(read_result(folder.path() / "r").record.at("converged"), true);
    const Ended bad = tunica_in(environment, run_with({"time.beats=0"}), folder.path());
    EXPECT_EQ(bad.code, 2);
    EXPECT_TRUE(is_one_line(bad.errors)) << "an error is told: " << bad.errors;
  }
}

TEST(BatchTasks, OfAWorkerOfAnMpiJobAreItsOwn) {
  const TemporaryFolder folder;
  const std::string command = std::string(TUNICA_PROGRAM) + " run " + scene +
                              " --quiet --no-report --set time.beats=1 --out r; echo ended $?";
  Program worker(
      {"/usr/bin/env", "OMPI_COMM_WORLD_RANK=1", "OMPI_COMM_WORLD_SIZE=2", "/bin/sh", "-c", command},
      folder.path());
  EXPECT_EQ(worker.wait(), 0);
  EXPECT_EQ(worker.output(), "ended 0\n") << worker.errors();
  EXPECT_TRUE(fs::exists(folder.path() / "r/record.json"));
}

TEST(MpiJobs, LeaveItToTheirFirstProcess) {
  for (const Arguments& environment : {Arguments{"OMPI_COMM_WORLD_RANK=1", "OMPI_COMM_WORLD_SIZE=2"},
                                       Arguments{"PMI_RANK=1", "PMI_SIZE=2"}}) {
    const TemporaryFolder folder;
    const Ended ended = tunica_in(environment, run_with({"time.beats=1"}), folder.path());
    EXPECT_EQ(ended.code, 0) << ended.errors;
    EXPECT_EQ(ended.output + ended.errors, "");
    EXPECT_TRUE(fs::is_empty(folder.path()));
  }
}

}  // namespace
}  // namespace tunica
