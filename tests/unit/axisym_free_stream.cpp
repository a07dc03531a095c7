// SPDX-License-Identifier: GPL-3.0-or-later
// Uniform flow does not see the motion of the mesh that it is computed on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "core/coupled/newton.hpp"
#include "core/time/scheme.hpp"

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
constexpr std::array schemes{time::Method::bdf2, time::Method::backward_euler,
                             time::Method::generalized_alpha};
constexpr std::array scheme_names{"bdf2", "backward_euler", "generalized_alpha"};

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

TEST_P(FreeStream, IsKeptByAMovingMesh) {
  const auto [element, scheme_number] = GetParam();
  Problem problem;
  problem.mesh = open_tube(elements[element].shape);
  problem.discretisation.element = elements[element].element;
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
  coupled::Newton newton(assembler);
  time::Scheme scheme(schemes[scheme_number]);
  std::vector<double> state(layout.size());
  for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
    const int node = static_cast<int>(n);
    if (layout.has_velocity(node) && layout.has_displacement(node)) state[layout.velocity(node, 1)] = speed;
    if (layout.has_pressure(node)) state[layout.pressure(node)] = stream_pressure;
  }
  state[*layout.outlet_pressure] = stream_pressure;
  scheme.start(0, state, std::vector<double>(state.size(), 0.0));

  double worst = 0, least_jacobian = 1, greatest_mesh_speed = 0;
  for (int step = 0; step < 100; ++step) {
    // Steps that differ, so that no coefficient is what it is for equal ones.
    const time::Stage& at = scheme.begin(0.01 * (1 + 0.5 * std::sin(step)));
    std::copy(scheme.prediction().begin(), scheme.prediction().end(), state.begin());
    const auto report = newton.solve({at.time, at.coefficient, scheme.history()}, state, {1e-13, 20});
    ASSERT_TRUE(report.converged) << "step " << step << ": " << report.failure;
    least_jacobian = std::min(least_jacobian, assembler.least_jacobian().value);
    scheme.accept(state);
    const auto& end = scheme.value();
    for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
      const int node = static_cast<int>(n);
      if (!layout.has_velocity(node)) continue;
      const double expected = layout.has_displacement(node) ? speed : 0;  // 0: share of a bubble
      // On the axis the radial component is prescribed to vanish; elsewhere it has to by itself.
      worst = std::max({worst, std::abs(end[layout.velocity(node, 0)]) / speed,
                        std::abs(end[layout.velocity(node, 1)] - expected) / speed});
      if (layout.has_pressure(node))
        worst = std::max(worst, std::abs(end[layout.pressure(node)] / stream_pressure - 1));
      greatest_mesh_speed =
          std::max(greatest_mesh_speed, std::abs(scheme.rate()[layout.displacement(node, 1)]));
    }
  }
  EXPECT_LT(worst, 1e-12);
  // The motion was one that matters: a tenth of the speed of blood, cells compressed to a half.
  EXPECT_GT(greatest_mesh_speed, 1.9);
  EXPECT_LT(least_jacobian, 0.5);
}

std::string case_name(const testing::TestParamInfo<std::tuple<int, int>>& test) {
  const auto [element, scheme] = test.param;
  return std::string(elements[element].name) + "_" + scheme_names[scheme];
}

INSTANTIATE_TEST_SUITE_P(ElementsAndSchemes, FreeStream,
                         testing::Combine(testing::Range(0, 5), testing::Range(0, 3)), case_name);

}  // namespace
}  // namespace tunica::axisym
