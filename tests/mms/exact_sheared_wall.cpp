// SPDX-License-Identifier: GPL-3.0-or-later
// The wall of a pipe under the pressure and the shear of a steady flow, held by springs all along.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "core/coupled/newton.hpp"
#include "tests/support/lame_tube.hpp"

namespace tunica::axisym {
namespace {

using test_support::LameTube;
using test_support::LinearTube;

/// Greatest errors of the wall's displacement, relative to the greatest displacement along the same axis, and
/// of the velocity on the axis.
struct ShearErrors {
  double radial = 0, axial = 0, velocity = 0;
};

ShearErrors sheared_wall(int wall_cells, InletKind drive) {
  // Strains of order 1e-7: what is not linear is as small.
  const double spring = 3e6, viscosity = 0.04, gradient = 0.05, at_inlet = 0.3, length = 1.5;
  const LinearTube tube{0.5, 0.2, 3e6, 0.4, spring, spring};
  const LameTube exact(tube, at_inlet, gradient);
  const auto velocity = [&](double r) {
    return gradient / (4 * viscosity) * (tube.radius * tube.radius - r * r);
  };
  const double flow = std::numbers::pi * gradient * std::pow(tube.radius, 4) / (8 * viscosity);

  Problem problem;
  TubeSpec spec;
  spec.radius = tube.radius;
  spec.layers = {tube.thickness};
  spec.length = length;
  spec.blood_cells = 2;
  spec.wall_cells = wall_cells;
  spec.axial_cells = 4;
  problem.mesh = structured_tube(spec);
  problem.blood = {1.0, viscosity};
  problem.laws = {wall::EnergyLaw<wall::LinearElastic<double>>{{tube.young_modulus, tube.poisson_ratio}}};
  problem.wall_density = 1.2;
  problem.tether = {spring, radial::TetherTraction::reference};
  problem.displacement = [&](const Point& x, double) {
    if (x[0] >= tube.radius) return exact.at(std::min(x[0], tube.outer_radius()), x[1]).displacement;
    const auto at_wall = exact.at(tube.radius, x[1]).displacement;
    const double share = x[0] / tube.radius;
    return Vector<double>{share * at_wall[0], 0, share * share * at_wall[2]};
  };
  problem.velocity = [&](const Point& x, double) { return Vector<double>{0, 0, velocity(x[0])}; };
  for (const auto boundary : {Boundary::inlet, Boundary::outlet, Boundary::wall_inlet, Boundary::wall_outlet})
    problem.on(boundary).displacement = {true, true};
  problem.on(Boundary::inlet).velocity = {true, drive == InletKind::prescribed};
  problem.on(Boundary::outlet).velocity = {true, false};
  problem.inlet.kind = drive;
  if (drive == InletKind::flow) problem.inlet.value = [&](double) { return flow; };
  if (drive == InletKind::pressure) problem.inlet.value = [&](double) { return at_inlet; };
  problem.outlet.resistance = exact.pressure(length) / flow;

  const Assembler assembler(problem);
  const Layout& layout = assembler.layout();
  std::vector<double> y(layout.size());
  coupled::Newton newton(assembler);
  const auto report = newton.solve({}, y, {1e-11, 30});
  EXPECT_TRUE(report.converged) << report.failure;
  ShearErrors error, size;
  for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
    const int node = static_cast<int>(n);
    const auto [r, z] = problem.mesh.points[n];
    if (r == 0)
      error.velocity = std::max(error.velocity, std::abs(y[layout.velocity(node, 1)] / velocity(0) - 1));
    if (!layout.on_wall(node)) continue;
    const auto u = exact.at(std::clamp(r, tube.radius, tube.outer_radius()), z).displacement;
    size.radial = std::max(size.radial, std::abs(u[0]));
    size.axial = std::max(size.axial, std::abs(u[2]));
    error.radial = std::max(error.radial, std::abs(y[layout.displacement(node, 0)] - u[0]));
    error.axial = std::max(error.axial, std::abs(y[layout.displacement(node, 1)] - u[2]));
  }
  return {error.radial / size.radial, error.axial / size.axial, error.velocity};
}

TEST(ShearedWall, HasTheExactDisplacement) {
  for (const auto drive : {InletKind::prescribed, InletKind::flow, InletKind::pressure}) {
    SCOPED_TRACE(testing::Message() << "drive " << static_cast<int>(drive));
    const auto coarse = sheared_wall(3, drive), fine = sheared_wall(6, drive);
    EXPECT_LT(fine.radial, 1e-5);
    EXPECT_LT(fine.axial, 1e-5);
    EXPECT_LT(fine.velocity, 1e-5);
    // Order 3 is sure, and nodes are better places than most.
    EXPECT_GT(std::log2(coarse.radial / fine.radial), 3);
    EXPECT_GT(std::log2(coarse.axial / fine.axial), 3);
  }
}

}  // namespace
}  // namespace tunica::axisym
