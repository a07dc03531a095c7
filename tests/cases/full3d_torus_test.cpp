// SPDX-License-Identifier: GPL-3.0-or-later
// The torus in space: its mirror images, its half, and walls under pressure alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/full3d_runs.hpp"

namespace tunica {
namespace {

using test_support::coarsest;
using test_support::difference;
using test_support::difference_of_mirror_images;
using test_support::greatest;
using test_support::joined;
using test_support::run_full3d;
using test_support::short_flow;
using test_support::values;

/// A sixth of a turn of a shipped torus, on the fewest cells, in which a steady flow comes on. Newton's
/// method leaves a thousandth of the tolerance.
Scene bend(const std::string& scene, std::vector<std::string> more) {
  more.insert(more.end(), {"geometry.length=0.22", "geometry.bend_angle=60", "accuracy.tolerance=1e-4",
                           "output.field_interval=0"});
  return read_scene(std::string(TUNICA_SOURCE_DIR) + "/scenes/" + scene + ".toml",
                    joined(more, {coarsest, short_flow}));
}

std::string column(const char* quantity, int point, const std::string& angle) {
  return fmt::format("{}.P{}{}", quantity, point, angle);
}

class BalancedTorus : public testing::TestWithParam<const char*> {};

TEST_P(BalancedTorus, IsItsOwnMirrorImageAndItsHalfIsTheWhole) {
  const auto whole = run_full3d(bend(GetParam(), {"mesh.symmetry=full"})).observables;
  for (int point = 1; point <= 4; ++point) {
    const auto& left = values(whole, column("radial_displacement", point, ".90deg"));
    const auto& right = values(whole, column("radial_displacement", point, ".270deg"));
    EXPECT_GT(greatest(left), 1e-3);
    EXPECT_LT(difference(left, right), 1e-6 * greatest(left)) << 'P' << point;
  }
  const auto half = run_full3d(bend(GetParam(), {"mesh.symmetry=half"})).observables;
  for (const auto& each : whole.columns()) {
    // Fibres of a family and of its mirror image change places.
    if (each.name.starts_with("fiber_") || each.name.starts_with("recruitment")) continue;
    EXPECT_LT(difference(each.values, values(half, each.name)), 1e-6 * greatest(each.values) + 1e-300)
        << each.name;
  }
}

INSTANTIATE_TEST_SUITE_P(, BalancedTorus, testing::Values("torus_exp2", "torus_zs"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST(TorusInSpace, FibresThatWindTheOtherWayMakeTheMirrorImage) {
  const auto a = run_full3d(bend("torus_case_a", {})).observables;
  const auto b = run_full3d(bend("torus_case_b", {})).observables;
  EXPECT_LT(difference_of_mirror_images(a, b), 1e-6);
  const auto& left = values(a, "radial_displacement.P1.90deg");
  EXPECT_GT(difference(left, values(a, "radial_displacement.P1.270deg")), 3e-5 * greatest(left))
      << "the sides of the bend are told apart";
}

TEST(TorusInSpace, HasCellsEnoughForItsBendUnlessTheyAreGiven) {
  for (const char* angle : {"180", "270"}) {
    const Result result = run_full3d(read_scene(
        std::string(TUNICA_SOURCE_DIR) + "/scenes/torus_exp2.toml",
        {std::string("geometry.bend_angle=") + angle, "accuracy.tolerance=5%", "wall.law=EXP1",
         "time.mode=static", "inlet.waveform=pressure", "inlet.pressure=5 mmHg", "output.field_interval=0"}));
    // Cells of 45 degrees at most, and shorter ones at both ends.
    EXPECT_GE(result.record.resolution.at("axial_cells"), std::stoi(angle) / 45 + 2);
  }
}

class StaticTorus : public testing::TestWithParam<const char*> {};

TEST_P(StaticTorus, ConvergesUnderPressureAlone) {
  const auto displacements = [&](std::vector<std::string> cells) {
    cells.insert(cells.end(), {"time.mode=static", "inlet.waveform=pressure", "inlet.pressure=100 mmHg",
                               "output.field_interval=0", std::string("wall.law=") + GetParam()});
    const Scene scene = read_scene(std::string(TUNICA_SOURCE_DIR) + "/scenes/torus.toml", cells);
    const auto table = run_full3d(scene).observables;
    std::vector<double> all;
    for (const int point : {1, 4})
      for (const char* angle : {"", ".90deg", ".180deg", ".270deg"})
        all.push_back(values(table, column("radial_displacement", point, angle)).at(0));
    return all;
  };
  const auto coarse = displacements({"mesh.wall_cells=1", "mesh.axial_cells=14", "mesh.around_cells=8"});
  const auto fine = displacements({"mesh.wall_cells=2", "mesh.axial_cells=28", "mesh.around_cells=16"});
  // Twice the cells change them by up to 0.2 %.
  EXPECT_LT(difference(coarse, fine), 3e-3 * greatest(fine));
  for (const auto& all : {coarse, fine})
    for (const std::size_t point : {0, 4})
      EXPECT_NEAR(all[point + 1], all[point + 3], 1e-6 * all[point + 1]) << "both sides of the bend";
}

INSTANTIATE_TEST_SUITE_P(, StaticTorus, testing::Values("EXP1+EXP2-ZS", "EXP1+EXP2-FS"),
                         [](const auto& instance) {
                           return std::string(instance.param).substr(sizeof "EXP1+EXP2-" - 1);
                         });

}  // namespace
}  // namespace tunica
