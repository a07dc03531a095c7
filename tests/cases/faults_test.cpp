// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that end before their end: no equilibrium, Ctrl-C, kill -9, no room, no permission.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <random>
#include <thread>

#include "core/observables/result.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test_support::broken_file;
using test_support::Ended;
using test_support::is_one_line;
using test_support::Program;
using test_support::read_text;
using test_support::TemporaryFolder;
using Clock = std::chrono::steady_clock;

const std::string scene = std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml";

/// A run of some seconds: many beats, many rows.
std::vector<std::string> long_run(const std::string& out) {
  return {"run",         scene,   "--out",         out,     "--quiet",
          "--no-report", "--set", "time.beats=40", "--set", "output.interval=4e-4"};
}
std::vector<std::string> with_program(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), TUNICA_PROGRAM);
  return arguments;
}

// A neo-Hookean wall that nothing holds carries at most mu ln(R_o/R_i) = 15 mmHg.
TEST(Faults, NoEquilibriumEndsWithCodeThreeAndKeepsTheResults) {
  const TemporaryFolder folder;
  const Ended ended =
      test_support::tunica({"run", scene, "--out", "r", "--quiet", "--set", "wall.law=neo-Hookean", "--set",
                            "tether.stiffness=0", "--set", "wall.incompressible=true"},
                           folder.path());
  EXPECT_EQ(ended.code, 3);
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  EXPECT_NE(ended.errors.find("at t = "), std::string::npos) << ended.errors;
  EXPECT_EQ(broken_file(folder.path() / "r"), "");
  const StoredResult stored = read_result(folder.path() / "r");
  EXPECT_EQ(stored.record.at("converged"), false);
  const std::string failure = stored.record.at("failure");
  EXPECT_NE(failure.find("lumen stretch"), std::string::npos) << failure;
  const auto& time = stored.result.observables.find("time")->values;
  const auto& pressure = stored.result.observables.find("pressure")->values;
  ASSERT_GT(time.size(), 2U);
  EXPECT_NEAR(std::stod(failure.substr(failure.find("t = ") + 4)), time.back(), 2e-3);
  for (const double p : pressure) EXPECT_LT(p, 76350 * std::log(0.043 / 0.033) * 1.01);
}

/// The observables of long_run, computed once without disturbance, and the time that it took.
class Interrupted : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const TemporaryFolder folder;
    const auto start = Clock::now();
    const Ended ended = test_support::tunica(long_run("r"), folder.path());
    ASSERT_EQ(ended.code, 0) << ended.errors;
    duration_ = std::chrono::duration<double>(Clock::now() - start).count();
    observables_ = read_text(folder.path() / "r/observables.csv");
  }
  void expect_resumed(const fs::path& folder) const {
    auto arguments = long_run("r");
    arguments.emplace_back("--resume");
    const Ended ended = test_support::tunica(arguments, folder);
    EXPECT_EQ(ended.code, 0) << ended.errors;
    EXPECT_EQ(broken_file(folder / "r"), "");
    EXPECT_TRUE(read_text(folder / "r/observables.csv") == observables_) << "other results after --resume";
    EXPECT_EQ(read_result(folder / "r").record.at("converged"), true);
  }
  static inline double duration_ = 0;
  static inline std::string observables_;
};

TEST_F(Interrupted, BySigintItKeepsWholeFilesAndResumes) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    // The folder is made when the run begins; the signal comes some way into it. A run that has come
    // to writing its files finishes, so an early try may be late on a busy machine.
    int code = 0;
    std::string errors;
    for (double share = 0.3; share > 0.01 && code == 0; share *= 0.5) {
      std::error_code ignored;
      fs::remove_all(folder.path() / "r", ignored);
      Program program(with_program(long_run("r")), folder.path());
      while (program.running() && !fs::exists(folder.path() / "r")) std::this_thread::sleep_for(100us);
      std::this_thread::sleep_for(std::chrono::duration<double>(share * duration_));
      program.send(signal);
      code = program.wait();
      errors = program.errors();
    }
    ASSERT_EQ(code, 130) << errors;
    EXPECT_TRUE(is_one_line(errors)) << errors;
    EXPECT_NE(errors.find("--resume"), std::string::npos) << errors;
    EXPECT_EQ(broken_file(folder.path() / "r"), "");
    const StoredResult stored = read_result(folder.path() / "r");
    EXPECT_EQ(stored.record.at("converged"), false);
    const std::string part = read_text(folder.path() / "r/observables.csv");
    EXPECT_GT(stored.result.observables.rows(), 0U);
    EXPECT_LT(part.size(), observables_.size());
    EXPECT_TRUE(observables_.starts_with(part)) << "the rows so far are those of the whole run";
    expect_resumed(folder.path());
  }
}

