// SPDX-License-Identifier: GPL-3.0-or-later
// Orders of convergence in time of the coupled equations in three dimensions.
#include <gtest/gtest.h>

#include <vector>

#include "full3d/assembler.hpp"
#include "tests/mms/box_motions.hpp"
#include "tests/mms/march_errors.hpp"
#include "tests/mms/solid_cells.hpp"
#include "tests/support/box_mesh.hpp"

namespace tunica::mms {
namespace {

class SolidTimeOrders : public testing::Test {
 protected:
  SolidTimeOrders() {
    problem.mesh = test_support::box_mesh({vessel.width, vessel.thickness, vessel.depth, vessel.length, 1, 1,
                                           1, 2, full3d::Shape::hexahedron, true},
                                          [](const full3d::Point& x) { return x; });
    problem.directions = [](int, const element::solid::Local&, const full3d::Point&) {
      return box::Shape::directions();
    };
    set_march(vessel, problem);
  }

  void expect_order(time::Method method, double order, double least_pressure_order) {
    const full3d::Assembler assembler(problem, ranks);
    const auto run = [&](int count) {
      return march_errors<SolidCells>(assembler, problem, vessel, method, equal_steps(count));
    };
    expect_time_order(run, {40, 80, 160}, order, least_pressure_order);
  }

  const full3d::Ranks ranks;
  Vessel<box::PolynomialMotion> vessel;
  full3d::Problem problem;
};

TEST_F(SolidTimeOrders, AreWithoutErrorsInSpace) {
  expect_no_error_in_space<SolidCells>(full3d::Assembler(problem, ranks), problem, vessel);
}

TEST_F(SolidTimeOrders, OfBdf2) {
  expect_order(time::Method::bdf2, 2, 2);
}

TEST_F(SolidTimeOrders, OfBackwardEuler) {
  expect_order(time::Method::backward_euler, 1, 1);
}

TEST_F(SolidTimeOrders, OfGeneralizedAlpha) {
  expect_order(time::Method::generalized_alpha, 2, 2);
}

TEST_F(SolidTimeOrders, OfBdf2WhereTheMeshLags) {
  problem.discretisation.lagged_mesh = true;
  expect_order(time::Method::bdf2, 2, 2);
}

}  // namespace
}  // namespace tunica::mms
