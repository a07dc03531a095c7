// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/coupled/conditions.hpp"
#include "core/coupled/equations.hpp"
#include "tests/support/random_deformation.hpp"

/// The assembled derivative of coupled equations against their residual, by Taylor's theorem, at states far
/// from rest that solve nothing.
namespace tunica::test_support::tangent {

using coupled::Layout;

// Stiffnesses, densities and viscosity are all of order one, so that no term hides behind another: an error
// in the blood's share of an interface row must not drown in the wall's. Changes of volume are just stiff
// enough for their stress to be interpolated on its own.
inline constexpr wall::Volumetric<double> volumetric{40};
inline constexpr wall::Exp1<double> elastin{2, 0.5};

/// The threshold 1.2 lies within the range of I4 in these states. H bends on a scale of 1/sharpness, below
/// which the remainder is quadratic: with the paper's 5e5 round-off would rule there, with 20 it does not.
inline wall::Law<double> fibrous(double threshold) {
  wall::SplitLaw<double, wall::Exp1> law{volumetric, elastin, {}};
  for (const double angle : {0.75, -0.9}) law.families.push_back({angle, 1.0, 3.0, 0.4, threshold, 2, {20}});
  return law;
}

struct NamedLaw {
  const char* name;
  wall::Law<double> law;
};
inline std::vector<NamedLaw> laws() {
  return {{"EXP1", wall::SplitLaw<double, wall::Exp1>{volumetric, elastin, {}}},
          {"EXP2", wall::SplitLaw<double, wall::Exp2>{volumetric, {2, 0.3}, {}}},
          {"ZS", fibrous(1)},
          {"FS", fibrous(1.2)},
          {"linear elastic", wall::EnergyLaw<wall::LinearElastic<double>>{{5, 0.47}}},
          {"St. Venant-Kirchhoff", wall::EnergyLaw<wall::StVenantKirchhoff<double>>{{5, 0.48}}},
          {"compressible neo-Hookean", wall::EnergyLaw<wall::NeoHookeanCompressible<double>>{{2, 40}}}};
}

template <int dimension>
void set_conditions(coupled::Element element, coupled::Conditions<dimension>& conditions) {
  conditions.discretisation = {element, true};
  conditions.blood = {1.1, 0.6};
  conditions.laws = {laws()[0].law};
  conditions.wall_density = 1.3;
  conditions.tether = {2};
  conditions.inlet = {coupled::InletKind::flow, [](double) { return 0.7; }};
  conditions.outlet.resistance = 0.8;
  conditions.outlet.proximal_resistance = 0.4;
  conditions.outlet.compliance = 0.3;
  conditions.outlet.backflow = 0.5;
}

/// Calls check() with every law, its volume mixed and not.
template <int dimension, class Check>
void with_every_law(coupled::Conditions<dimension>& conditions, const Check& check) {
  for (const auto& [name, law] : laws())
    for (const bool mixed : {true, false}) {
      SCOPED_TRACE(testing::Message() << name << (mixed ? ", mixed" : ", not mixed"));
      conditions.laws = {law};
      conditions.discretisation.mixed_wall = mixed;
      check();
    }
}

template <int dimension, class Check>
void with_every_tether(coupled::Conditions<dimension>& conditions, const Check& check) {
  using radial::TetherTraction;
  for (const auto traction : {TetherTraction::normal, TetherTraction::reference, TetherTraction::current}) {
    SCOPED_TRACE(testing::Message() << "reading " << static_cast<int>(traction));
    conditions.tether.traction = traction;
    check();
  }
}

template <int dimension, class Check>
void with_every_inlet_and_outlet(coupled::Conditions<dimension>& conditions, const Check& check) {
  using coupled::InletKind, coupled::OutletKind;
  for (const auto inlet : {InletKind::prescribed, InletKind::flow, InletKind::pressure})
    for (const auto outlet : {OutletKind::prescribed, OutletKind::resistance, OutletKind::windkessel})
      for (const double backflow : {0.0, 0.5}) {
        SCOPED_TRACE(testing::Message() << "inlet " << static_cast<int>(inlet) << ", outlet "
                                        << static_cast<int>(outlet) << ", backflow " << backflow);
        conditions.inlet.kind = inlet;
        conditions.outlet.kind = outlet;
        conditions.outlet.backflow = backflow;
        auto& fixed = conditions.on(coupled::Boundary::inlet);
        fixed.displacement.fill(inlet == InletKind::prescribed);
        fixed.velocity = fixed.displacement;
        check();
      }
}

struct State {
  std::vector<double> value, history, mesh, mesh_rate;
  coupled::Stage stage;
};

/// Gives a state, whose displacement and velocity are set, pressures and rates of any size; speeds of the
/// mesh below `mesh_speed`.
inline void add_pressures_and_rates(const coupled::Equations& equations, double mesh_speed,
                                    double rate_coefficient, RandomDeformation& random, State& state) {
  const Layout& layout = equations.layout();
  equations.complete({0.3, 0, {}}, state.value);  // rates belong to what is prescribed
  for (std::size_t e = layout.pressure_begin(); e < layout.size(); ++e)
    state.value[e] = random.uniform(-2, 2);
  state.history.resize(layout.size());
  for (std::size_t e = 0; e < layout.size(); ++e) {
    const double rate =
        e < layout.velocity_begin() ? mesh_speed * random.uniform(-1, 1) : random.uniform(-3, 3);
    state.history[e] = rate - rate_coefficient * state.value[e];
  }
  state.stage = {0.3, rate_coefficient, state.history};
  equations.complete(state.stage, state.value);
  if (!layout.mesh_follows()) return;
  for (std::size_t e = 0; e < layout.velocity_begin(); ++e) {
    state.mesh.push_back(state.value[e] * (1 + 0.05 * random.uniform(-1, 1)));
    state.mesh_rate.push_back(mesh_speed * random.uniform(-1, 1));
  }
  state.stage.mesh = state.mesh;
  state.stage.mesh_rate = state.mesh_rate;
}

enum Field { wall_displacement, mesh_displacement, velocity, pressure, scalar, fields };
inline constexpr std::array<const char*, fields> row_names{"momentum of the wall", "motion of the mesh",
                                                           "momentum of the blood", "continuity", "scalars"};
inline constexpr std::array<const char*, fields> field_names{
    "displacement of the wall", "displacement of the mesh", "velocity", "pressure", "scalars"};

inline Field field_of(const Layout& layout, int unknown) {
  const std::size_t entry = layout.entry(unknown);
  if (entry < layout.velocity_begin())
    return layout.on_wall(layout.node_of(entry)) ? wall_displacement : mesh_displacement;
  if (entry < layout.pressure_begin()) return velocity;
  return entry < layout.scalar_begin() ? pressure : scalar;
}

/// The derivative at a state times a vector.
using Product = std::function<std::vector<double>(std::span<const double>)>;

/// Perturbs each field alone and looks at the rows of each equation alone: |R(y + h e) - R(y) - h J e| has
/// to fall as h^2, or to vanish where R is linear. `frozen`: the time of the pressure stabilisation, which
/// depends on the speed of the blood, that of the wall included, is held when the derivative is taken.
inline void expect_second_order(const coupled::Equations& equations, const State& state,
                                const Product& product, bool frozen, RandomDeformation& random) {
  const Layout& layout = equations.layout();
  const int unknowns = layout.unknowns();
  std::vector<Field> field(unknowns);
  for (int u = 0; u < unknowns; ++u) field[u] = field_of(layout, u);
  std::vector<double> residual(unknowns), moved_residual(unknowns), moved;
  ASSERT_TRUE(equations.residual(state.stage, state.value, residual));
  for (int column = 0; column < fields; ++column) {
    if (std::find(field.begin(), field.end(), column) == field.end()) continue;
    std::vector<double> direction(unknowns, 0.0);
    for (int u = 0; u < unknowns; ++u)
      if (field[u] == column) direction[u] = random.uniform(-1, 1);
    const std::vector<double> slope = product(direction);
    // From where the strains by nodes that move on their own are small.
    constexpr int first = 13, steps = 8;
    std::array<std::array<double, steps>, fields> remainder{};
    std::array<double, fields> size{};
    for (int k = 0; k < steps; ++k) {
      const double h = std::ldexp(1.0, -first - k);
      moved = state.value;
      for (int u = 0; u < unknowns; ++u) moved[layout.entry(u)] += h * direction[u];
      equations.complete(state.stage, moved);
      ASSERT_TRUE(equations.residual(state.stage, moved, moved_residual));
      for (int u = 0; u < unknowns; ++u) {
        const Field row = field[u];
        size[row] = std::max({size[row], std::abs(residual[u]), std::abs(slope[u])});
        remainder[row][k] = std::hypot(remainder[row][k], moved_residual[u] - residual[u] - h * slope[u]);
      }
    }
    for (int row = 0; row < fields; ++row) {
      if (size[row] == 0) continue;
      if (frozen && row == pressure && (column == velocity || column == wall_displacement)) continue;
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

}  // namespace tunica::test_support::tangent