TEST_F(Interrupted, ItIsSaidAtOnceThatARunStops) {
  const TemporaryFolder folder;
  auto arguments = long_run("r");
  std::erase(arguments, "--quiet");
  int code = 0;
  std::string errors;
  for (double share = 0.3; share > 0.01 && code == 0; share *= 0.5) {
    std::error_code ignored;
    fs::remove_all(folder.path() / "r", ignored);
    Program program(with_program(arguments), folder.path());
    while (program.running() && !fs::exists(folder.path() / "r")) std::this_thread::sleep_for(100us);
    std::this_thread::sleep_for(std::chrono::duration<double>(share * duration_));
    program.send(SIGHUP);
    code = program.wait();
    errors = program.errors();
  }
  ASSERT_EQ(code, 130) << errors;
  const auto said = errors.find("tunica: stopping after this step; again to stop now\n");
  EXPECT_NE(said, std::string::npos) << errors;
  EXPECT_GT(errors.find("interrupted; results so far"), said) << errors;
}

// nohup has a program ignore that its terminal goes.
TEST_F(Interrupted, ByNoHangupThatItIsToIgnore) {
  const TemporaryFolder folder;
  Program program(with_program(long_run("r")), folder.path(), [] { std::signal(SIGHUP, SIG_IGN); });
  while (program.running() && !fs::exists(folder.path() / "r")) std::this_thread::sleep_for(100us);
  program.send(SIGHUP);
  EXPECT_EQ(program.wait(), 0) << program.errors();
  EXPECT_TRUE(read_text(folder.path() / "r/observables.csv") == observables_);
}

TEST_F(Interrupted, ByKillAtRandomMomentsItLeavesOnlyWholeFiles) {
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << ", a run takes " << duration_ << " s\n";
  std::mt19937 random(seed);
  // On a machine that was busier before than it is now runs may end before their moment: then there are more.
  constexpr int tries = 14, most_tries = 80, enough = 5;
  std::uniform_real_distribution<double> moment(0, 1.05 * duration_);
  int killed = 0;
  const TemporaryFolder folder;  // the same throughout: later runs find what earlier ones left
  for (int k = 0; k < tries || (killed < enough && k < most_tries); ++k) {
    auto arguments = long_run("r");
    if (k % 2 == 1) arguments.emplace_back("--resume");
    Program program(with_program(arguments), folder.path());
    std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
    program.send(SIGKILL);
    if (program.wait() == 256 + SIGKILL) ++killed;
    EXPECT_EQ(broken_file(folder.path() / "r"), "") << "kill " << k << ", seed " << seed;
    // Where the record is, the files beside it belong to it.
    if (fs::exists(folder.path() / "r/record.json")) {
      EXPECT_TRUE(read_text(folder.path() / "r/observables.csv") == observables_)
          << "kill " << k << ", seed " << seed;
    }
  }
  EXPECT_GE(killed, enough) << "seed " << seed;
  expect_resumed(folder.path());
}

TEST_F(Interrupted, ResumeOfAnotherSceneIsRefused) {
  const TemporaryFolder folder;
  ASSERT_EQ(test_support::tunica({"run", scene, "--out", "r", "--quiet", "--no-report"}, folder.path()).code,
            0);
  const std::string before = read_text(folder.path() / "r/observables.csv");
  const Ended other = test_support::tunica(
      {"run", scene, "--out", "r", "--quiet", "--resume", "--set", "tether.stiffness=2e7"}, folder.path());
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(is_one_line(other.errors)) << other.errors;
  EXPECT_NE(other.errors.find("cylinder.toml: tether.stiffness was 10000000 and is 20000000"),
            std::string::npos)
      << other.errors;
  EXPECT_TRUE(read_text(folder.path() / "r/observables.csv") == before);
}

