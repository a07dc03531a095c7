// SPDX-License-Identifier: GPL-3.0-or-later
// Oscillating flow in a rigid pipe, driven in each of the ways there are, against Womersley's solution.
#include <gtest/gtest.h>

#include <tuple>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "tests/mms/rigid_pipe_flow.hpp"

namespace tunica::axisym {
namespace {

using test_support::RigidPipeFlow;

class RigidPipe : public testing::TestWithParam<std::tuple<InletKind, double>> {};

// Complex amplitudes within 0.1 %, which bounds errors of amplitude and of phase. BDF2 takes i w for
// i w (1 + (w h)^2/3), 2e-4 with 256 steps a period where inertia rules; the mesh's errors are smaller.
TEST_P(RigidPipe, HasWomersleysFlow) {
  const auto [drive, number] = GetParam();
  const RigidPipeFlow flow(drive, number);
  Problem problem;
  TubeSpec spec;
  spec.radius = RigidPipeFlow::pipe.radius;
  spec.length = RigidPipeFlow::length;
  spec.blood_cells = 8;
  spec.axial_cells = 2;
  spec.interface_grading = 3;
  spec.wall = false;
  problem.mesh = structured_tube(spec);
  flow.set_conditions(problem);
  const auto errors = flow.errors(Assembler(problem), problem.mesh.points, 256);
  EXPECT_LT(errors.velocity, 1e-3);
  EXPECT_LT(errors.pressure, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Drives, RigidPipe,
    testing::Combine(testing::Values(InletKind::prescribed, InletKind::flow, InletKind::pressure),
                     testing::Values(0.5, 3.0, 10.0)),
    [](const auto& test) { return RigidPipeFlow::name(std::get<0>(test.param), std::get<1>(test.param)); });

}  // namespace
}  // namespace tunica::axisym
