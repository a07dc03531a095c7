// SPDX-License-Identifier: GPL-3.0-or-later
// The assembled derivative of the coupled equations against the residual, by Taylor's theorem, at states far
// from rest that solve nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "tests/support/random_deformation.hpp"

namespace tunica::axisym {
namespace {

using test_support::RandomDeformation;

// Stiffnesses, densities and viscosity are all of order one, so that no term hides behind another: an error
// in the blood's share of an interface row must not drown in the wall's.
constexpr wall::Volumetric<double> volumetric{20};
constexpr wall::Exp1<double> elastin{2, 0.5};

/// The threshold 1.2 lies within the range of I4 in these states. H bends on a scale of 1/sharpness, below
/// which the remainder is quadratic: with the paper's 5e5 round-off would rule there, with 20 it does not.
wall::Law<double> fibrous(double threshold) {
  wall::SplitLaw<double, wall::Exp1> law{volumetric, elastin, {}};
  for (const double angle : {0.75, -0.9}) law.families.push_back({angle, 1.0, 3.0, 0.4, threshold, 2, {20}});
  return law;
}

struct NamedLaw {
  const char* name;
  wall::Law<double> law;
};
std::vector<NamedLaw> laws() {
  return {{"EXP1", wall::SplitLaw<double, wall::Exp1>{volumetric, elastin, {}}},
          {"EXP2", wall::SplitLaw<double, wall::Exp2>{volumetric, {2, 0.3}, {}}},
          {"ZS", fibrous(1)},
          {"FS", fibrous(1.2)},
          {"linear elastic", wall::EnergyLaw<wall::LinearElastic<double>>{{5, 0.3}}}};
}

struct ElementCase {
  const char* name;
  CellShape shape;
  Element element;
};
std::ostream& operator<<(std::ostream& out, const ElementCase& c) {
  return out << c.name;
}

enum Field { wall_displacement, mesh_displacement, velocity, pressure, scalar, fields };
constexpr std::array<const char*, fields> row_names{"momentum of the wall", "motion of the mesh",
                                                    "momentum of the blood", "continuity", "scalars"};
constexpr std::array<const char*, fields> field_names{"displacement of the wall", "displacement of the mesh",
                                                      "velocity", "pressure", "scalars"};

Field field_of(const Layout& layout, int unknown) {
  const std::size_t entry = layout.entry(unknown);
  if (entry < layout.velocity_begin())
    return layout.on_wall(static_cast<int>(entry / 2)) ? wall_displacement : mesh_displacement;
  if (entry < layout.pressure_begin()) return velocity;
  return entry < layout.scalar_begin() ? pressure : scalar;
}

class CoupledTangent : public testing::TestWithParam<ElementCase> {
 protected:
  CoupledTangent() {
    TubeSpec spec;
    spec.radius = 1;
    spec.layers = {0.5};
    spec.length = 2;
    spec.blood_cells = spec.wall_cells = spec.axial_cells = 2;
    spec.shape = GetParam().shape;
    problem.mesh = structured_tube(spec);
    // A smooth map to cells without right angles.
    for (auto& [r, z] : problem.mesh.points) {
      const double moved = r * (1 + 0.1 * std::sin(2 * z));
      z += 0.1 * std::sin(2 * r);
      r = moved;
    }
    problem.discretisation = {GetParam().element, true, false};
    problem.blood = {1.1, 0.6};
    problem.laws = {laws()[0].law};
    problem.wall_density = 1.3;
    problem.tether = {2};
    problem.inlet = {InletKind::flow, [](double) { return 0.7; }};
    problem.outlet.resistance = 0.8;
    problem.outlet.proximal_resistance = 0.4;
    problem.outlet.compliance = 0.3;
    problem.outlet.backflow = 0.5;
  }

  /// A state with strains up to some 0.4, in which blood flows in through the outlet at up to twice the
  /// speed of the mesh, so that every flow there has the sign of backflow. `speed` scales the velocity.
  struct State {
    std::vector<double> value, history;
    Stage stage;
  };
  State random_state(const Assembler& assembler, double speed, double rate_coefficient) {
    const Layout& layout = assembler.layout();
    State state{std::vector<double>(layout.size()), std::vector<double>(layout.size()), {}};
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
    for (std::size_t e = layout.pressure_begin(); e < layout.size(); ++e) state.value[e] = noise(2);
    for (std::size_t e = 0; e < layout.size(); ++e) {
      // Rates of any size for velocity and scalars; speeds below one for the mesh.
      const double rate = e < layout.velocity_begin() ? speed * noise(0.5) : noise(3);
      state.history[e] = rate - rate_coefficient * state.value[e];
    }
    state.stage = {0.3, rate_coefficient, state.history};
    assembler.complete(state.stage, state.value);
    return state;
  }

