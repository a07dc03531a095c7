// SPDX-License-Identifier: GPL-3.0-or-later
// The 3D tier as users run it, by one process and by mpirun: numbers of ranks, kill -9 and --resume, bad
// input, walls and steps that cannot be computed with, and light tiers that stay light.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
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
using Arguments = std::vector<std::string>;

const fs::path scenes = fs::path(TUNICA_SOURCE_DIR) / "scenes";

/// Arguments of a run into "r" on the fewest cells.
Arguments run_with(const Arguments& settings, const Arguments& more = {}, const char* scene = "cylinder") {
  Arguments all{
      "run",        scenes / (std::string(scene) + ".toml"), "--tier", "full3d", "--out", "r", "--quiet",
      "--no-report"};
  all.insert(all.end(), more.begin(), more.end());
  for (const char* coarse : {"mesh.wall_cells=1", "mesh.blood_cells=1", "mesh.axial_cells=6",
                             "mesh.around_cells=8", "output.field_interval=0"})
    all.insert(all.end(), {"--set", coarse});
  for (const auto& setting : settings) all.insert(all.end(), {"--set", setting});
  return all;
}

/// tunica by mpirun on so many ranks, which may be more than there are cores, and whoever runs the tests.
Arguments on_ranks(int ranks, const Arguments& arguments) {
  Arguments all{"/usr/bin/env",
                "OMPI_ALLOW_RUN_AS_ROOT=1",
                "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                "OMPI_MCA_rmaps_base_oversubscribe=1",
                "OMPI_MCA_mpi_yield_when_idle=1",
                "OMP_NUM_THREADS=1",
                TUNICA_MPIRUN,
                "-n",
                std::to_string(ranks),
                TUNICA_PROGRAM};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

Ended run(const Arguments& arguments, const fs::path& folder) {
  Program program(arguments, folder);
  const int code = program.wait();
  return {code, program.output(), program.errors()};
}

/// Greatest difference between the observables of two folders of results, by the range of the column.
double difference(const fs::path& a, const fs::path& b) {
  const auto x = read_result(a).result.observables, y = read_result(b).result.observables;
  EXPECT_EQ(x.rows(), y.rows());
  EXPECT_EQ(x.columns().size(), y.columns().size());
  double greatest = 0;
  for (const auto& column : x.columns()) {
    const auto& values = column.values;
    const auto& others = y.find(column.name)->values;
    double most = 0;
    for (const double value : values)
      if (!observables::is_none(value)) most = std::max(most, std::abs(value));
    for (std::size_t k = 0; k < std::min(values.size(), others.size()); ++k) {
      EXPECT_EQ(observables::is_none(values[k]), observables::is_none(others[k])) << column.name;
      if (!observables::is_none(values[k]) && most > 0)
        greatest = std::max(greatest, std::abs(values[k] - others[k]) / most);
    }
  }
  return greatest;
}

const Arguments one_beat{"time.beats=1", "time.step=0.01"};
const Arguments two_beats{"time.beats=2", "time.step=0.01"};

TEST(Ranks, DoNotChangeResults) {
  const TemporaryFolder alone;
  ASSERT_EQ(test_support::tunica(run_with(one_beat), alone.path()).code, 0);
  for (const int ranks : {1, 2, 3}) {
    const TemporaryFolder shared;
    const Ended ended = run(on_ranks(ranks, run_with(one_beat)), shared.path());
    ASSERT_EQ(ended.code, 0) << ended.errors;
    EXPECT_EQ(ended.output + ended.errors, "");
    EXPECT_EQ(read_result(shared.path() / "r").record.at("resolution").at("ranks"), ranks);
    // Sums are rounded by their order, and iterations end far below what is looked for.
    EXPECT_LT(difference(alone.path() / "r", shared.path() / "r"), ranks == 1 ? 1e-300 : 1e-8) << ranks;
    if (ranks > 1) continue;
    EXPECT_TRUE(read_text(alone.path() / "r/observables.csv") ==
                read_text(shared.path() / "r/observables.csv"));
  }
}

TEST(Ranks, TorusWithRecruitmentIsTheSameOnAny) {
  const Arguments settings{"geometry.length=0.22", "geometry.bend_angle=60", "inlet.period=0.4",
                           "time.ramp=0.1",        "time.step=0.02",         "time.beats=1"};
  const TemporaryFolder one, two;
  ASSERT_EQ(test_support::tunica(run_with(settings, {}, "torus"), one.path()).code, 0);
  ASSERT_EQ(run(on_ranks(2, run_with(settings, {}, "torus")), two.path()).code, 0);
  // The switch of recruitment, of sharpness 5e5, multiplies what sums differ by.
  EXPECT_LT(difference(one.path() / "r", two.path() / "r"), 1e-8);
  EXPECT_GT(read_result(one.path() / "r").result.events.rows(), 0U) << "nothing is recruited";
}

TEST(Record, HoldsTheMedianTimeOfAStepOfTiersWithMeshes) {
  for (const std::string tier : {"lumped", "axisym", "full3d"}) {
    const TemporaryFolder folder;
    Arguments arguments = run_with(one_beat);
    *(std::find(arguments.begin(), arguments.end(), "--tier") + 1) = tier;
    const Ended ended = test_support::tunica(arguments, folder.path());
    ASSERT_EQ(ended.code, 0) << ended.errors;
    const auto record = read_result(folder.path() / "r").record;
    const auto& seconds = record.at("seconds");
    ASSERT_EQ(seconds.contains("median_step"), tier != "lumped");
    if (tier == "lumped") continue;
    const double median = seconds.at("median_step"), solve = seconds.at("solve"), steps = record.at("steps");
    // Half of the steps take as long or longer; none is computed within a microsecond.
    EXPECT_LE(median * steps / 2, solve) << tier;
    EXPECT_GT(median, 1e-6) << tier;
  }
}

TEST(Ranks, MeshFromAFileIsTheSameOnAny) {
  const auto arguments = [](const char* out) {
    Arguments all{"run", scenes / "tapering_bend.toml", "--out", out, "--quiet", "--no-report"};
    for (const char* setting : {"inlet.waveform=constant", "inlet.flow=0.02", "inlet.period=0.05",
                                "time.step=0.02", "output.interval=0.02", "output.field_interval=0"})
      all.insert(all.end(), {"--set", setting});
    return all;
  };
  const TemporaryFolder folder;
  const Ended one = test_support::tunica(arguments("one"), folder.path());
  ASSERT_EQ(one.code, 0) << one.errors;
  const Ended two = run(on_ranks(2, arguments("two")), folder.path());
  ASSERT_EQ(two.code, 0) << two.errors;
  EXPECT_LT(difference(folder.path() / "one", folder.path() / "two"), 1e-8);
}

TEST(MeshInSpace, IsNotForTheTiersOfFewerDimensions) {
  const TemporaryFolder folder;
  for (const char* tier : {"lumped", "axisym"}) {
    const Ended ended = test_support::tunica(
        {"run", scenes / "tapering_bend.toml", "--tier", tier, "--out", "r", "--quiet"}, folder.path());
    EXPECT_EQ(ended.code, 2) << ended.errors;
    EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
    EXPECT_NE(ended.errors.find("full3d"), std::string::npos) << ended.errors;
  }
}

TEST(Ranks, FindTheSameLeastMode) {
  const Arguments settings{"time.mode=static",      "inlet.waveform=pressure", "inlet.pressure=100 mmHg",
                           "geometry.length=0.1",   "wall.law=EXP1+EXP2-FS",   "tether.traction=reference",
                           "inlet.profile=natural", "geometry.ends=sliding"};
  std::vector<nlohmann::json> records;
  for (const int ranks : {1, 2}) {
    const TemporaryFolder folder;
    const Ended ended = run(on_ranks(ranks, run_with(settings)), folder.path());
    ASSERT_EQ(ended.code, 0) << ended.errors;
    records.push_back(read_result(folder.path() / "r").record);
  }
  for (const char* number : {"negative_pivots", "least_eigenvalue"}) {
    // Signs are counted: bisection ends at the same number.
    EXPECT_EQ(records[0].at("resolution").at(number), records[1].at("resolution").at(number)) << number;
  }
  EXPECT_EQ(records[0].at("findings"), records[1].at("findings"));
}

/// Processes that one has started, by their rank in the world; 0 for ranks that are not there.
pid_t process_of_rank(pid_t parent, int rank) {
  std::ifstream children("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children");
  const std::string mark = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
  for (pid_t child = 0; children >> child;) {
    std::istringstream environment(read_text("/proc/" + std::to_string(child) + "/environ"));
    for (std::string variable; std::getline(environment, variable, '\0');)
      if (variable == mark) return child;
  }
  return 0;
}

struct Kill {
  const char* name;
  int ranks, rank;  ///< rank -1: mpirun itself
  int resumed_on;   ///< 0: without mpirun
};
class KilledRanks : public testing::TestWithParam<Kill> {};

TEST_P(KilledRanks, LeaveACheckpointThatAnyNumberOfRanksGoesOnFrom) {
  const TemporaryFolder whole, folder;
  ASSERT_EQ(test_support::tunica(run_with(two_beats), whole.path()).code, 0);
  const auto& [name, ranks, rank, resumed_on] = GetParam();
  {
    Program program(on_ranks(ranks, run_with(two_beats)), folder.path());
    while (program.running() && !fs::exists(folder.path() / "r/checkpoint")) std::this_thread::sleep_for(5ms);
    ASSERT_TRUE(program.running()) << program.errors();
    if (rank < 0) {
      program.send(SIGKILL);
      EXPECT_EQ(program.wait(), 256 + SIGKILL);
    } else {
      const pid_t victim = process_of_rank(program.id(), rank);
      ASSERT_GT(victim, 0);
      ASSERT_EQ(::kill(victim, SIGKILL), 0);
      const int code = program.wait();
      EXPECT_NE(code, 0);
      EXPECT_LT(code, 256) << "mpirun ends by itself";
      EXPECT_NE(program.errors().find("signal 9"), std::string::npos) << program.errors();
    }
  }
  EXPECT_EQ(broken_file(folder.path() / "r"), "");
  ASSERT_TRUE(fs::exists(folder.path() / "r/checkpoint"));
  EXPECT_FALSE(fs::exists(folder.path() / "r/record.json"));
  const Arguments again = run_with(two_beats, {"--resume"});
  const Ended ended = resumed_on == 0 ? test_support::tunica(again, folder.path())
                                      : run(on_ranks(resumed_on, again), folder.path());
  ASSERT_EQ(ended.code, 0) << ended.errors;
  EXPECT_FALSE(fs::exists(folder.path() / "r/checkpoint"));
  EXPECT_LT(difference(whole.path() / "r", folder.path() / "r"), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(, KilledRanks,
                         testing::Values(Kill{"leader", 2, 0, 2}, Kill{"other", 2, 1, 0},
                                         Kill{"mpirun", 2, -1, 3}),
                         [](const auto& instance) { return instance.param.name; });

TEST(KilledRun, OfOneProcessEndsAlikeToTheLastBit) {
  const TemporaryFolder whole, folder;
  ASSERT_EQ(test_support::tunica(run_with(two_beats), whole.path()).code, 0);
  Arguments arguments = run_with(two_beats);
  arguments.insert(arguments.begin(), TUNICA_PROGRAM);
  {
    Program program(arguments, folder.path());
    while (program.running() && !fs::exists(folder.path() / "r/checkpoint")) std::this_thread::sleep_for(2ms);
    program.send(SIGKILL);
    ASSERT_EQ(program.wait(), 256 + SIGKILL) << program.errors();
  }
  const Ended ended = test_support::tunica(run_with(two_beats, {"--resume"}), folder.path());
  ASSERT_EQ(ended.code, 0) << ended.errors;
  for (const char* file : {"observables.csv", "events.csv", "profiles.csv", "along.csv"})
    EXPECT_TRUE(read_text(whole.path() / "r" / file) == read_text(folder.path() / "r" / file)) << file;
}

// Nobody says which tier: tetrahedra are no half plane, whatever they are called.
TEST(MeshWithoutNames, IsRefusedAsTheVesselInSpaceThatItIs) {
  const TemporaryFolder folder;
  std::string text = read_text(fs::path(TUNICA_SOURCE_DIR) / "tests" / "meshes" / "square_tube_2_2.msh");
  const std::size_t begin = text.find("$PhysicalNames"), end = text.find("$Nodes");
  std::ofstream(folder.path() / "tube.msh") << text.erase(begin, end - begin);
  std::ofstream(folder.path() / "tube.toml")
      << "[geometry]\nkind = \"mesh\"\nfile = \"tube.msh\"\nradius = 0.5\n";
  const Ended ended = test_support::tunica({"run", "tube.toml", "--out", "r", "--quiet"}, folder.path());
  EXPECT_EQ(ended.code, 2) << ended.errors;
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  for (const char* words : {"physical volumes 1, 2 and physical surfaces 3, 4, 5, 6, 7, and no names",
                            "name the volumes \"blood\""})
    EXPECT_NE(ended.errors.find(words), std::string::npos) << ended.errors;
  EXPECT_FALSE(fs::exists(folder.path() / "r"));
}

const std::string bend = (scenes / "tapering_bend.msh").string();

struct Bad {
  const char* name;
  Arguments settings, words;
};
class RefusedInSpace : public testing::TestWithParam<Bad> {};

TEST_P(RefusedInSpace, WithOneLineBeforeAnyWorkOnAnyNumberOfRanks) {
  const TemporaryFolder folder;
  const Ended ended = test_support::tunica(run_with(GetParam().settings), folder.path());
  EXPECT_EQ(ended.code, 2) << ended.errors;
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  for (const auto& word : GetParam().words)
    EXPECT_NE(ended.errors.find(word), std::string::npos) << "'" << word << "' is not in: " << ended.errors;
  const Ended shared = run(on_ranks(2, run_with(GetParam().settings)), folder.path());
  EXPECT_EQ(shared.code, 2) << shared.errors;
  // mpirun adds lines of its own.
  const auto first = shared.errors.find(ended.errors);
  ASSERT_NE(first, std::string::npos) << shared.errors;
  EXPECT_EQ(shared.errors.find("tunica: ", first + 1), std::string::npos) << shared.errors;
  EXPECT_TRUE(fs::is_empty(folder.path())) << "something was written";
}

INSTANTIATE_TEST_SUITE_P(
    , RefusedInSpace,
    testing::Values(
        Bad{"sliding_torus", {"geometry.kind=torus", "geometry.ends=sliding"}, {"sliding", "clamped"}},
        Bad{"quarter_of_a_torus",
            {"geometry.kind=torus", "mesh.symmetry=quarter"},
            {"mesh.symmetry", "write \"half\""}},
        Bad{"half_of_one_that_is_not_balanced",
            {"mesh.symmetry=half", "wall.families=[{angle=40, weight=2}]"},
            {"mesh.symmetry", "wall.families", "\"full\""}},
        Bad{"cells_around", {"mesh.around_cells=12"}, {"mesh.around_cells = 12", "take 16"}},
        Bad{"mesh_of_a_half_plane",
            {"geometry.kind=mesh", "geometry.file=" + (scenes / "stenosis.msh").string()},
            {"geometry.kind", "axisym", "torus"}},
        Bad{"mesh_that_is_not_there",
            {"geometry.kind=mesh", "geometry.file=none.msh"},
            {"none.msh does not exist"}},
        Bad{"mesh_in_another_unit",
            {"geometry.kind=mesh", "geometry.file=" + bend, "geometry.radius=0.0033"},
            {"radius at the inlet", "probably in millimetres"}},
        Bad{"mesh_of_hexahedra_for_bubbles",
            {"geometry.kind=mesh", "geometry.file=" + bend, "mesh.element=bubble"},
            {"mesh.element", "needs tetrahedra", "\"quadratic\""}},
        Bad{"mesh_without_the_layers",
            {"geometry.kind=mesh", "geometry.file=" + bend, "wall.layers=[{fraction=0.5}, {fraction=0.5}]"},
            {"geometry.file has 1 layer of the wall", "the scene describes 2", "[[wall.layers]]"}},
        Bad{"tight_bend",
            {"geometry.kind=torus", "geometry.bend_angle=350", "geometry.length=0.2"},
            {"geometry.bend_angle = 350 deg", "outer radius"}},
        Bad{"cells_that_turn_too_far",
            {"geometry.kind=torus", "geometry.bend_angle=180"},
            {"mesh.axial_cells = 6", "raise mesh.axial_cells"}},
        Bad{"options_that_are_none", {"solver.options=nonsense"}, {"solver.options", "-ksp_rtol"}},
        Bad{"solver_that_petsc_has_not",
            {"solver.options=-ksp_type nonsense"},
            {"solver.options", "-ksp_type nonsense", "PETSc refuses"}},
        Bad{"factors_that_petsc_has_not",
            {"solver.options=-pc_factor_mat_solver_type nonsense"},
            {"solver.options", "PETSc refuses"}},
        Bad{"preconditioner_of_parts_that_petsc_has_not",
            {"solver.method=schwarz", "solver.options=-sub_pc_type ILU"},
            {"solver.options", "-sub_pc_type ILU", "did you mean ilu?"}},
        Bad{"preconditioner_of_a_block_that_petsc_has_not",
            {"solver.method=block", "solver.options=-fieldsplit_pressure_pc_type ILU"},
            {"solver.options", "-fieldsplit_pressure_pc_type ILU", "did you mean ilu?"}},
        Bad{"factors_of_parts_that_spoil_memory",
            {"solver.method=schwarz", "solver.options=-sub_pc_factor_mat_solver_type superlu_dist"},
            {"solver.options", "superlu_dist", "write umfpack"}},
        Bad{"pictures_without_number",
            {"output.field_interval=1.7e-5"},
            {"output.field_interval", "pictures", "0 for none"}}),
    [](const auto& instance) { return instance.param.name; });

// The environment goes before the scene, on every level.
TEST(Options, OfTheEnvironmentAreRefusedLikeThoseOfTheScene) {
  const TemporaryFolder folder;
  Arguments arguments = run_with({"solver.method=schwarz"});
  arguments.insert(arguments.begin(), {"/usr/bin/env", "PETSC_OPTIONS=-sub_pc_type ILU", TUNICA_PROGRAM});
  const Ended ended = run(arguments, folder.path());
  EXPECT_EQ(ended.code, 2) << ended.errors;
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  for (const char* word : {"PETSC_OPTIONS", "-sub_pc_type ILU", "did you mean ilu?"})
    EXPECT_NE(ended.errors.find(word), std::string::npos) << ended.errors;
  EXPECT_TRUE(fs::is_empty(folder.path())) << "something was written";
}

TEST(Options, ThatNothingAsksForAreNamed) {
  const TemporaryFolder folder;
  Arguments arguments = run_with({"solver.options=-ksp_rtoll 1e-9", "inlet.period=0.02", "time.step=0.01",
                                  "time.beats=1", "inlet.flow=1e-3"});
  std::erase(arguments, "--quiet");
  const Ended ended = test_support::tunica(arguments, folder.path());
  EXPECT_EQ(ended.code, 0) << ended.errors;
  EXPECT_NE(ended.errors.find("does not ask for -ksp_rtoll"), std::string::npos) << ended.errors;
}

TEST(LightTiers, DoWithoutTheProgramOf3D) {
  const TemporaryFolder folder;
  const fs::path lonely = folder.path() / "bin/tunica";
  fs::create_directories(lonely.parent_path());
  fs::copy_file(TUNICA_PROGRAM, lonely);
  Arguments arguments = run_with({});
  arguments.insert(arguments.begin(), lonely);
  const Ended without = run(arguments, folder.path());
  EXPECT_EQ(without.code, 2);
  EXPECT_TRUE(is_one_line(without.errors)) << without.errors;
  for (const char* word : {"--tier full3d", "tunica-full3d cannot be started", "TUNICA_FULL3D"})
    EXPECT_NE(without.errors.find(word), std::string::npos) << without.errors;
  EXPECT_FALSE(fs::exists(folder.path() / "r"));
  for (const char* tier : {"lumped", "axisym", "auto"}) {
    const Ended ended = run({lonely, "run", scenes / "cylinder.toml", "--tier", tier, "--quiet",
                             "--no-report", "--out", "r", "--set", "time.beats=1"},
                            folder.path());
    EXPECT_EQ(ended.code, 0) << tier << ": " << ended.errors;
  }
}

/// The errors of a program once they hold a text, or when it has ended.
std::string errors_with(Program& program, const std::string& text) {
  while (program.running() && program.errors().find(text) == std::string::npos)
    std::this_thread::sleep_for(2ms);
  return program.errors();
}

// A step of a mesh like this takes seconds: what a user who waits for it hears, and how it is stopped at
// once.
TEST(Interrupted, InALongStepItIsSaidAtOnceAndTheSecondOneStops) {
  for (const int signal : {SIGINT, SIGHUP}) {
    const TemporaryFolder folder;
    Arguments arguments{TUNICA_PROGRAM, "run", scenes / "cylinder.toml", "--tier", "full3d", "--out", "r",
                        "--no-report"};
    for (const char* setting : {"mesh.symmetry=full", "mesh.axial_cells=20", "mesh.around_cells=16",
                                "mesh.wall_cells=2", "mesh.blood_cells=2", "output.field_interval=0"})
      arguments.insert(arguments.end(), {"--set", setting});
    Program program(arguments, folder.path());
    while (program.running() && !fs::exists(folder.path() / "r")) std::this_thread::sleep_for(2ms);
    ASSERT_TRUE(program.running()) << program.errors();
    program.send(signal);
    const std::string said = "tunica: stopping after this step; again to stop now\n";
    EXPECT_NE(errors_with(program, said).find(said), std::string::npos) << program.errors();
    // Held still within its step it finds the second one when it goes on.
    program.send(SIGSTOP);
    program.send(signal);
    program.send(SIGTERM);
    std::this_thread::sleep_for(50ms);
    program.send(SIGCONT);
    EXPECT_EQ(program.wait(), 130);
    EXPECT_NE(program.errors().find("interrupted at once"), std::string::npos) << program.errors();
    EXPECT_EQ(broken_file(folder.path() / "r"), "");
  }
}

// mpirun tells all of them: the leader stores what there is, and the others serve it until it has.
TEST(Ranks, AreStoppedByTheirLeader) {
  const TemporaryFolder folder;
  Program program(on_ranks(2, run_with(two_beats)), folder.path());
  while (program.running() && !fs::exists(folder.path() / "r")) std::this_thread::sleep_for(5ms);
  ASSERT_TRUE(program.running()) << program.errors();
  for (const int rank : {1, 0}) {
    const pid_t process = process_of_rank(program.id(), rank);
    ASSERT_GT(process, 0);
    ASSERT_EQ(::kill(process, SIGTERM), 0);
  }
  EXPECT_EQ(program.wait(), 130) << program.errors();
  EXPECT_EQ(read_result(folder.path() / "r").record.at("interrupted"), true);
}

// All processes go over to the program of the 3D tier, although the 0D tier is compared too: it is there that
// the mesh is refused.
TEST(LightTiers, AreComparedWithThe3DTierUnderMpirun) {
  const TemporaryFolder folder;
  const Ended ended = run(on_ranks(2, {"verify", scenes / "cylinder.toml", "--tiers", "lumped,full3d",
                                       "--out", "v", "--quiet", "--set", "mesh.around_cells=12"}),
                          folder.path());
  EXPECT_EQ(ended.code, 2) << ended.errors;
  EXPECT_NE(ended.errors.find("mesh.around_cells = 12"), std::string::npos) << ended.errors;
}

TEST(LightTiers, WriteOneWholeResultUnderMpirun) {
  const TemporaryFolder one, two;
  const Arguments arguments{"run", scenes / "cylinder.toml", "--tier", "lumped", "--out", "r"};
  ASSERT_EQ(test_support::tunica(arguments, one.path()).code, 0);
  const Ended ended = run(on_ranks(2, arguments), two.path());
  ASSERT_EQ(ended.code, 0) << ended.errors;
  EXPECT_EQ(std::count(ended.output.begin(), ended.output.end(), '\n'), 1) << ended.output;
  EXPECT_EQ(broken_file(two.path() / "r"), "");
  EXPECT_TRUE(fs::exists(two.path() / "r/report.html"));
  EXPECT_TRUE(read_text(one.path() / "r/observables.csv") == read_text(two.path() / "r/observables.csv"));
}

/// What cannot be computed, and what is said about it.
class GivesUpInSpace : public testing::TestWithParam<Bad> {};

TEST_P(GivesUpInSpace, SayingWhenWhereAndWhyAndKeepsTheResults) {
  const TemporaryFolder folder;
  const Ended ended = test_support::tunica(run_with(GetParam().settings), folder.path());
  ASSERT_EQ(ended.code, 3) << ended.errors;
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  EXPECT_EQ(broken_file(folder.path() / "r"), "");
  const StoredResult stored = read_result(folder.path() / "r");
  EXPECT_EQ(stored.record.at("converged"), false);
  const std::string failure = stored.record.at("failure");
  EXPECT_NE(ended.errors.find("the solver gave up " + failure), std::string::npos) << ended.errors;
  for (const auto& word : GetParam().words)
    EXPECT_NE(failure.find(word), std::string::npos) << "'" << word << "' is not in: " << failure;
  for (const auto& column : stored.result.observables.columns())
    for (const double value : column.values)
      EXPECT_TRUE(std::isfinite(value) || observables::is_none(value)) << column.name;
}

const Arguments blow{"time.ramp=0", "inlet.waveform=pressure", "inlet.pressure=-9e6", "wall.law=EXP1"};
const char* const nothing_holds = "tether.stiffness=0";
INSTANTIATE_TEST_SUITE_P(
    , GivesUpInSpace,
    testing::Values(
        Bad{"balloon",
            {"wall.law=neo-Hookean", nothing_holds},
            {"at t = 0.", "(beat 1)", "x = ", "y = ", "z = ", "cell", "carries at most 14.7"}},
        Bad{"collapse",
            {nothing_holds, "inlet.waveform=pressure", "inlet.pressure=-100 mmHg"},
            {"at t = 0.0", "(beat 1)", "x = ", "y = ", "z = ", "cell"}},
        Bad{"blow", blow, {"(beat 1)", "smallest time step", "turned inside out", "time.ramp = 0"}}),
    [](const auto& instance) { return instance.param.name; });

TEST(GivenUp, OnRanksAsAlone) {
  const TemporaryFolder folder;
  const Ended ended = run(on_ranks(2, run_with(blow)), folder.path());
  EXPECT_EQ(ended.code, 3) << ended.errors;
  const auto first = ended.errors.find("tunica: cylinder: the solver gave up");
  ASSERT_NE(first, std::string::npos) << ended.errors;
  EXPECT_EQ(ended.errors.find("tunica: ", first + 1), std::string::npos) << ended.errors;
  EXPECT_EQ(read_result(folder.path() / "r").record.at("converged"), false);
}

}  // namespace
}  // namespace tunica
