// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of the 2D tier that end before their end: kill -9, Ctrl-C, no room, damage, and walls, meshes and
// steps that cannot be computed with.
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
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
using Arguments = std::vector<std::string>;

const std::string scene = std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml";

/// A run of the paper's cylinder into "r" on a coarse mesh that its settings may change.
Arguments run_with(const Arguments& settings, const Arguments& more = {}) {
  Arguments all{"run", scene, "--tier", "axisym", "--out", "r", "--quiet", "--no-report"};
  all.insert(all.end(), more.begin(), more.end());
  for (const char* coarse : {"mesh.wall_cells=1", "mesh.blood_cells=2", "mesh.axial_cells=8"})
    all.insert(all.end(), {"--set", coarse});
  for (const auto& setting : settings) all.insert(all.end(), {"--set", setting});
  return all;
}

/// The program on so many of the machine's cores, each of which it gives a thread.
Arguments program_with(int cores, const Arguments& arguments) {
  Arguments all{"/usr/bin/env", "taskset", "--cpu-list", "0-" + std::to_string(cores - 1), TUNICA_PROGRAM};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

/// Every file of two folders is the same, but for what no two runs share in record.json.
void expect_same_results(const fs::path& a, const fs::path& b) {
  const auto files = [](const fs::path& folder) {
    std::vector<fs::path> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) all.push_back(fs::relative(entry.path(), folder));
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(files(a), files(b));
  for (const fs::path& file : files(a)) {
    if (file != "record.json") {
      EXPECT_TRUE(read_text(a / file) == read_text(b / file)) << file << " differs";
      continue;
    }
    auto x = read_result(a).record, y = read_result(b).record;
    for (auto* record : {&x, &y})
      for (const char* key : {"seconds", "peak_memory_bytes"}) record->erase(key);
    EXPECT_EQ(x, y);
  }
}

struct Interruption {
  const char* name;
  Arguments settings;
};

class InterruptedAxisym : public testing::TestWithParam<Interruption> {
 protected:
  void SetUp() override {
    const auto start = Clock::now();
    Program whole(program_with(1, run_with(GetParam().settings)), whole_.path());
    ASSERT_EQ(whole.wait(), 0) << whole.errors();
    duration_ = std::chrono::duration<double>(Clock::now() - start).count();
  }
  void expect_resumed(const fs::path& folder) const {
    const Ended ended = test_support::tunica(run_with(GetParam().settings, {"--resume"}), folder);
    EXPECT_EQ(ended.code, 0) << ended.errors;
    EXPECT_EQ(broken_file(folder / "r"), "");
    EXPECT_FALSE(fs::exists(folder / "r/checkpoint"));
    expect_same_results(whole_.path() / "r", folder / "r");
  }
  TemporaryFolder whole_;
  double duration_ = 0;
};

TEST_P(InterruptedAxisym, ByKillAtTenRandomMomentsItEndsAlike) {
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << ", a run takes " << duration_ << " s\n";
  std::mt19937 random(seed);
  constexpr int kills = 10;
  const TemporaryFolder folder;
  int resumed = 0;
  // Threads take turns: sums do not depend on them.
  for (int killed = 0, tried = 0; killed < kills && tried < 3 * kills; ++tried) {
    const bool goes_on = fs::exists(folder.path() / "r/checkpoint");
    resumed += goes_on ? 1 : 0;
    Program program(program_with(1 + tried % 2, run_with(GetParam().settings, {"--resume"})), folder.path());
    std::this_thread::sleep_for(
        std::chrono::duration<double>(std::uniform_real_distribution(0.0, 0.4 * duration_)(random)));
    program.send(SIGKILL);
    const int code = program.wait();
    EXPECT_EQ(broken_file(folder.path() / "r"), "") << "seed " << seed;
    if (code == 256 + SIGKILL) {
      ++killed;
      continue;
    }
    // It was through before: the next begins anew.
    EXPECT_EQ(code, 0) << program.errors();
    expect_same_results(whole_.path() / "r", folder.path() / "r");
    fs::remove_all(folder.path() / "r");
  }
  EXPECT_GE(resumed, 1) << "seed " << seed;
  expect_resumed(folder.path());
}

TEST_P(InterruptedAxisym, BySigintItKeepsWhatItHasAndResumes) {
  const TemporaryFolder folder;
  int code = 0;
  std::string errors;
  // A run that has come to writing its files finishes, so an early try may be late on a busy machine.
  for (double share = 0.5; share > 0.01 && code == 0; share *= 0.5) {
    std::error_code ignored;
    fs::remove_all(folder.path() / "r", ignored);
    Program program(program_with(1, run_with(GetParam().settings)), folder.path());
    while (program.running() && !fs::exists(folder.path() / "r")) std::this_thread::sleep_for(100us);
    std::this_thread::sleep_for(std::chrono::duration<double>(share * duration_));
    program.send(SIGINT);
    code = program.wait();
    errors = program.errors();
  }
  ASSERT_EQ(code, 130) << errors;
  EXPECT_TRUE(is_one_line(errors)) << errors;
  EXPECT_NE(errors.find("--resume"), std::string::npos) << errors;
  EXPECT_EQ(broken_file(folder.path() / "r"), "");
  EXPECT_EQ(read_result(folder.path() / "r").record.at("interrupted"), true);
  const std::string whole = read_text(whole_.path() / "r/observables.csv"),
                    part = read_text(folder.path() / "r/observables.csv");
  EXPECT_LT(part.size(), whole.size());
  EXPECT_TRUE(whole.starts_with(part)) << "the rows so far are those of the whole run";
  expect_resumed(folder.path());
}

INSTANTIATE_TEST_SUITE_P(, InterruptedAxisym,
                         testing::Values(Interruption{"rest", {"accuracy.tolerance=1e-3", "time.beats=3"}},
                                         Interruption{"periodic",
                                                      {"time.start=periodic", "outlet.kind=rcr",
                                                       "time.beats=8", "time.step=5e-3"}}),
                         [](const auto& instance) { return instance.param.name; });

TEST(AxisymFaults, ResultsDoNotDependOnThreads) {
  // 1012 cells: from 500 on they are shared among threads.
  const Arguments settings{
      "mesh.wall_cells=4", "mesh.blood_cells=7", "mesh.axial_cells=92",     "time.beats=1",
      "time.ramp=0.2",     "inlet.period=0.04",  "output.profile_times=[]", "time.step=5e-3"};
  const TemporaryFolder one, two;
  EXPECT_EQ(Program(program_with(1, run_with(settings)), one.path()).wait(), 0);
  EXPECT_EQ(Program(program_with(2, run_with(settings)), two.path()).wait(), 0);
  expect_same_results(one.path() / "r", two.path() / "r");
}

TEST(AxisymFaults, DamagedCheckpointsAreRefused) {
  const Arguments settings{"time.beats=40"};
  const TemporaryFolder folder;
  const fs::path checkpoint = folder.path() / "r/checkpoint";
  Program program(program_with(1, run_with(settings)), folder.path());
  while (program.running() && !fs::exists(checkpoint)) std::this_thread::sleep_for(1ms);
  program.send(SIGINT);
  ASSERT_EQ(program.wait(), 130) << program.errors();
  const std::string sound = read_text(checkpoint), before = read_text(folder.path() / "r/observables.csv");
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  const auto place = [&] { return std::uniform_int_distribution<std::size_t>(0, sound.size() - 1)(random); };
  for (int k = 0; k < 12; ++k) {
    std::string damaged = sound;
    if (k % 3 == 0)
      damaged.resize(place());
    else if (k % 3 == 1)
      damaged[place()] ^= static_cast<char>(1 << (k % 8));
    else
      damaged.insert(place(), "damage");
    std::ofstream(checkpoint, std::ios::binary) << damaged;
    const Ended ended = test_support::tunica(run_with(settings, {"--resume"}), folder.path());
    EXPECT_EQ(ended.code, 2) << ended.errors << "seed " << seed << ", " << k;
    EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
    EXPECT_NE(ended.errors.find("checkpoint"), std::string::npos) << ended.errors;
    EXPECT_NE(ended.errors.find("leave out --resume"), std::string::npos) << ended.errors;
    EXPECT_TRUE(read_text(folder.path() / "r/observables.csv") == before);
  }
}

TEST(AxisymFaults, FullDiskIsToldAndLeavesNoHalfFile) {
  const TemporaryFolder folder;
  const fs::path disk = folder.path() / "disk";
  fs::create_directory(disk);
  const bool mounted = ::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=128k") == 0;
  // Where mounting is not allowed, a limit on the size of files stands for a full disk.
  const auto limit = [mounted] {
    if (mounted) return;
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit size{100'000, 100'000};
    ::setrlimit(RLIMIT_FSIZE, &size);
  };
  Arguments arguments = run_with({"time.beats=1", "time.step=0.01"});
  std::replace(arguments.begin(), arguments.end(), std::string("r"), (disk / "r").string());
  const Ended ended = test_support::tunica(arguments, folder.path(), limit);
  const std::string broken = broken_file(disk / "r");
  const bool recorded = fs::exists(disk / "r/record.json");
  if (mounted) ::umount(disk.c_str());
  EXPECT_EQ(ended.code, 2);
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  EXPECT_NE(ended.errors.find(mounted ? "No space left" : "File too large"), std::string::npos)
      << ended.errors;
  EXPECT_EQ(broken, "");
  EXPECT_FALSE(recorded) << "a record beside files that are missing";
}

/// What cannot be computed, and what is said about it.
struct Fault {
  const char* name;
  Arguments settings;
  Arguments words;
};

class AxisymGivesUp : public testing::TestWithParam<Fault> {};

TEST_P(AxisymGivesUp, SayingWhenWhereAndWhyAndKeepsTheResults) {
  const TemporaryFolder folder;
  const Ended ended = test_support::tunica(run_with(GetParam().settings), folder.path());
  ASSERT_EQ(ended.code, 3) << ended.errors;
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  EXPECT_EQ(broken_file(folder.path() / "r"), "");
  const StoredResult stored = read_result(folder.path() / "r");
  EXPECT_EQ(stored.record.at("converged"), false);
  EXPECT_EQ(stored.record.at("interrupted"), false);
  const std::string failure = stored.record.at("failure");
  EXPECT_NE(ended.errors.find("the solver gave up " + failure), std::string::npos) << ended.errors;
  EXPECT_NE(ended.errors.find("results up to there are in r"), std::string::npos) << ended.errors;
  for (const std::string& word : GetParam().words)
    EXPECT_NE(failure.find(word), std::string::npos) << "'" << word << "' is not in: " << failure;
  // Bounded work: tens of attempts of at most 60 iterations, and some thousand in searches for a static
  // state.
  EXPECT_LT(stored.record.at("newton_iterations"), 20000);
  const auto& table = stored.result.observables;
  for (const auto& column : table.columns())
    for (const double value : column.values)
      EXPECT_TRUE(std::isfinite(value) || observables::is_none(value)) << column.name;
  if (!failure.starts_with("at t = ") || failure.find("static start") != std::string::npos) {
    EXPECT_EQ(table.rows(), 0U);
    return;
  }
  // Rows come every millisecond.
  const double time = std::stod(failure.substr(failure.find("t = ") + 4));
  ASSERT_GT(table.rows(), 0U);
  EXPECT_LE(table.find("time")->values.back(), time);
  EXPECT_GT(table.find("time")->values.back(), time - 1.01e-3);
  // The same again from the last checkpoint, if there is one.
  const std::string before = read_text(folder.path() / "r/observables.csv");
  const Ended again = test_support::tunica(run_with(GetParam().settings, {"--resume"}), folder.path());
  EXPECT_EQ(again.code, 3);
  EXPECT_EQ(again.errors, ended.errors);
  EXPECT_TRUE(read_text(folder.path() / "r/observables.csv") == before);
}

// A neo-Hookean wall that nothing holds carries 15 mmHg, mu ln(R_o/R_i), and a little less where it is looked
// for, at a fourfold lumen. The clamped ends of short tubes help little.
const char* const nothing_holds = "tether.stiffness=0";
INSTANTIATE_TEST_SUITE_P(
    , AxisymGivesUp,
    testing::Values(
        Fault{"balloon",
              {"wall.law=neo-Hookean", nothing_holds},
              {"at t = 0.", "(beat 1)", "r = ", "z = ", "cell", "as a ring it carries at most 14.7"}},
        Fault{"balloon_in_long_steps",
              {"wall.law=neo-Hookean", nothing_holds, "time.step=0.05"},
              {"at t = 0.", "(beat 1)", "r = ", "z = ", "cell", "as a ring it carries at most 14.7"}},
        Fault{"static_balloon",
              {"wall.law=neo-Hookean", nothing_holds, "time.mode=static", "inlet.waveform=pressure"},
              {"in the static state", "no static equilibrium was found beyond", "% of the load",
               "of 100 mmHg", "r = ", "z = ", "cell", "as a ring it carries at most 14.7"}},
        Fault{"static_start_of_a_balloon",
              {"wall.law=neo-Hookean", nothing_holds, "time.start=periodic"},
              {"at t = 0 s, in the static start", "% of the load", "carries at most 14.7"}},
        Fault{"collapse",
              {nothing_holds, "inlet.waveform=pressure", "inlet.pressure=-100 mmHg"},
              {"at t = 0.0", "blood's mesh is", "r = ", "z = ", "cell", "beside a clamped end",
               "geometry.ends = \"sliding\""}},
        Fault{"static_start_of_a_collapse",
              {nothing_holds, "inlet.waveform=pressure", "inlet.pressure=-100 mmHg", "time.start=static"},
              {"in the static start", "% of the load", "of -100 mmHg", "r = ", "z = ", "cell"}},
        Fault{"pressure_that_tangles",
              {"outlet.resistance=2e7"},
              {"at t = 0.", "blood's mesh is", "r = ", "z = ", "cell"}},
        Fault{"soft_wall_that_tangles",
              {"outlet.resistance=2e7", "tether.stiffness=1e5", "wall.law=EXP1", "geometry.ends=sliding",
               "inlet.profile=natural"},
              {"at t = 0.", "r = ", "z = ", "cell"}},
        Fault{
            "pressure_that_comes_at_once",
            {"time.ramp=0", "inlet.waveform=pressure", "inlet.pressure=100 mmHg",
             "inlet.pressure_kind=static"},
            {"at t = ", "(beat 1)", "r = ", "z = ", "cell", "with time.ramp = 0 s the load comes as a blow"}},
        Fault{"blow",
              {"time.ramp=0", "inlet.waveform=pressure", "inlet.pressure=-9e6", "wall.law=EXP1"},
              {"(beat 1)", "smallest time step", "turned inside out", "cell", "time.ramp = 0"}}),
    [](const auto& instance) { return instance.param.name; });

/// A scene drawn from wide ranges: most of them are no artery.
Arguments random_scene(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    const double value = std::exp(std::uniform_real_distribution(std::log(low), std::log(high))(random));
    return std::to_string(value);
  };
  const auto one_of = [&](std::initializer_list<const char*> choices) {
    return std::string(
        choices.begin()[std::uniform_int_distribution<std::size_t>(0, choices.size() - 1)(random)]);
  };
  const std::string radius = between(0.02, 0.3);
  return {"geometry.radius=" + radius,
          "geometry.thickness=" + std::to_string(std::stod(radius) * std::stod(between(0.05, 1))),
          "geometry.length=" + std::to_string(std::stod(radius) * std::stod(between(2, 40))),
          "geometry.ends=" + one_of({"clamped", "clamped", "sliding"}),
          "wall.law=" + one_of({"EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS", "neo-Hookean",
                                "neo-Hookean-compressible", "St-Venant-Kirchhoff", "linear-elastic"}),
          "wall.bulk_modulus=" + between(1e6, 1e8),
          "tether.stiffness=" + one_of({"0", "1e5", "1e7", "1e9"}),
          "tether.traction=" + one_of({"normal", "reference", "current"}),
          "inlet.waveform=" + one_of({"ica", "constant", "pressure", "pulse"}),
          "inlet.period=" + between(0.1, 1),
          "inlet.profile=" + one_of({"parabolic", "natural"}),
          "outlet.kind=" + one_of({"resistance", "rcr"}),
          "outlet.resistance=" + between(1e2, 1e8),
          "outlet.backflow=0.5",
          "blood.viscosity=" + between(0.01, 1),
          "time.beats=1",
          "time.mode=" + one_of({"transient", "transient", "static"}),
          "time.start=" + one_of({"rest", "static", "periodic"}),
          "time.ramp=" + between(1e-3, 0.1),
          "time.scheme=" + one_of({"bdf2", "backward-euler", "generalized-alpha"}),
          "time.step=" + one_of({"0", "1e-3", "1e-2", "5e-2"}),
          "mesh.element=" + one_of({"quadratic", "linear", "bubble"}),
          "mesh.cell=" + one_of({"quadrilateral", "triangle"}),
          "mesh.mixed_wall=" + one_of({"true", "false"}),
          one_of({"mesh.motion=harmonic", "mesh.motion=stiffened", "output.interval=0.05"}),
          "output.interval=0.05"};
}