  /// Perturbs each field alone and looks at the rows of each equation alone: |R(y + h e) - R(y) - h J e| has
  /// to fall as h^2, or to vanish where R is linear.
  /// `is_exact(row, column)` tells where the derivative claims to be that.
  template <class IsExact>
  void expect_second_order(double speed, double rate_coefficient, const IsExact& is_exact) {
    const Assembler assembler(problem);
    const Layout& layout = assembler.layout();
    const State state = random_state(assembler, speed, rate_coefficient);
    const int unknowns = layout.unknowns();
    std::vector<double> residual(unknowns), moved_residual(unknowns), moved;
    ASSERT_TRUE(assembler.residual(state.stage, state.value, residual));
    SparseMatrix matrix = assembler.pattern();
    assembler.tangent(state.stage, state.value, matrix);
    for (int column = 0; column < fields; ++column) {
      Eigen::VectorXd direction = Eigen::VectorXd::Zero(unknowns);
      for (int u = 0; u < unknowns; ++u)
        if (field_of(layout, u) == column) direction[u] = random.uniform(-1, 1);
      if (direction.isZero()) continue;
      const Eigen::VectorXd slope = matrix * direction;
      // From where the strains by nodes that move on their own are small.
      constexpr int first = 13, steps = 8;
      std::array<std::array<double, steps>, fields> remainder{};
      std::array<double, fields> size{};
      for (int k = 0; k < steps; ++k) {
        const double h = std::ldexp(1.0, -first - k);
        moved = state.value;
        for (int u = 0; u < unknowns; ++u) moved[layout.entry(u)] += h * direction[u];
        assembler.complete(state.stage, moved);
        ASSERT_TRUE(assembler.residual(state.stage, moved, moved_residual));
        for (int u = 0; u < unknowns; ++u) {
          const Field row = field_of(layout, u);
          size[row] = std::max({size[row], std::abs(residual[u]), std::abs(slope[u])});
          remainder[row][k] = std::hypot(remainder[row][k], moved_residual[u] - residual[u] - h * slope[u]);
        }
      }
      for (int row = 0; row < fields; ++row) {
        if (size[row] == 0 || !is_exact(row, column)) continue;
        SCOPED_TRACE(testing::Message() << row_names[row] << " by " << field_names[column]);
        // What sums of some hundred terms round to; a thousand times as much spoils no order.
        const double round_off = 10 * std::numeric_limits<double>::epsilon() * size[row];
        int orders = 0;
        for (int k = 0; k + 1 < steps && remainder[row][k + 1] > 1e3 * round_off; ++k, ++orders)
          EXPECT_NEAR(std::log2(remainder[row][k] / remainder[row][k + 1]), 2, 0.1) << "at 2^-" << first + k;
        // Linear, or of a curvature that does not show at the second h: errors of the derivative above
        // 1e-7 would show.
        if (orders == 0) {
          EXPECT_LT(remainder[row][0], 5e3 * round_off);
        }
      }
    }
  }
  void expect_exact(double speed = 1, double rate_coefficient = 3) {
    SCOPED_TRACE(random.origin());
    const bool frozen = GetParam().element == Element::linear && speed != 0;
    expect_second_order(speed, rate_coefficient, [frozen](int row, int column) {
      // The time of the pressure stabilisation depends on the speed of the blood, that of the wall included,
      // and is held when the derivative is taken.
      return !frozen || row != pressure || (column != velocity && column != wall_displacement);
    });
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
  for (const auto& [name, law] : laws())
    for (const bool mixed : {true, false}) {
      SCOPED_TRACE(testing::Message() << name << (mixed ? ", mixed" : ", not mixed"));
      problem.laws = {law};
      problem.discretisation.mixed_wall = mixed;
      expect_exact();
    }
}

TEST_P(CoupledTangent, OfEveryTether) {
  using radial::TetherTraction;
  for (const auto traction : {TetherTraction::normal, TetherTraction::reference, TetherTraction::current}) {
    SCOPED_TRACE(testing::Message() << "reading " << static_cast<int>(traction));
    problem.tether.traction = traction;
    expect_exact();
  }
}

TEST_P(CoupledTangent, OfEveryInletAndOutlet) {
  for (const auto inlet : {InletKind::prescribed, InletKind::flow, InletKind::pressure})
    for (const auto outlet : {OutletKind::prescribed, OutletKind::resistance, OutletKind::windkessel})
      for (const double backflow : {0.0, 0.5}) {
        SCOPED_TRACE(testing::Message() << "inlet " << static_cast<int>(inlet) << ", outlet "
                                        << static_cast<int>(outlet) << ", backflow " << backflow);
        problem.inlet.kind = inlet;
        problem.outlet.kind = outlet;
        problem.outlet.backflow = backflow;
        const bool holds = inlet == InletKind::prescribed;
        problem.on(Boundary::inlet) = {{holds, holds}, {holds, holds}};
        expect_exact();
      }
}

TEST_P(CoupledTangent, OfAStiffenedMesh) {
  problem.discretisation.stiffened_mesh = true;
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
