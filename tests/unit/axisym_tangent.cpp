// SPDX-License-Identifier: GPL-3.0-or-later
// The assembled derivative of the coupled equations in the half plane.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <stdexcept>
#include <string>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "tests/support/coupled_tangent.hpp"

namespace tunica::axisym {
namespace {

namespace tangent = test_support::tangent;
using test_support::RandomDeformation;

struct ElementCase {
  const char* name;
  CellShape shape;
  Element element;
};
std::ostream& operator<<(std::ostream& out, const ElementCase& c) {
  return out << c.name;
}

class CoupledTangent : public testing::TestWithParam<ElementCase> {
 protected:
  CoupledTangent() {
    problem.mesh = tube();
    // A smooth map to cells without right angles.
    for (auto& [r, z] : problem.mesh.points) {
      const double moved = r * (1 + 0.1 * std::sin(2 * z));
      z += 0.1 * std::sin(2 * r);
      r = moved;
    }
    tangent::set_conditions(GetParam().element, problem);
  }

  static Mesh tube() {
    TubeSpec spec;
    spec.radius = 1;
    spec.layers = {0.5};
    spec.length = 2;
    spec.blood_cells = spec.wall_cells = spec.axial_cells = 2;
    spec.shape = GetParam().shape;
    return structured_tube(spec);
  }

  /// A state with strains up to some 0.4, in which blood flows in through the outlet at up to twice the
  /// speed of the mesh, so that every flow there has the sign of backflow. `speed` scales the velocity.
  tangent::State random_state(const Assembler& assembler, double speed, double rate_coefficient) {
    const Layout& layout = assembler.layout();
    tangent::State state{std::vector<double>(layout.size()), {}, {}, {}, {}};
    const double ring = random.uniform(0.1, 0.25), axial = random.uniform(-0.1, 0.2),
                 shear = random.uniform(-0.2, 0.2), bend = random.uniform(-0.05, 0.05);
    const auto noise = [&](double size) { return random.uniform(-size, size); };
    for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
      const int node = static_cast<int>(n);
      const auto [r, z] = problem.mesh.points[n];
      state.value[layout.displacement(node, 0)] = r * (ring + bend * z + noise(0.01));
      state.value[layout.displacement(node, 1)] = axial * z + shear * r * r + noise(0.01);
      state.value[layout.velocity(node, 0)] = speed * r * noise(0.5);
      state.value[layout.velocity(node, 1)] = -speed * random.uniform(1.5, 2);
    }
    tangent::add_pressures_and_rates(assembler, 0.5 * speed, rate_coefficient, random, state);
    return state;
  }

  void expect_exact(double speed = 1, double rate_coefficient = 3) {
    SCOPED_TRACE(random.origin());
    const Assembler assembler(problem);
    const tangent::State state = random_state(assembler, speed, rate_coefficient);
    SparseMatrix matrix = assembler.pattern();
    assembler.tangent(state.stage, state.value, matrix);
    const auto product = [&](std::span<const double> direction) {
      std::vector<double> slope(direction.size());
      Eigen::Map<Eigen::VectorXd>(slope.data(), matrix.rows()) =
          matrix * Eigen::Map<const Eigen::VectorXd>(direction.data(), matrix.cols());
      return slope;
    };
    tangent::expect_second_order(assembler, state, product,
                                 GetParam().element == Element::linear && speed != 0, random);
  }

  RandomDeformation random;
  Problem problem;
};

INSTANTIATE_TEST_SUITE_P(
    Elements, CoupledTangent,
    testing::Values(ElementCase{"quadratic_quadrilateral", CellShape::quadrilateral, Element::quadratic},
                    ElementCase{"quadratic_triangle", CellShape::triangle, Element::quadratic},
                    ElementCase{"linear_quadrilateral", CellShape::quadrilateral, Element::linear},
                    ElementCase{"linear_triangle", CellShape::triangle, Element::linear},
                    ElementCase{"bubble_triangle", CellShape::triangle, Element::bubble}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_P(CoupledTangent, OfEveryLaw) {
  tangent::with_every_law(problem, [&] { expect_exact(); });
}

TEST_P(CoupledTangent, OfEveryTether) {
  tangent::with_every_tether(problem, [&] { expect_exact(); });
}

TEST_P(CoupledTangent, OfEveryInletAndOutlet) {
  tangent::with_every_inlet_and_outlet(problem, [&] { expect_exact(); });
}

TEST_P(CoupledTangent, OfAStiffenedMesh) {
  problem.discretisation.motion = coupled::MeshMotion::stiffened;
  expect_exact();
}

// The wall's displacement moves every point of its section, at once and within the columns of the derivative.
TEST_P(CoupledTangent, OfASectionalMesh) {
  problem.mesh = tube();
  problem.discretisation.motion = coupled::MeshMotion::sectional;
  // Centres of quadratic triangles lie in no section.
  if (GetParam().shape == CellShape::triangle && GetParam().element == Element::quadratic) {
    EXPECT_THROW(Assembler{problem}, std::logic_error);
    return;
  }
  tangent::with_every_inlet_and_outlet(problem, [&] { expect_exact(); });
}

// With the motion of the mesh none of the unknowns: the wall alone moves the blood's cells.
TEST_P(CoupledTangent, OnAMeshThatIsGiven) {
  problem.discretisation.lagged_mesh = true;
  tangent::with_every_tether(problem, [&] { expect_exact(); });
  problem.inlet.kind = InletKind::pressure;
  problem.outlet.kind = OutletKind::windkessel;
  expect_exact();
}

TEST_P(CoupledTangent, OfTheSteadyEquations) {
  expect_exact(1, 0);
}

// The stabilisation's time is 1/sqrt(a + b |v|^2): in blood at rest its derivative is zero, and the
// derivative of the linear element is exact too.
TEST_P(CoupledTangent, InBloodAtRest) {
  expect_exact(0);
}

// A wall alone, under a pressure that follows its inner surface.
TEST_P(CoupledTangent, OfAWallWithoutBlood) {
  TubeSpec spec;
  spec.radius = 1;
  spec.layers = {0.5};
  spec.length = 2;
  spec.wall_cells = spec.axial_cells = 2;
  spec.blood = false;
  spec.shape = GetParam().shape;
  problem.mesh = structured_tube(spec);
  problem.lumen_pressure = [](double) { return 1.5; };
  expect_exact();
}

}  // namespace
}  // namespace tunica::axisym
