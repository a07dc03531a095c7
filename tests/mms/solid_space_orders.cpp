// SPDX-License-Identifier: GPL-3.0-or-later
// Orders of convergence in space of the coupled equations in three dimensions, on a deforming domain without
// any symmetry, by manufactured solutions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "full3d/assembler.hpp"
#include "tests/mms/box_motions.hpp"
#include "tests/mms/instant.hpp"
#include "tests/mms/solid_cells.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/solid_cases.hpp"

namespace tunica::mms {
namespace {

using full3d::Element, full3d::Mesh, full3d::Point;

/// Orders that theory gives in L2, as in two dimensions.
struct Case {
  const char* name;
  test_support::SolidCase kind;
  double bulge;  ///< of the unloaded interface, which straight sides cannot follow
  InletKind inlet;
  TheoryOfOrders theory;
  std::vector<int> cells;  ///< along a side
};
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

class SolidSpaceOrders : public testing::TestWithParam<Case> {
 protected:
  /// Cells of all kinds of shape, by a smooth map that leaves the sides where they are.
  Mesh mesh(int cells) const {
    const Case& c = GetParam();
    const double outer = vessel.width + vessel.thickness;
    const auto map = [&](const Point& place) -> Point {
      const auto [x, y, z] = place;
      const double up = std::sin(2 * std::numbers::pi * z / vessel.length) / (2 * std::numbers::pi),
                   deep = std::sin(2 * std::numbers::pi * y / vessel.depth) / (2 * std::numbers::pi);
      const double out = 0.4 * x * (vessel.width - x) * (outer - x) * std::sin(3 * z - 2 * y);
      const double moved_y = y + 0.12 * deep * std::cos(3 * x + z),
                   moved_z = z + 0.12 * up * std::cos(3 * x - y);
      return {(x + out) * vessel.profile(moved_y, moved_z), moved_y, moved_z};
    };
    return test_support::box_mesh(
        {vessel.width, vessel.thickness, vessel.depth, vessel.length, cells, cells / 2, cells, cells,
         c.kind.shape, c.kind.element == Element::quadratic},
        map);
  }

  Errors solve(int cells) const {
    full3d::Problem problem;
    problem.mesh = mesh(cells);
    problem.directions = [](int, const element::solid::Local&, const Point&) {
      return box::Shape::directions();
    };
    problem.discretisation = {GetParam().kind.element, mixed_wall};
    set_instant(vessel, bulk_modulus, tether, GetParam().inlet, problem);
    const full3d::Ranks ranks;
    return solve_instant<SolidCells>(full3d::Assembler(problem, ranks), problem, vessel);
  }

  void expect_orders(double slack_above = 0.15) {
    std::vector<Level> levels;
    for (const int cells : GetParam().cells) levels.push_back({cells, solve(cells)});
    mms::expect_orders(levels, GetParam().theory, slack_above, GetParam().inlet == InletKind::flow);
  }

