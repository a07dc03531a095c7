// SPDX-License-Identifier: GPL-3.0-or-later
// Pulse waves in a quarter of a thick elastic tube full of blood.
#include <gtest/gtest.h>

#include "full3d/assembler.hpp"
#include "full3d/o_grid.hpp"
#include "tests/mms/elastic_tube_waves.hpp"
#include "tests/support/solid_cases.hpp"

namespace tunica::full3d {
namespace {

TEST(SolidElasticTube, HasTheExactWaves) {
  const test_support::ElasticTube tube{0.033, 0.01, 4e5, 0.45, 1.2, 1.0, 0.035, 1e7};
  const test_support::ElasticTubeWaves waves(tube, 0.3, 5);
  Problem problem;
  VesselSpec spec;
  spec.radius = tube.radius;
  spec.layers = {tube.thickness};
  spec.length = 0.3;
  spec.around_cells = 16;
  spec.ring_cells = spec.wall_cells = 2;
  spec.axial_cells = 6;
  spec.interface_grading = 2;
  spec.sector = Sector::quarter;
  problem.mesh = o_grid_vessel(spec);
  problem.directions = test_support::directions_of(spec);
  problem.copies = 4;
  waves.set_conditions(problem);
  const Ranks ranks;
  waves.expect_within(1e-3, Assembler(problem, ranks), problem.mesh.points, 256);
}

}  // namespace
}  // namespace tunica::full3d
