// SPDX-License-Identifier: GPL-3.0-or-later
// Whole beats in space with default settings: minutes.
#include <fmt/format.h>

#include "tests/support/cylinder_by_law.hpp"

namespace tunica {
namespace {

using test_support::CylinderByLaw;
using test_support::difference;
using test_support::difference_of_mirror_images;
using test_support::greatest;
using test_support::run_full3d;
using test_support::values;

INSTANTIATE_TEST_SUITE_P(, CylinderByLaw, testing::ValuesIn(test_support::laws({})),
                         test_support::name_of_law);

TEST(TorusInSpace, IsComputedOverTwoBeatsWithFibresRecruitedAtFiniteStrain) {
  const Scene scene =
      read_scene(std::string(TUNICA_SOURCE_DIR) + "/scenes/torus.toml", {"output.field_interval=0"});
  ASSERT_EQ(scene.text("wall.law"), "EXP1+EXP2-FS");
  ASSERT_EQ(scene.number("wall.sharpness"), 5e5);
  const Result result = run_full3d(scene);
  const auto& time = values(result.observables, "time");
  EXPECT_EQ(time.back(), 1.6);
  EXPECT_GT(result.events.rows(), 0U);
  // The second beat is all but the first: the artery has no memory that outlasts one.
  const auto& u = values(result.observables, "radial_displacement.P1");
  const std::size_t beat = (time.size() - 1) / 2;
  for (std::size_t k = beat / 4; k <= beat; ++k)
    EXPECT_NEAR(u[k], u[k + beat], 0.01 * greatest(u)) << "at t = " << time[k];
}

TEST(TorusInSpace, CasesAAndBAreMirrorImagesOverABeatOfTheWholeBend) {
  const auto over_a_beat = [](const char* scene) {
    return run_full3d(read_scene(fmt::format("{}/scenes/{}.toml", TUNICA_SOURCE_DIR, scene),
                                 {"time.beats=1", "output.field_interval=0"}))
        .observables;
  };
  const auto a = over_a_beat("torus_case_a"), b = over_a_beat("torus_case_b");
  EXPECT_LT(difference_of_mirror_images(a, b), 1e-6);
  const auto& left = values(a, "radial_displacement.P1.90deg");
  EXPECT_GT(difference(left, values(a, "radial_displacement.P1.270deg")), 1e-6 * greatest(left))
      << "the sides of the bend are told apart";
}

}  // namespace
}  // namespace tunica