TEST(Faults, ResumeWithAnotherWaveformOfTheSameNameIsRefused) {
  const TemporaryFolder folder;
  const auto write = [&](const char* peak) {
    std::ofstream(folder.path() / "flow.csv")
        << "time[s],flow[cm3/s]\n0,0.1\n0.1," << peak << "\n0.2,0.15\n0.3,0.12\n0.8,0.1\n";
  };
  std::ofstream(folder.path() / "mine.toml") << "[inlet]\nwaveform = \"flow.csv\"\n[time]\nbeats = 1\n";
  const std::vector<std::string> command{"run",     "mine.toml",   "--out",   "r",
                                         "--quiet", "--no-report", "--resume"};
  write("0.2");
  ASSERT_EQ(test_support::tunica(command, folder.path()).code, 0);
  EXPECT_EQ(test_support::tunica(command, folder.path()).code, 0) << "complete";
  const std::string before = read_text(folder.path() / "r/record.json");
  write("0.21");
  const Ended changed = test_support::tunica(command, folder.path());
  EXPECT_EQ(changed.code, 2);
  EXPECT_TRUE(is_one_line(changed.errors)) << changed.errors;
  EXPECT_NE(changed.errors.find("the contents of inlet.waveform = \"flow.csv\" have changed"),
            std::string::npos)
      << changed.errors;
  EXPECT_TRUE(read_text(folder.path() / "r/record.json") == before);
}

TEST(Faults, FullDiskIsToldAndLeavesNoHalfFile) {
  const TemporaryFolder folder;
  const fs::path disk = folder.path() / "disk";
  fs::create_directory(disk);
  const bool mounted = ::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=256k") == 0;
  // Where mounting is not allowed, a limit on the size of files stands for a full disk.
  const auto limit = [mounted] {
    if (mounted) return;
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit size{200'000, 200'000};
    ::setrlimit(RLIMIT_FSIZE, &size);
  };
  const Ended ended =
      test_support::tunica({"run", scene, "--out", disk / "r", "--quiet"}, folder.path(), limit);
  const std::string broken = broken_file(disk / "r");
  const bool recorded = fs::exists(disk / "r/record.json");
  std::size_t parts = 0;
  if (fs::exists(disk / "r"))
    for (const auto& entry : fs::directory_iterator(disk / "r"))
      parts += entry.path().filename().string().ends_with(".part") ? 1 : 0;
  if (mounted) ::umount(disk.c_str());
  EXPECT_NE(ended.code, 0);
  EXPECT_LT(ended.code, 256) << "ended by a signal";
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  EXPECT_NE(ended.errors.find(mounted ? "No space left" : "File too large"), std::string::npos)
      << ended.errors;
  EXPECT_EQ(broken, "");
  EXPECT_FALSE(recorded) << "a record beside files that are missing";
  EXPECT_EQ(parts, 0U);
}

// What fits into a buffer fails when it is flushed at the end, what does not fails before.
TEST(Faults, FullStandardOutputIsTold) {
  const auto nowhere = [] {
    const int full = ::open("/dev/full", O_WRONLY);
    if (full < 0 || ::dup2(full, STDOUT_FILENO) < 0) ::_exit(124);
  };
  const std::vector<std::vector<std::string>> commands{
      {"--version"}, {"scene", "--list"}, {"scene", scene}, {"scene", "--parameters"}};
  for (const auto& command : commands) {
    const Ended ended = test_support::tunica(command, ".", nowhere);
    EXPECT_EQ(ended.code, 2) << command.back();
    EXPECT_EQ(ended.errors, "tunica: the standard output cannot be written: No space left on device\n");
  }
}

