// SPDX-License-Identifier: GPL-3.0-or-later
// The assembled derivative of the coupled equations in space.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "full3d/assembler.hpp"
#include "tests/support/coupled_tangent.hpp"
#include "tests/support/solid_cases.hpp"

namespace tunica::full3d {
namespace {

namespace tangent = test_support::tangent;
using test_support::RandomDeformation, test_support::SolidCase;

/// A matrix of PETSc times a vector that is numbered as the unknowns, on one process.
std::vector<double> times(const Share& share, std::span<const double> direction) {
  OwnedVector in, out;
  check(MatCreateVecs(share.matrix(), in.put(), out.put()), "MatCreateVecs");
  PetscScalar* values = nullptr;
  check(VecGetArray(in.get(), &values), "VecGetArray");
  for (std::size_t u = 0; u < direction.size(); ++u)
    values[share.petsc_index(static_cast<int>(u))] = direction[u];
  check(VecRestoreArray(in.get(), &values), "VecRestoreArray");
  check(MatMult(share.matrix(), in.get(), out.get()), "MatMult");
  const PetscScalar* found = nullptr;
  check(VecGetArrayRead(out.get(), &found), "VecGetArrayRead");
  std::vector<double> product(direction.size());
  for (std::size_t u = 0; u < product.size(); ++u) product[u] = found[share.petsc_index(static_cast<int>(u))];
  check(VecRestoreArrayRead(out.get(), &found), "VecRestoreArrayRead");
  return product;
}

/// A quarter of a straight vessel or a half of a bent one.
class SolidTangent : public testing::TestWithParam<std::tuple<SolidCase, bool>> {
 protected:
  SolidTangent() {
    make_mesh(true);
    tangent::set_conditions(element(), problem);
  }

  Element element() const { return std::get<0>(GetParam()).element; }

  void make_mesh(bool blood) {
    const auto& [kind, bent] = GetParam();
    VesselSpec spec =
        test_support::coarse_vessel(kind, bent ? Sector::half : Sector::quarter, bent ? 0.8 : 0);
    spec.blood = blood;
    problem.mesh = o_grid_vessel(spec);
    problem.copies = test_support::copies(spec.sector);
    problem.directions = test_support::directions_of(spec);
    // A smooth map to cells without right angles.
    for (auto& [x, y, z] : problem.mesh.points) {
      const Point p{x, y, z};
      x += 0.06 * std::sin(2 * p[2]) + 0.04 * p[1] * p[1];
      y += 0.06 * std::sin(1.5 * p[0]) * (1 + p[2]);
      z += 0.08 * std::sin(2 * p[0]) - 0.05 * std::cos(p[1]);
    }
  }

  /// A state with strains up to some 0.4, in which blood flows in through the outlet at up to twice the
  /// speed of the mesh, so that every flow there has the sign of backflow. `speed` scales the velocity.
  tangent::State random_state(const Assembler& assembler, double speed, double rate_coefficient) {
    const Layout& layout = assembler.layout();
    tangent::State state{std::vector<double>(layout.size()), {}, {}, {}, {}};
    const auto noise = [&](double size) { return random.uniform(-size, size); };
    // Next to nothing across the planes of symmetry, where it is held.
    const Point stretch{random.uniform(0.1, 0.25), random.uniform(0.1, 0.25), random.uniform(-0.1, 0.2)},
        bend{noise(0.05), noise(0.05), noise(0.05)}, shear{noise(0.1), noise(0.1), noise(0.2)};
    for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
      const int node = static_cast<int>(n);
      const Point& x = problem.mesh.points[n];
      const auto axial = problem.directions(0, {}, x).axial;
      for (int i = 0; i < 3; ++i) {
        state.value[layout.displacement(node, i)] =
            x[i] * (stretch[i] + bend[i] * x[2]) + shear[i] * x[0] * x[1] + noise(0.004);
        state.value[layout.velocity(node, i)] = speed * (noise(0.2) - random.uniform(1.5, 2) * axial[i]);
      }
    }
    tangent::add_pressures_and_rates(assembler, 0.3 * speed, rate_coefficient, random, state);
    return state;
  }

