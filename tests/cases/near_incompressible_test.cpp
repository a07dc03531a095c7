// SPDX-License-Identifier: GPL-3.0-or-later
// Nearly incompressible walls of every law in the half plane do not lock.
#include "tests/support/near_incompressible.hpp"

namespace tunica {
namespace {

using test_support::answer_of;
using test_support::expect_close;
using test_support::lame_answer;
using test_support::lame_scene;
using test_support::ring_answer;
using test_support::run_axisym;

TEST(NearlyIncompressibleRing, IsLames) {
  for (const double ratio : {0.3, 0.499999})
    for (const char* law : {"linear-elastic", "St-Venant-Kirchhoff"}) {
      SCOPED_TRACE(testing::Message() << law << ", Poisson's ratio " << ratio);
      expect_close(ring_answer(lame_scene(law, ratio)), lame_answer(ratio), 3e-5, 3e-5);
    }
}

TEST(NearlyIncompressibleHalfPlane, IsLames) {
  for (const double ratio : {0.3, 0.499999})
    for (const char* law : {"linear-elastic", "St-Venant-Kirchhoff"}) {
      SCOPED_TRACE(testing::Message() << law << ", Poisson's ratio " << ratio);
      expect_close(answer_of(run_axisym(lame_scene(law, ratio))), lame_answer(ratio), 2e-4, 2e-3);
    }
}

// The tenth of the volumetric stress that is taken at each point, or what it is bounded by, stiffens linear
// cells by a hundredth.
TEST(NearlyIncompressibleHalfPlane, IsLamesOnLinearCells) {
  for (const double ratio : {0.3, 0.499999}) {
    SCOPED_TRACE(ratio);
    expect_close(answer_of(run_axisym(lame_scene("linear-elastic", ratio,
                                                 {"mesh.element=linear", "mesh.wall_cells=6",
                                                  "mesh.blood_cells=6", "mesh.axial_cells=42"}))),
                 lame_answer(ratio), 1.5e-2, 1.5e-2);
  }
}

// The pressure of St. Venant and Kirchhoff's law stretches with the tissue, so that its error, of second
// order, is seen in von Mises' stress.
TEST(NearlyIncompressibleHalfPlane, IsTheRingAtFiniteStrain) {
  for (const auto& wall : test_support::stiff_walls()) {
    SCOPED_TRACE(wall.front());
    const Scene scene = test_support::stiff_scene(wall);
    const bool stretched = wall.front().ends_with("Kirchhoff");
    expect_close(answer_of(run_axisym(scene)), ring_answer(scene), 2e-4, stretched ? 1.5e-2 : 2e-4);
  }
}

// Between clamped ends the tube's whole length is held, not that of each section: 0.8 to 1.3 % more at
// mid-length, whatever the cells.
TEST(NearlyIncompressibleHalfPlane, KeepsItsAnswerOnFinerCellsBetweenClampedEnds) {
  const auto answer = [](std::vector<std::string> more) {
    more.emplace_back("geometry.ends=clamped");
    return answer_of(run_axisym(lame_scene("linear-elastic", 0.499999, more)));
  };
  expect_close(answer({}), answer({"mesh.wall_cells=6", "mesh.axial_cells=28"}), 1.5e-3, 2e-3);
}

}  // namespace
}  // namespace tunica
