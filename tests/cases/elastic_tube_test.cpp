// SPDX-License-Identifier: GPL-3.0-or-later
// The elastic-tube benchmark on three steps and two meshes: its limit for small steps and cells against the
// published one, and the order in time. docs/verification/elastic-tube.md has the whole study.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "axisym/axisym_tier.hpp"
#include "verification/studies/elastic_tube_runs.hpp"

namespace tunica::verification {
namespace {

/// Until after the peak.
TubeRun tube_with(double step, int axial_cells) {
  TierList tiers;
  tiers.push_back(std::make_unique<axisym::AxisymTier>());
  const run::Door door(tiers, run::SceneSource(std::string(TUNICA_SOURCE_DIR) + "/scenes/elastic_tube.toml"));
  return tube_run(door.compute({"axisym",
                                {"inlet.period=9 ms", "mesh.wall_cells=2", "mesh.blood_cells=4",
                                 "mesh.axial_cells=" + std::to_string(axial_cells),
                                 "time.step=" + std::to_string(step), "output.field_interval=0"}}));
}

TEST(ElasticTubeBenchmark, LimitForSmallStepsAndCellsIsThePublishedOne) {
  const TubePeak coarse = tube_with(2e-4, 80).peak, middle = tube_with(1e-4, 80).peak,
                 fine = tube_with(5e-5, 80).peak;
  const TubePeak on_fine_mesh = tube_with(5e-5, 160).peak;

  // BDF2: 2 for small steps. These resolve the wave's front, a ring's period of 2 ms, just so: the order has
  // yet to settle.
  const auto order = observed_order(coarse.displacement, middle.displacement, fine.displacement);
  ASSERT_TRUE(order.has_value());
  EXPECT_NEAR(*order, 2, 0.3);

  const auto limit = [&](double TubePeak::*value) {
    return extrapolated(middle.*value, fine.*value, 2) + extrapolated(fine.*value, on_fine_mesh.*value, 3) -
           fine.*value;
  };
  EXPECT_NEAR(limit(&TubePeak::displacement), published_limit.displacement,
              displacement_bar * published_limit.displacement);
  EXPECT_NEAR(limit(&TubePeak::time), published_limit.time, time_bar * published_limit.time);
}

}  // namespace
}  // namespace tunica::verification
