// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of the 3D tier in several processes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/observables/result.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

using test_support::Program;
using test_support::TemporaryFolder;

const std::string scene = std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml";

struct Finished {
  StoredResult stored;
  std::string record;  ///< text of record.json
};

/// Cells through the wall, from the core to the wall, along and around.
using Cells = std::array<int, 4>;
constexpr Cells coarsest{1, 1, 8, 8};

Finished run_with(std::vector<std::string> settings, int ranks, const Cells& cells) {
  const TemporaryFolder folder;
  std::vector<std::string> call{"/usr/bin/env",
                                "OMPI_ALLOW_RUN_AS_ROOT=1",
                                "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                                "OMPI_MCA_mpi_yield_when_idle=1",
                                "mpirun",
                                "--oversubscribe",
                                "-n",
                                std::to_string(ranks),
                                TUNICA_PROGRAM,
                                "run",
                                scene,
                                "--tier",
                                "full3d",
                                "--out",
                                "r",
                                "--quiet",
                                "--no-report"};
  settings.insert(settings.end(), {"accuracy.tolerance=1e-4", "mesh.wall_cells=" + std::to_string(cells[0]),
                                   "mesh.blood_cells=" + std::to_string(cells[1]),
                                   "mesh.axial_cells=" + std::to_string(cells[2]),
                                   "mesh.around_cells=" + std::to_string(cells[3])});
  for (const std::string& setting : settings) call.insert(call.end(), {"--set", setting});
  Program run(call, folder.path());
  EXPECT_EQ(run.wait(), 0) << run.errors();
  const auto result = folder.path() / "r";
  return {read_result(result), test_support::read_text(result / "record.json")};
}

/// Two steps from rest.
Finished steps_by(const std::string& method, int ranks, const Cells& cells = coarsest, double step = 1e-2,
                  const std::string& options = "", const std::string& geometry = "implicit",
                  const std::string& motion = "harmonic") {
  std::vector<std::string> settings{"time.beats=1",
                                    "inlet.period=" + std::to_string(2 * step),
                                    "time.step=" + std::to_string(step),
                                    "solver.method=\"" + method + "\"",
                                    "solver.geometry=" + geometry,
                                    "mesh.motion=" + motion};
  if (!options.empty()) settings.push_back("solver.options=\"" + options + "\"");
  return run_with(settings, ranks, cells);
}

/// Newton ends at 3e-7 of each field by the scene's tolerance.
void expect_same(const Finished& a, const Finished& b) {
  const auto& expected = a.stored.result.observables.columns();
  const auto& found = b.stored.result.observables.columns();
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t c = 0; c < found.size(); ++c) {
    ASSERT_EQ(found[c].values.size(), expected[c].values.size());
    double size = 0, difference = 0;
    for (std::size_t row = 0; row < found[c].values.size(); ++row) {
      if (std::isnan(expected[c].values[row])) continue;
      size = std::max(size, std::abs(expected[c].values[row]));
      difference = std::max(difference, std::abs(found[c].values[row] - expected[c].values[row]));
    }
    EXPECT_LE(difference, 1e-6 * size) << found[c].name;
  }
}

class EveryGeometry : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(full3d, EveryGeometry, testing::Values("implicit", "lagged"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(EveryGeometry, TwoProcessesFindTheSameByEveryMethod) {
  const auto steps = [](const std::string& method, int ranks) {
    return steps_by(method, ranks, coarsest, 1e-2, "", GetParam());
  };
  const Finished direct = steps("direct", 1);
  for (const char* method : {"direct", "schwarz", "block"}) {
    SCOPED_TRACE(method);
    const Finished two = steps(method, 2);
    const auto says = [&](const std::string& text) { return two.record.find(text) != std::string::npos; };
    EXPECT_TRUE(says("\"ranks\": 2"));
    EXPECT_TRUE(says("\"solver\": \"" + std::string(method) + "\""));
    EXPECT_EQ(says("krylov_iterations"), std::string(method) != "direct");
    expect_same(direct, two);
  }
}

TEST(full3d, TwoProcessesFindTheSameInSectionsThatMoveByThemselves) {
  const auto steps = [](int ranks) {
    return steps_by("direct", ranks, coarsest, 1e-2, "", "implicit", "sectional");
  };
  expect_same(steps(1), steps(2));
}

// Without blood there is no pressure, and nothing for its complement to do.
TEST(full3d, AWallAloneIsFoundByEveryMethod) {
  const auto wall_by = [](const std::string& method) {
    return run_with(
        {"time.mode=static", "inlet.waveform=pressure", "inlet.pressure=100 mmHg", "solver.method=" + method},
        1, coarsest);
  };
  const Finished direct = wall_by("direct");
  for (const char* method : {"schwarz", "block"}) {
    SCOPED_TRACE(method);
    expect_same(direct, wall_by(method));
  }
}

TEST(full3d, OptionsThatNothingUsesAreNamed) {
  const Finished run = steps_by("direct", 1, coarsest, 1e-2, "-ksp_rtoll 1e-3");
  EXPECT_NE(run.record.find("does not ask for -ksp_rtoll"), std::string::npos);
}

double iterations_per_solution(const Finished& run) {
  const auto made = nlohmann::json::parse(run.record).at("resolution");
  return made.at("krylov_iterations").get<double>() / made.at("krylov_solutions").get<double>();
}

// Preconditioned by fields, a solution takes hardly more iterations on a finer mesh, on more processes, and
// with other time steps. The bounds are those of the project: 30 % for 8 times the unknowns (here 2.2 times)
// and for a second process; half as many again where the step changes what resists pressure, from inertia to
// viscosity.
TEST(full3d, IterationsHardlyDependOnMeshProcessesAndStep) {
  const Cells coarse{2, 1, 10, 8}, fine{3, 2, 14, 8};
  const auto iterations = [](int ranks, const Cells& cells, double step, const std::string& options) {
    return iterations_per_solution(steps_by("block", ranks, cells, step, options));
  };
  const std::string exact = "-ksp_rtol 1e-8";
  const double on_coarse = iterations(1, coarse, 2e-3, exact), on_fine = iterations(1, fine, 2e-3, exact),
               by_two = iterations(2, fine, 2e-3, exact);
  // Full flow in long steps leaves residuals that rounding keeps from 1e-8: solutions as by default.
  const double by_default = iterations(1, coarse, 2e-3, ""), in_short_steps = iterations(1, coarse, 5e-4, ""),
               in_long_steps = iterations(1, coarse, 1e-2, "");
  EXPECT_LE(on_fine, 1.3 * on_coarse);
  EXPECT_LE(by_two, 1.3 * on_fine);
  EXPECT_LE(in_short_steps, 1.5 * by_default);
  EXPECT_LE(in_long_steps, 1.5 * by_default);
}

}  // namespace
}  // namespace tunica
