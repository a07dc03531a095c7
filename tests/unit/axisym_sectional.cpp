// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh in the blood that moves with the wall section by section.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"

namespace tunica::axisym {
namespace {

constexpr double length = 8;

/// Blood of radius 1 between clamped ends, its surface held.
Problem pipe(Element element, CellShape shape) {
  Problem problem;
  TubeSpec spec;
  spec.radius = 1;
  spec.length = length;
  spec.blood_cells = 3;
  spec.axial_cells = 24;
  spec.end_grading = 20;
  spec.interface_grading = 4;
  spec.wall = false;
  spec.shape = shape;
  problem.mesh = structured_tube(spec);
  problem.discretisation.element = element;
  problem.discretisation.motion = coupled::MeshMotion::sectional;
  problem.blood = {1, 0.035};
  for (const auto boundary : {Boundary::inlet, Boundary::outlet, Boundary::interface})
    problem.on(boundary).displacement = {true, true};
  return problem;
}

/// Displacement of the surface at a distance from the nearer end, along the radius and inwards along the
/// axis.
using Surface = std::function<std::pair<double, double>(double)>;

std::vector<double> moved(const Assembler& assembler, const Problem& problem, const Surface& surface) {
  const Layout& layout = assembler.layout();
  std::vector<double> y(layout.size());
  for (const int node : layout.wall_nodes()) {
    const double z = problem.mesh.points[node][1];
    const auto [widening, inwards] = surface(std::min(z, length - z));
    y[layout.displacement(node, 0)] = widening;
    y[layout.displacement(node, 1)] = z < length / 2 ? inwards : -inwards;
  }
  layout.share_out(y);
  return y;
}

/// Of the blood's cells at their quadrature points.
double least_jacobian(const Assembler& assembler, const std::vector<double>& y) {
  std::vector<double> residual(static_cast<std::size_t>(assembler.layout().unknowns()));
  assembler.residual({}, y, residual);
  return assembler.least_jacobian().value;
}

// A thin wall that opens by more than its lumen's radius leans over the clamp: the surface turns back over a
// tenth of the radius, so that no map of sections along the radius follows it.
std::pair<double, double> bulge(double d) {
  return {1.2 * (1 - std::exp(-2.2 * d)), 0.45 * d * std::exp(-std::pow(d / 0.09, 2)) -
                                              0.48 * (1 - std::exp(-std::pow(d / 0.22, 2))) * std::exp(-d)};
}

TEST(SectionalMotion, FollowsASurfaceThatTurnsBack) {
  double steepest = 1;
  for (double d = 0; d < 1; d += 1e-3)
    steepest = std::min(steepest, 1 + (bulge(d + 1e-3).second - bulge(d).second) / 1e-3);
  EXPECT_LT(steepest, -0.5);
  for (const Element element : {Element::quadratic, Element::linear}) {
    const Problem problem = pipe(element, CellShape::quadrilateral);
    const Assembler assembler(problem);
    EXPECT_GT(least_jacobian(assembler, moved(assembler, problem, bulge)), 0.2);
  }
}

// A quarter of the way to the wall moves a quarter as far along the radius; the ends stay plane and in place.
TEST(SectionalMotion, KeepsSharesOfTheWayAndClampedEnds) {
  const Problem problem = pipe(Element::quadratic, CellShape::quadrilateral);
  const Assembler assembler(problem);
  const Layout& layout = assembler.layout();
  const auto y = moved(assembler, problem, bulge);
  for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
    const int node = static_cast<int>(n);
    const auto [r, z] = problem.mesh.points[n];
    const double widening = bulge(std::min(z, length - z)).first;
    EXPECT_NEAR(y[layout.displacement(node, 0)], r * widening, 1e-14);
    if (z == 0 || z == length) {
      EXPECT_EQ(y[layout.displacement(node, 1)], 0) << r;
    }
  }
}

// Ends that are free to widen have no clamp for the wall to lean over: sections keep their places.
TEST(SectionalMotion, LeavesSectionsInPlaceBesideFreeEnds) {
  Problem problem = pipe(Element::quadratic, CellShape::quadrilateral);
  for (const auto boundary : {Boundary::inlet, Boundary::outlet})
    problem.on(boundary).displacement = {false, true};
  const Assembler assembler(problem);
  const auto y = moved(assembler, problem, [](double) { return std::pair{0.5, 0.0}; });
  for (std::size_t n = 0; n < problem.mesh.points.size(); ++n)
    EXPECT_EQ(y[assembler.layout().displacement(static_cast<int>(n), 1)], 0);
}

}  // namespace
}  // namespace tunica::axisym