TEST(AxisymFaults, RandomScenesEndInOrder) {
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  int codes[4] = {};
  for (int k = 0; k < 10; ++k) {
    const Arguments settings = random_scene(random);
    std::string trace = "seed " + std::to_string(seed) + ", scene " + std::to_string(k);
    for (const auto& setting : settings) trace += "\n  --set " + setting;
    SCOPED_TRACE(trace);
    const TemporaryFolder folder;
    Program program(program_with(1, run_with(settings)), folder.path());
    const auto began = Clock::now();
    while (program.running() && Clock::now() - began < 15s) std::this_thread::sleep_for(5ms);
    // What is merely slow ends when it is asked to.
    const bool asked = program.running();
    program.send(SIGINT);
    const int code = program.wait();
    if (asked && code == 130) continue;
    ASSERT_TRUE(code == 0 || code == 2 || code == 3) << code << ": " << program.errors();
    ++codes[code];
    EXPECT_EQ(is_one_line(program.errors()), code != 0) << program.errors();
    EXPECT_EQ(program.errors().find("internal error"), std::string::npos) << program.errors();
    EXPECT_EQ(fs::exists(folder.path() / "r"), code != 2);
    EXPECT_EQ(broken_file(folder.path() / "r"), "");
    if (code == 2) continue;
    const StoredResult stored = read_result(folder.path() / "r");
    EXPECT_EQ(stored.record.at("converged"), code == 0);
    for (const auto& column : stored.result.observables.columns())
      for (const double value : column.values)
        EXPECT_TRUE(std::isfinite(value) || observables::is_none(value)) << column.name;
  }
  std::cout << codes[0] << " done, " << codes[2] << " refused, " << codes[3] << " given up\n";
}

}  // namespace
}  // namespace tunica
