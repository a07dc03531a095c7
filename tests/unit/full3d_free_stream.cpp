// SPDX-License-Identifier: GPL-3.0-or-later
// Uniform flow does not see the motion of the mesh in space that it is computed on.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "full3d/assembler.hpp"
#include "tests/support/free_stream.hpp"
#include "tests/support/solid_cases.hpp"

namespace tunica::full3d {
namespace {

/// Along none of the axes.
constexpr Vector<double> stream{6, -4, 20};
constexpr double stream_pressure = 900;

/// Blood in a bent vessel without a wall: its outer surface is one that blood passes through, so that a
/// stream may be uniform there while the surface moves.
Mesh open_vessel(const test_support::SolidCase& kind) {
  VesselSpec spec = test_support::coarse_vessel(kind, Sector::full, 0.5);
  spec.wall = false;
  spec.axial_cells = 4;
  Mesh mesh = o_grid_vessel(spec);
  for (Face& face : mesh.faces)
    if (face.boundary == Boundary::interface) face.boundary = Boundary::outer;
  return mesh;
}

/// Waves that run along the boundary, a fifth of the radius high, and turn the end faces into bowls.
Vector<double> motion(const Point& place, double time) {
  const auto [x, y, z] = place;
  const double growth = 1 - std::cos(4 * time), phase = 3 * (z - 2 * time);
  return {growth * 0.08 * x * std::sin(phase + y), growth * 0.08 * y * std::cos(phase - x),
          growth * (0.07 * std::sin(phase + 2 * x) + 0.07 * (x * x - x * y) - 0.08 * std::cos(10 * time))};
}

class SolidFreeStream : public testing::TestWithParam<std::tuple<test_support::SolidCase, int>> {};

void expect_kept(const test_support::SolidCase& kind, int method, bool lagged) {
  Problem problem;
  problem.mesh = open_vessel(kind);
  problem.discretisation.element = kind.element;
  problem.discretisation.lagged_mesh = lagged;
  problem.blood = {1.06, 0.035};
  problem.displacement = motion;
  problem.velocity = [](const Point&, double) { return stream; };
  for (const auto boundary : {Boundary::inlet, Boundary::outlet, Boundary::outer})
    problem.on(boundary).displacement = {true, true, true};
  for (const auto boundary : {Boundary::inlet, Boundary::outer})
    problem.on(boundary).velocity = {true, true, true};
  problem.outlet.kind = OutletKind::resistance;
  problem.outlet.pressure = [](double) { return stream_pressure; };

  const Ranks ranks;
  const Assembler assembler(problem, ranks);
  const Layout& layout = assembler.layout();
  std::vector<double> state(layout.size());
  for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
    const int node = static_cast<int>(n);
    // A bubble has no share in the stream.
    if (layout.has_velocity(node) && layout.has_displacement(node))
      for (int c = 0; c < 3; ++c) state[layout.velocity(node, c)] = stream[c];
    if (layout.has_pressure(node)) state[layout.pressure(node)] = stream_pressure;
  }
  state[*layout.outlet_pressure] = stream_pressure;
  // What is extrapolated over a step in which cells are compressed by half would turn some inside out.
  const int steps = lagged ? 38 : 19;
  const auto kept = test_support::keep_stream(assembler, test_support::time_methods[method], state, steps,
                                              0.04 * 19 / steps);
  testing::Test::RecordProperty("worst", testing::PrintToString(kept.worst));
  EXPECT_LT(kept.worst, 1e-12);
  // The motion was one that matters: a tenth of the speed of blood, cells compressed to nearly a half.
  EXPECT_GT(kept.greatest_mesh_speed, 1.9);
  EXPECT_LT(kept.least_jacobian, 0.55);
}

TEST_P(SolidFreeStream, IsKeptByAMovingMesh) {
  const auto& [kind, method] = GetParam();
  expect_kept(kind, method, false);
}

TEST_P(SolidFreeStream, IsKeptWhereTheMeshLags) {
  const auto& [kind, method] = GetParam();
  expect_kept(kind, method, true);
}

INSTANTIATE_TEST_SUITE_P(ElementsAndSchemes, SolidFreeStream,
                         testing::Combine(testing::ValuesIn(test_support::solid_cases), testing::Range(0, 3)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param).name) + "_" +
                                  test_support::time_method_names[std::get<1>(test.param)];
                         });

}  // namespace
}  // namespace tunica::full3d
