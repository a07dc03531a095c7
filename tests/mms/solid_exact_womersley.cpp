// SPDX-License-Identifier: GPL-3.0-or-later
// Oscillating flow in a quarter of a rigid pipe against Womersley's solution.
#include <gtest/gtest.h>

#include <tuple>

#include "full3d/assembler.hpp"
#include "full3d/o_grid.hpp"
#include "tests/mms/rigid_pipe_flow.hpp"

namespace tunica::full3d {
namespace {

using test_support::RigidPipeFlow;

class SolidRigidPipe : public testing::TestWithParam<std::tuple<InletKind, double>> {};

// As in two dimensions; the errors of this mesh are smaller than those of time, too.
TEST_P(SolidRigidPipe, HasWomersleysFlow) {
  const auto [drive, number] = GetParam();
  const RigidPipeFlow flow(drive, number);
  Problem problem;
  VesselSpec spec;
  spec.radius = RigidPipeFlow::pipe.radius;
  spec.length = RigidPipeFlow::length;
  spec.around_cells = 16;
  spec.ring_cells = 5;
  spec.axial_cells = 2;
  spec.interface_grading = 3;
  spec.sector = Sector::quarter;
  spec.wall = false;
  problem.mesh = o_grid_vessel(spec);
  problem.copies = 4;
  flow.set_conditions(problem);
  const Ranks ranks;
  const auto errors = flow.errors(Assembler(problem, ranks), problem.mesh.points, 256);
  EXPECT_LT(errors.velocity, 1e-3);
  EXPECT_LT(errors.pressure, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Drives, SolidRigidPipe,
    testing::Combine(testing::Values(InletKind::prescribed, InletKind::flow, InletKind::pressure),
                     testing::Values(0.5, 3.0, 10.0)),
    [](const auto& test) { return RigidPipeFlow::name(std::get<0>(test.param), std::get<1>(test.param)); });

}  // namespace
}  // namespace tunica::full3d