TEST(Faults, UnitDatabaseWithoutTheUnitsOfAllIsTold) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "none.xml")
      << "<?xml version=\"1.0\" encoding=\"US-ASCII\"?>\n<unit-system></unit-system>\n";
  const Ended ended = test_support::tunica({"scene", scene, "--set", "inlet.pressure=75 mmHg"}, folder.path(),
                                           [] { ::setenv("UDUNITS2_XML_PATH", "none.xml", 1); });
  EXPECT_EQ(ended.code, 2);
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  EXPECT_NE(ended.errors.find("set UDUNITS2_XML_PATH to udunits2.xml"), std::string::npos) << ended.errors;
}

// The limit stands for a machine that is too small. Sanitisers take terabytes of addresses themselves.
TEST(Faults, MemoryThatRunsOutIsToldWithHowMuchWasAsked) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP();
#endif
  const TemporaryFolder folder;
  const auto limit = [] {
    const rlimit size{300'000'000, 300'000'000};
    ::setrlimit(RLIMIT_AS, &size);
  };
  const Ended ended = test_support::tunica({"run", scene, "--out", "r", "--quiet", "--tier", "axisym",
                                            "--set", "mesh.axial_cells=1800", "--set", "mesh.wall_cells=10"},
                                           folder.path(), limit);
  EXPECT_EQ(ended.code, 2) << ended.errors;
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  for (const char* word : {"memory ran out", "iB", "0.279 GiB that a limit", "mesh.*_cells"})
    EXPECT_NE(ended.errors.find(word), std::string::npos) << ended.errors;
  EXPECT_TRUE(fs::is_empty(folder.path())) << "something was written";
}

TEST(Faults, OutputThatIsTooMuchIsRefusedBeforeWork) {
  const std::string small = "output.field_interval=1.7e-5";
  for (const std::vector<std::string>& settings : {std::vector<std::string>{"lumped", small},
                                                   {"axisym", small},
                                                   {"lumped", "output.interval=1e-6", "time.beats=1000"}}) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"run", scene, "--out", "r", "--quiet", "--tier", settings[0]};
    for (std::size_t k = 1; k < settings.size(); ++k)
      arguments.insert(arguments.end(), {"--set", settings[k]});
    const Ended ended = test_support::tunica(arguments, folder.path());
    EXPECT_EQ(ended.code, 2) << ended.errors;
    EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
    for (const std::string& word : {settings[1].substr(0, settings[1].find('=')), std::string("increase it")})
      EXPECT_NE(ended.errors.find(word), std::string::npos) << ended.errors;
    EXPECT_TRUE(fs::is_empty(folder.path())) << "something was written";
  }
}

TEST(Faults, UnwritableFolderIsTold) {
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::all);
  const fs::path locked = folder.path() / "locked";
  fs::create_directory(locked);
  fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::group_exec |
                              fs::perms::others_read | fs::perms::others_exec);
  // Permissions do not bind root, so the program runs as nobody.
  const auto as_nobody = [] {
    if (::geteuid() == 0 && (::setgid(65534) != 0 || ::setuid(65534) != 0)) ::_exit(124);
  };
  // The program itself has to be reachable for nobody.
  const fs::path program = folder.path() / "tunica";
  fs::copy_file(TUNICA_PROGRAM, program);
  fs::copy_file(scene, folder.path() / "cylinder.toml");
  Program run({program, "run", folder.path() / "cylinder.toml", "--out", locked / "r", "--quiet"},
              folder.path(), as_nobody);
  const int code = run.wait();
  EXPECT_EQ(code, 2) << run.errors();
  EXPECT_TRUE(is_one_line(run.errors())) << run.errors();
  EXPECT_NE(run.errors().find("Permission denied"), std::string::npos) << run.errors();
  EXPECT_TRUE(fs::is_empty(locked));
}

TEST(Faults, FileInPlaceOfTheFolderIsTold) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "r") << "mine";
  const Ended ended = test_support::tunica({"run", scene, "--out", "r", "--quiet"}, folder.path());
  EXPECT_EQ(ended.code, 2);
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  EXPECT_EQ(read_text(folder.path() / "r"), "mine");
}

}  // namespace
}  // namespace tunica
