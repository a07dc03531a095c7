// SPDX-License-Identifier: GPL-3.0-or-later
// Nearly incompressible walls of every law in space do not lock.
#include "tests/support/full3d_runs.hpp"
#include "tests/support/near_incompressible.hpp"

namespace tunica {
namespace {

using test_support::answer_of;
using test_support::expect_close;
using test_support::lame_answer;
using test_support::lame_scene;
using test_support::run_full3d;

/// Every section is alike.
const std::vector<std::string> around{"mesh.around_cells=8", "mesh.axial_cells=4"};

TEST(NearlyIncompressibleSpace, IsLames) {
  for (const double ratio : {0.3, 0.499999})
    for (const char* law : {"linear-elastic", "St-Venant-Kirchhoff"}) {
      SCOPED_TRACE(testing::Message() << law << ", Poisson's ratio " << ratio);
      expect_close(answer_of(run_full3d(lame_scene(law, ratio, around))), lame_answer(ratio), 5e-3, 2e-2);
    }
}

TEST(NearlyIncompressibleSpace, IsTheRingAtFiniteStrain) {
  for (auto wall : {test_support::stiff_walls().front(), test_support::stiff_walls().back()}) {
    SCOPED_TRACE(wall.front());
    wall.insert(wall.end(), around.begin(), around.end());
    const Scene scene = test_support::stiff_scene(wall);
    expect_close(answer_of(run_full3d(scene)), test_support::ring_answer(scene), 5e-3, 2e-2);
  }
}

}  // namespace
}  // namespace tunica
