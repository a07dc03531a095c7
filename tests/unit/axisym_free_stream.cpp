// SPDX-License-Identifier: GPL-3.0-or-later
// Uniform flow does not see the motion of the mesh that it is computed on.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "tests/support/free_stream.hpp"

namespace tunica::axisym {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double speed = 20, stream_pressure = 900;

struct Case {
  const char* name;
  CellShape shape;
  Element element;
};
constexpr std::array<Case, 5> elements{
    {{"quadratic_quadrilateral", CellShape::quadrilateral, Element::quadratic},
     {"quadratic_triangle", CellShape::triangle, Element::quadratic},
     {"linear_quadrilateral", CellShape::quadrilateral, Element::linear},
     {"linear_triangle", CellShape::triangle, Element::linear},
     {"bubble_triangle", CellShape::triangle, Element::bubble}}};

/// Blood in a tube without a wall: its outer surface is one that blood passes through, so that a stream may
/// be uniform there while the surface moves.
Mesh open_tube(CellShape shape) {
  TubeSpec spec;
  spec.radius = 0.5;
  spec.length = 1;
  spec.blood_cells = 4;
  spec.axial_cells = 6;
  spec.wall = false;
  spec.shape = shape;
  Mesh mesh = structured_tube(spec);
  for (Edge& edge : mesh.edges)
    if (edge.boundary == Boundary::interface) edge.boundary = Boundary::outer;
  return mesh;
}

/// Waves that run along the boundary, a fifth of the radius high, and turn the end faces into bowls.
Vector<double> motion(const Point& x, double time) {
  const auto [r, z] = x;
  const double growth = 1 - std::cos(4 * time), phase = 2 * pi * (z - 2 * time);
  return {growth * 0.1 * r * std::sin(phase), 0,
          growth * (0.04 * std::sin(phase + 4 * r) + 0.2 * r * r - 0.05 * std::cos(10 * time))};
}

class FreeStream : public testing::TestWithParam<std::tuple<int, int>> {};

void expect_kept(int element, int method, bool lagged) {
  Problem problem;
  problem.mesh = open_tube(elements[element].shape);
  problem.discretisation.element = elements[element].element;
  problem.discretisation.lagged_mesh = lagged;
  problem.blood = {1.06, 0.035};
  problem.displacement = motion;
  problem.velocity = [](const Point&, double) { return Vector<double>{0, 0, speed}; };
  for (const auto boundary : {Boundary::inlet, Boundary::outlet, Boundary::outer})
    problem.on(boundary).displacement = {true, true};
  for (const auto boundary : {Boundary::inlet, Boundary::outer}) problem.on(boundary).velocity = {true, true};
  problem.outlet.kind = OutletKind::resistance;
  problem.outlet.pressure = [](double) { return stream_pressure; };

  const Assembler assembler(problem);
  const Layout& layout = assembler.layout();
  std::vector<double> state(layout.size());
  for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
    const int node = static_cast<int>(n);
    if (layout.has_velocity(node) && layout.has_displacement(node)) state[layout.velocity(node, 1)] = speed;
    if (layout.has_pressure(node)) state[layout.pressure(node)] = stream_pressure;
  }
  state[*layout.outlet_pressure] = stream_pressure;
  const auto stream =
      test_support::keep_stream(assembler, test_support::time_methods[method], state, 100, 0.01);
  EXPECT_LT(stream.worst, 1e-12);
  // The motion was one that matters: a tenth of the speed of blood, cells compressed to a half.
  EXPECT_GT(stream.greatest_mesh_speed, 1.9);
  EXPECT_LT(stream.least_jacobian, 0.5);
}

TEST_P(FreeStream, IsKeptByAMovingMesh) {
  const auto [element, method] = GetParam();
  expect_kept(element, method, false);
}

TEST_P(FreeStream, IsKeptWhereTheMeshLags) {
  const auto [element, method] = GetParam();
  expect_kept(element, method, true);
}

std::string case_name(const testing::TestParamInfo<std::tuple<int, int>>& test) {
  const auto [element, method] = test.param;
  return std::string(elements[element].name) + "_" + test_support::time_method_names[method];
}

INSTANTIATE_TEST_SUITE_P(ElementsAndSchemes, FreeStream,
                         testing::Combine(testing::Range(0, 5), testing::Range(0, 3)), case_name);

}  // namespace
}  // namespace tunica::axisym