  void expect_exact(double speed = 1, double rate_coefficient = 3) {
    SCOPED_TRACE(random.origin());
    const Assembler assembler(problem, ranks, all_rows);
    const tangent::State state = random_state(assembler, speed, rate_coefficient);
    assembler.share().assemble(assembler.loaded(state.stage, state.value), state.value);
    const auto product = [&](std::span<const double> direction) {
      return times(assembler.share(), direction);
    };
    tangent::expect_second_order(assembler, state, product, element() == Element::linear && speed != 0,
                                 random);
  }

  /// The matrix has the rows of bubbles, too.
  const SolverChoice all_rows = [] {
    SolverChoice choice;
    choice.condense = false;
    return choice;
  }();
  const Ranks ranks;
  RandomDeformation random;
  Problem problem;
};

INSTANTIATE_TEST_SUITE_P(Elements, SolidTangent,
                         testing::Combine(testing::ValuesIn(test_support::solid_cases), testing::Bool()),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param).name) +
                                  (std::get<1>(test.param) ? "_bent" : "_straight");
                         });

TEST_P(SolidTangent, OfEveryLaw) {
  tangent::with_every_law(problem, [&] { expect_exact(); });
}

TEST_P(SolidTangent, OfEveryTether) {
  tangent::with_every_tether(problem, [&] { expect_exact(); });
}

TEST_P(SolidTangent, OfEveryInletAndOutlet) {
  tangent::with_every_inlet_and_outlet(problem, [&] { expect_exact(); });
}

TEST_P(SolidTangent, OfAStiffenedMesh) {
  problem.discretisation.motion = coupled::MeshMotion::stiffened;
  expect_exact();
}

// Displacements along the vessel and across it act on each other's equations, at a bend on all.
TEST_P(SolidTangent, OfSectionsThatLean) {
  problem.discretisation.motion = coupled::MeshMotion::sectional;
  problem.sections = [](const Point& point) {
    const double angle = 0.3 * point[2];
    return physics::MotionInSections{{-std::sin(angle), 0, std::cos(angle)}, 9, 0.4 * std::cos(point[2])};
  };
  expect_exact();
}

// With the motion of the mesh none of the unknowns: the wall alone moves the blood's cells.
TEST_P(SolidTangent, OnAMeshThatIsGiven) {
  problem.discretisation.lagged_mesh = true;
  tangent::with_every_tether(problem, [&] { expect_exact(); });
  problem.inlet.kind = InletKind::pressure;
  problem.outlet.kind = OutletKind::windkessel;
  expect_exact();
}

TEST_P(SolidTangent, OfTheSteadyEquations) {
  expect_exact(1, 0);
}

// As in two dimensions: without speed the derivative of the pressure stabilisation is exact too.
TEST_P(SolidTangent, InBloodAtRest) {
  expect_exact(0);
}

// A wall alone, under a pressure that follows its inner surface.
TEST_P(SolidTangent, OfAWallWithoutBlood) {
  make_mesh(false);
  problem.lumen_pressure = [](double) { return 1.5; };
  expect_exact();
}

class CondensedBubbles : public SolidTangent {};
INSTANTIATE_TEST_SUITE_P(Elements, CondensedBubbles,
                         testing::Combine(testing::Values(test_support::solid_cases[4]), testing::Bool()),
                         [](const auto& test) { return std::get<1>(test.param) ? "bent" : "straight"; });

TEST_P(CondensedBubbles, LeaveTheSolutionAsItIs) {
  SCOPED_TRACE(random.origin());
  const Assembler whole(problem, ranks, all_rows), condensed(problem, ranks);
  const tangent::State state = random_state(whole, 1, 3);
  std::vector<double> expected(whole.layout().unknowns());
  for (double& value : expected) value = random.uniform(-1, 1);
  std::vector<double> found = expected;
  ASSERT_TRUE(whole.share().factorise(whole.loaded(state.stage, state.value), state.value));
  ASSERT_TRUE(whole.share().solve(expected));
  ASSERT_TRUE(condensed.share().factorise(condensed.loaded(state.stage, state.value), state.value));
  ASSERT_TRUE(condensed.share().solve(found));
  double size = 0;
  for (const double value : expected) size = std::max(size, std::abs(value));
  // Round-off, times the condition of these small matrices.
  for (std::size_t u = 0; u < found.size(); ++u) EXPECT_NEAR(found[u], expected[u], 1e-9 * size) << u;
  EXPECT_LT(condensed.share().entries(), whole.share().entries());
}

}  // namespace
}  // namespace tunica::full3d
