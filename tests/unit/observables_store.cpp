// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <thread>

#include "core/error.hpp"
#include "core/observables/build_info.hpp"
#include "core/observables/result.hpp"
#include "tests/support/synthetic.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using tunica::test_support::count_entries;
using tunica::test_support::read_text;
using tunica::test_support::synthetic_run;
using tunica::test_support::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

std::string output_error(const std::function<void()>& action) {
  try {
    action();
  } catch (const OutputFailure& error) {
    return error.what();
  }
  return "no error";
}

Result small_result() {
  Result result = synthetic_run({.interval = 0.1}).result;
  result.record.tier = "lumped";
  result.record.resolution = {{"compartments", 1}};
  result.record.steps = 42;
  result.record.converged = true;
  result.record.remarks = {"first", "second"};
  return result;
}

Scene small_scene() {
  return parse_scene("[wall]\nlaw = \"EXP1\"\n", "small", ".");
}

/// Runs in a process of its own and tells whether it returned true.
bool in_child(const std::function<bool()>& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    bool done = false;
    try {
      done = action();
    } catch (...) {
    }
    ::_exit(done ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// A small file system of one's own, seen by this process only. Not everyone may mount one.
bool mount_small(const fs::path& folder, unsigned long flags) {
  if (::unshare(::geteuid() == 0 ? CLONE_NEWNS : CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
  if (::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return false;
  return ::mount("small", folder.c_str(), "tmpfs", flags, "size=64k") == 0;
}

bool can_mount() {
  const TemporaryFolder folder;
  return in_child([&] { return mount_small(folder.path(), 0); });
}

}  // namespace

TEST(WriteWhole, ReplacesAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a.txt";
  write_whole(file, "one");
  EXPECT_EQ(read_text(file), "one");
  write_whole(file, "");
  EXPECT_EQ(read_text(file), "");
  EXPECT_EQ(count_entries(folder.path()), 1u);
}

TEST(WriteWhole, AReaderNeverSeesHalfAFile) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a.txt";
  const std::string texts[] = {std::string(300000, 'a'), std::string(200000, 'b')};
  write_whole(file, texts[0]);
  std::atomic<bool> stop = false;
  std::atomic<long> reads = 0;
  std::atomic<long> torn = 0;
  std::thread reader([&] {
    while (!stop) {
      const std::string seen = read_text(file);
      ++reads;
      if (seen != texts[0] && seen != texts[1]) ++torn;
    }
  });
  // On a busy machine the reader may get few turns: the writer goes on until it has had enough of them.
  constexpr int least_writes = 200, most_writes = 20000, enough_reads = 11;
  for (int repeat = 0; repeat < least_writes || (reads < enough_reads && repeat < most_writes); ++repeat)
    write_whole(file, texts[repeat % 2]);
  stop = true;
  reader.join();
  EXPECT_GE(reads, enough_reads);
  EXPECT_EQ(torn, 0);
}

TEST(WriteWhole, AKilledWriterLeavesWholeFiles) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a.txt";
  const std::string texts[] = {std::string(3000000, 'a'), std::string(2000000, 'b')};
  write_whole(file, texts[0]);
  std::mt19937 random(3);
  for (int repeat = 0; repeat < 30; ++repeat) {
    const pid_t child = ::fork();
    if (child == 0)
      for (int index = 0;; ++index) write_whole(file, texts[index % 2]);
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 20000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const std::string seen = read_text(file);
    ASSERT_TRUE(seen == texts[0] || seen == texts[1]) << "half a file after kill " << repeat;
  }
}

TEST(WriteWhole, AFileTooLargeIsNamedAndLeavesTheOldOne) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a.txt";
  write_whole(file, "old");
  EXPECT_TRUE(in_child([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{10000, 10000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    return output_error([&] { write_whole(file, std::string(20000, 'x')); }) ==
           file.string() + ": cannot be written: File too large";
  }));
  EXPECT_EQ(read_text(file), "old");
  EXPECT_EQ(count_entries(folder.path()), 1u);
}

TEST(WriteWhole, AFullDiskIsNamedAndLeavesTheOldFile) {
  if (!can_mount()) GTEST_SKIP() << "may not mount a small file system here";
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a.txt";
  EXPECT_TRUE(in_child([&] {
    mount_small(folder.path(), 0);
    write_whole(file, "old");
    const std::string message = output_error([&] { write_whole(file, std::string(1 << 20, 'x')); });
    return message == file.string() + ": cannot be written: No space left on device" &&
           read_text(file) == "old" && count_entries(folder.path()) == 1;
  }));
}

TEST(ResultFolder, AReadOnlyFileSystemIsNamed) {
  if (!can_mount()) GTEST_SKIP() << "may not mount a small file system here";
  const TemporaryFolder folder;
  EXPECT_TRUE(in_child([&] {
    mount_small(folder.path(), MS_RDONLY);
    return output_error([&] { make_result_folder(folder.path()); }) ==
           folder.path().string() + ": files cannot be made in this folder: Read-only file system";
  }));
}

TEST(ResultFolder, AFileInItsPlaceIsNamed) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "taken";
  write_whole(file, "x");
  EXPECT_EQ(output_error([&] { make_result_folder(file); }),
            file.string() + ": the folder for results cannot be made: Not a directory");
  EXPECT_EQ(output_error([&] { make_result_folder(file / "below"); }),
            (file / "below").string() + ": the folder for results cannot be made: Not a directory");
}

TEST(ResultFolder, IsMadeWithItsParentsAndLeftEmpty) {
  const TemporaryFolder folder;
  make_result_folder(folder.path() / "a" / "b");
  EXPECT_EQ(count_entries(folder.path() / "a" / "b"), 0u);
}

TEST(StoreResult, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const Result result = small_result();
  const Scene scene = small_scene();
  write_result(folder.path(), scene, result);
  const StoredResult stored = read_result(folder.path());
  for (const auto table : {&Result::observables, &Result::profiles, &Result::events})
    EXPECT_EQ(observables::to_csv(stored.result.*table), observables::to_csv(result.*table));
  EXPECT_TRUE(stored.result.sensitivities.columns().empty());
  EXPECT_EQ(stored.record["program"], "tunica");
  EXPECT_EQ(stored.record["version"], program_version());
  EXPECT_EQ(stored.record["commit"], program_commit());
  EXPECT_EQ(stored.record["name"], "small");
  EXPECT_EQ(stored.record["steps"], 42);
  EXPECT_EQ(stored.record["remarks"], nlohmann::ordered_json({"first", "second"}));
  EXPECT_EQ(stored.record["resolution"]["compartments"], 1);
  EXPECT_EQ(stored.record["scene"].size(), scene.values().size());
  EXPECT_EQ(stored.record["scene"]["wall.law"], "EXP1");
  EXPECT_EQ(stored.record["scene"]["tether.stiffness"], 1e7);
  EXPECT_EQ(stored.record["scene_set"], nlohmann::ordered_json({"wall.law"}));
  EXPECT_EQ(stored.record["scene_toml"], describe(scene));
  EXPECT_GT(stored.record["peak_memory_bytes"].get<long>(), 100000);
}

TEST(StoreResult, FilesOfAnEarlierRunAndLeftoversGo) {
  const TemporaryFolder folder;
  Result result = synthetic_run({.interval = 0.1, .with_sensitivities = true}).result;
  write_result(folder.path(), small_scene(), result);
  EXPECT_TRUE(fs::exists(folder.path() / "sensitivities.csv"));
  EXPECT_TRUE(fs::exists(folder.path() / "event_sensitivities.csv"));
  write_whole(folder.path() / "notes.txt", "the user's own");
  std::ofstream(folder.path() / ".observables.csv.1.part") << "half";
  result.sensitivities = {};
  result.event_sensitivities = {};
  write_result(folder.path(), small_scene(), result);
  EXPECT_FALSE(fs::exists(folder.path() / "sensitivities.csv"));
  EXPECT_FALSE(fs::exists(folder.path() / "event_sensitivities.csv"));
  EXPECT_FALSE(fs::exists(folder.path() / ".observables.csv.1.part"));
  EXPECT_EQ(read_text(folder.path() / "notes.txt"), "the user's own");
}

TEST(StoreResult, AKilledRunLeavesEitherNoRecordOrAWholeResult) {
  const TemporaryFolder folder;
  const Scene scene = small_scene();
  // Each run has its own number of rows, so that files of two runs are told apart.
  const Result results[] = {synthetic_run({.interval = 0.001}).result,
                            synthetic_run({.interval = 0.002}).result};
  const long steps[] = {1, 2};
  std::mt19937 random(5);
  int whole = 0;
  for (int repeat = 0; repeat < 30; ++repeat) {
    const pid_t child = ::fork();
    if (child == 0)
      for (int index = 0;; ++index) {
        Result result = results[index % 2];
        result.record.steps = steps[index % 2];
        write_result(folder.path(), scene, result);
      }
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 60000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    if (!fs::exists(folder.path() / "record.json")) continue;
    ++whole;
    const StoredResult stored = read_result(folder.path());
    EXPECT_EQ(stored.result.observables.rows(), stored.record["steps"] == 1 ? 1601u : 801u);
  }
  RecordProperty("whole_results_seen", whole);
}

TEST(StoreResult, WhatIsNoResultIsNamed) {
  const TemporaryFolder folder;
  const auto message = [&] {
    try {
      read_result(folder.path());
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(message().find("record.json is missing"), std::string::npos) << message();
  for (const char* text : {"", "{", "[1]", "{}", "{\"program\": \"other\"}", "{\"program\": 3}"}) {
    write_whole(folder.path() / "record.json", text);
    EXPECT_NE(message().find("not the record of a run of tunica"), std::string::npos) << text;
  }
  write_whole(folder.path() / "record.json", "{\"program\": \"tunica\"}");
  EXPECT_NE(message().find("observables.csv: the file cannot be read"), std::string::npos) << message();
}

TEST(StoreResult, ASceneNameThatIsNotUtf8IsStored) {
  const TemporaryFolder folder;
  write_result(folder.path(), parse_scene("[wall]\n", "bad\xff", "."), small_result());
  EXPECT_EQ(read_result(folder.path()).record["name"], "bad\xEF\xBF\xBD");
}

TEST(BuildInfo, VersionAndCommitLookLikeOnes) {
  EXPECT_EQ(std::count(program_version().begin(), program_version().end(), '.'), 2);
  if (program_commit().empty()) GTEST_SKIP() << "built without git";
  EXPECT_EQ(program_commit().substr(0, 40).find_first_not_of("0123456789abcdef"), std::string_view::npos);
}
