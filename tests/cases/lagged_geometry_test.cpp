// SPDX-License-Identifier: GPL-3.0-or-later
// solver.geometry = "lagged" against "implicit", in both tiers with meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/full3d_runs.hpp"

namespace tunica {
namespace {

using test_support::artery;
using test_support::difference;
using test_support::joined;
using test_support::range;
using test_support::values;

struct TierCase {
  const char* name;
  std::function<Result(const Scene&)> run;
  std::vector<std::string> mesh;
};

class LaggedGeometry : public testing::TestWithParam<TierCase> {
 protected:
  Result run(const std::string& geometry, std::vector<std::string> more) const {
    // Newton's method leaves less than what is looked for.
    more = joined(std::move(more), {GetParam().mesh,
                                    {"solver.geometry=" + geometry, "accuracy.tolerance=1e-6",
                                     "inlet.period=0.08", "output.interval=0.01", "time.beats=1"}});
    return GetParam().run(artery(more));
  }
};

INSTANTIATE_TEST_SUITE_P(
    , LaggedGeometry,
    testing::Values(TierCase{"axisym",
                             test_support::run_axisym,
                             {"mesh.wall_cells=2", "mesh.blood_cells=2", "mesh.axial_cells=10"}},
                    TierCase{"full3d", test_support::run_full3d, test_support::coarsest}),
    [](const auto& test) { return test.param.name; });

TEST_P(LaggedGeometry, DiffersFromImplicitByAHundredthOfTheStepsErrorAndItsOrder) {
  for (const char* law : {"EXP1", "EXP1+EXP2-ZS"}) {
    const std::vector<std::string> of{std::string("wall.law=") + law};
    const auto table = [&](const char* geometry, const char* step) {
      return run(geometry, joined(of, {{std::string("time.step=") + step}})).observables;
    };
    const auto fine = table("implicit", "0.0005");
    const auto implicit = table("implicit", "0.002"), lagged = table("lagged", "0.002");
    const auto implicit_half = table("implicit", "0.001"), lagged_half = table("lagged", "0.001");
    for (const char* column : {"radial_displacement.P1", "pressure", "outflow"}) {
      SCOPED_TRACE(std::string(law) + " " + column);
      const auto &exact = values(fine, column), &a = values(implicit, column), &b = values(lagged, column);
      const double whole = difference(a, b),
                   half = difference(values(implicit_half, column), values(lagged_half, column)),
                   error = difference(a, exact);
      RecordProperty(std::string(law) + " " + column,
                     testing::PrintToString(std::vector{whole, half, error, range(exact)}));
      EXPECT_GT(range(exact), 0);
      EXPECT_LT(whole, 0.01 * error);
      // Second order, of differences that rounding and what Newton's method leaves begin to show in.
      EXPECT_GT(std::log2(whole / half), 1.4);
    }
  }
}

// Steady flow is found with its mesh, and a step goes on from there.
TEST_P(LaggedGeometry, GoesOnFromTheSteadyStateOfImplicit) {
  const std::vector<std::string> steady{"wall.law=EXP1", "time.start=static", "time.step=0.005",
                                        "inlet.flow=0.02", "inlet.waveform=constant"};
  const auto table = run("lagged", steady).observables;
  const auto& displacement = values(table, "radial_displacement.P1");
  EXPECT_GT(displacement.front(), 1e-3);
  EXPECT_LT(range(displacement), 1e-5 * displacement.front());
}

}  // namespace
}  // namespace tunica