  bool mixed_wall = true;
  double bulk_modulus = 20;
  radial::TetherTraction tether = radial::TetherTraction::normal;
  Vessel<box::SmoothMotion> vessel = [] {
    Vessel<box::SmoothMotion> v;
    v.bulge = GetParam().bulge;
    return v;
  }();
};

std::string case_name(const testing::TestParamInfo<Case>& test) {
  return test.param.name;
}

using test_support::solid_cases;
const Case quadratic_hexahedron{"quadratic_hexahedron", solid_cases[0], 0.08,
                                InletKind::prescribed,  {3, 2, 2},      {4, 6}};
// Pressures at the openings come from integrals, whose errors, of 1e-6 here, change their sign on coarser
// meshes.
const Case given_flow{
    "quadratic_hexahedron_given_flow", solid_cases[0], 0.08, InletKind::flow, {3, 2, 2}, {4, 8}};
const Case quadratic_tetrahedron{"quadratic_tetrahedron", solid_cases[1], 0.08,
                                 InletKind::prescribed,   {3, 2, 2},      {4, 6}};
const Case linear_hexahedron{"linear_hexahedron",   solid_cases[2], 0,
                             InletKind::prescribed, {2, 1, 2},      {4, 8}};
const Case linear_tetrahedron{"linear_tetrahedron",  solid_cases[3], 0,
                              InletKind::prescribed, {2, 1, 2},      {4, 8}};
const Case bubble_tetrahedron{"bubble_tetrahedron",  solid_cases[4], 0,
                              InletKind::prescribed, {2, 1, 2},      {4, 8}};

INSTANTIATE_TEST_SUITE_P(Elements, SolidSpaceOrders,
                         testing::Values(quadratic_hexahedron, given_flow, quadratic_tetrahedron,
                                         linear_hexahedron, linear_tetrahedron, bubble_tetrahedron),
                         case_name);

TEST_P(SolidSpaceOrders, OfAnInstantOfMotion) {
  expect_orders();
}

class SolidLoadOrders : public SolidSpaceOrders {};
INSTANTIATE_TEST_SUITE_P(Elements, SolidLoadOrders, testing::Values(linear_hexahedron), case_name);

TEST_P(SolidLoadOrders, OfASteadyState) {
  vessel.steady = true;
  expect_orders();
}

TEST_P(SolidLoadOrders, OfTheOtherTethers) {
  for (const auto reading : {radial::TetherTraction::reference, radial::TetherTraction::current}) {
    SCOPED_TRACE(testing::Message() << "reading " << static_cast<int>(reading));
    tether = reading;
    expect_orders();
  }
}

TEST_P(SolidLoadOrders, OfBackflow) {
  vessel.direction = -1;
  expect_orders();
}

/// A wall that nearly keeps its volume: bulk over shear modulus 500, as of the paper's tissues.
class NearlyIncompressibleSolid : public SolidSpaceOrders {
 protected:
  NearlyIncompressibleSolid() {
    bulk_modulus = 2e4;
    vessel.compressibility = 1 / bulk_modulus;
  }
};

class NearlyIncompressibleQuadraticSolid : public NearlyIncompressibleSolid {};
INSTANTIATE_TEST_SUITE_P(Elements, NearlyIncompressibleQuadraticSolid,
                         testing::Values(quadratic_hexahedron, quadratic_tetrahedron), case_name);

// As in two dimensions orders of hexahedra are not lost, and may come from above. Tetrahedra have some four
// displacements to a cell, as many as a linear pressure has terms, and lose half an order of the displacement
// of the wall (a constant pressure would cost a whole one in softer tissue).
TEST_P(NearlyIncompressibleQuadraticSolid, KeepsItsOrders) {
  if (GetParam().kind.shape == full3d::Shape::hexahedron) return expect_orders(0.5);
  const Errors coarse = solve(4), fine = solve(6);
  const auto order = [&](double Errors::*error) {
    return std::log(coarse.*error / fine.*error) / std::log(1.5);
  };
  EXPECT_GT(order(&Errors::wall_displacement), 2.5);
  EXPECT_GT(order(&Errors::velocity), 2.85);
  EXPECT_GT(order(&Errors::pressure), 1.85);
}

class NearlyIncompressibleHexahedron : public NearlyIncompressibleSolid {};
INSTANTIATE_TEST_SUITE_P(Elements, NearlyIncompressibleHexahedron,
                         testing::Values(quadratic_hexahedron, linear_hexahedron), case_name);

// Without its own pressure the wall is too stiff.
TEST_P(NearlyIncompressibleHexahedron, IsSofterWithAPressureOfItsOwn) {
  const Errors mixed = solve(6);
  mixed_wall = false;
  const Errors locked = solve(6);
  RecordProperty("share", testing::PrintToString(mixed.wall_displacement / locked.wall_displacement));
  EXPECT_LT(mixed.wall_displacement, 0.92 * locked.wall_displacement);
}

}  // namespace
}  // namespace tunica::mms
