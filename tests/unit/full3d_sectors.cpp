// SPDX-License-Identifier: GPL-3.0-or-later
// A half and a quarter of a vessel stand for the whole.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "full3d/assembler.hpp"
#include "tests/support/coupled_tangent.hpp"
#include "tests/support/solid_cases.hpp"

namespace tunica::full3d {
namespace {

using test_support::SolidCase;

/// A vessel in motion that is its own mirror image about x = 0 and about y = 0.
struct MirroredVessel {
  MirroredVessel(const SolidCase& kind, Sector sector, const Ranks& ranks)
      : problem(make_problem(kind, sector)), assembler(problem, ranks), residual(layout().unknowns()) {
    value.resize(layout().size());
    history.resize(layout().size());
    for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
      const int node = static_cast<int>(n);
      const auto& [x, y, z] = problem.mesh.points[n];
      const double xx = x * x, yy = y * y;
      set(node, &Layout::displacement,
          {x * (0.1 + 0.05 * yy + 0.02 * z), y * (0.15 - 0.03 * xx),
           0.1 * std::sin(z) + 0.05 * xx + 0.02 * yy},
          {0.2 * x * (1 + yy), 0.3 * y * (1 - 0.2 * z), 0.2 * std::cos(z + xx)});
      // A bubble is a coefficient of its own, small and of the same symmetries.
      const double size = layout().has_displacement(node) ? 1 : 0.1;
      set(node, &Layout::velocity, {size * x * z, size * y * (0.5 - xx), -size * (1.5 + 0.2 * xx - 0.1 * yy)},
          {x * yy, y * std::cos(z), xx - 2 * yy});
      if (layout().has_pressure(node)) value[layout().pressure(node)] = 1 + xx - 0.3 * yy + std::sin(z);
    }
    value[*layout().inlet_pressure] = 2;
    value[*layout().outlet_pressure] = 1.3;
    value[*layout().windkessel_pressure] = 0.7;
    history[*layout().windkessel_pressure] = 0.4;
    stage = {0.3, 3, history};
    assembler.complete(stage, value);
    EXPECT_TRUE(assembler.residual(stage, value, residual));
  }

  static Problem make_problem(const SolidCase& kind, Sector sector) {
    Problem problem;
    const VesselSpec spec = test_support::coarse_vessel(kind, sector);
    problem.mesh = o_grid_vessel(spec);
    problem.directions = test_support::directions_of(spec);
    problem.copies = test_support::copies(sector);
    test_support::tangent::set_conditions(kind.element, problem);
    problem.outlet.kind = OutletKind::windkessel;
    return problem;
  }

  const Layout& layout() const { return assembler.layout(); }
  void set(int node, std::size_t (Layout::*entry)(int, int) const, const Point& values, const Point& rates) {
    for (int c = 0; c < 3; ++c) {
      const std::size_t e = (layout().*entry)(node, c);
      value[e] = values[c];
      history[e] = rates[c] - 3 * values[c];
    }
  }

  Problem problem;
  Assembler assembler;
  std::vector<double> residual, value, history;
  coupled::Stage stage;
};

class SectorsOfVessels : public testing::TestWithParam<std::tuple<SolidCase, Sector>> {};

// A node on a plane of symmetry has a half of its cells in the sector, one on the axis of a quarter a fourth
// of them; flows, and with them the scalar equations, are those of the whole vessel.
TEST_P(SectorsOfVessels, HaveTheResidualOfTheWhole) {
  const auto& [kind, sector] = GetParam();
  const Ranks ranks;
  const MirroredVessel whole(kind, Sector::full, ranks), part(kind, sector, ranks);
  const Layout& layout = part.layout();
  std::map<Point, int> node_of_whole;
  for (std::size_t n = 0; n < whole.problem.mesh.points.size(); ++n)
    node_of_whole[whole.problem.mesh.points[n]] = static_cast<int>(n);
  double size = 0;
  for (const double r : whole.residual) size = std::max(size, std::abs(r));
  const double tolerance = 1e-13 * size;  // sums of some hundred terms
  const auto compare = [&](std::size_t entry, std::size_t entry_of_whole, double shares) {
    const int u = layout.unknown(entry), v = whole.layout().unknown(entry_of_whole);
    if (u < 0) return;
    ASSERT_GE(v, 0);
    EXPECT_NEAR(shares * part.residual[u], whole.residual[v], tolerance) << "entry " << entry;
  };
  for (std::size_t n = 0; n < part.problem.mesh.points.size(); ++n) {
    const int node = static_cast<int>(n);
    const Point& x = part.problem.mesh.points[n];
    const auto found = node_of_whole.find(x);
    ASSERT_NE(found, node_of_whole.end());
    const double shares = (x[1] == 0 ? 2 : 1) * (sector == Sector::quarter && x[0] == 0 ? 2 : 1);
    for (int c = 0; c < 3; ++c) {
      compare(layout.displacement(node, c), whole.layout().displacement(found->second, c), shares);
      compare(layout.velocity(node, c), whole.layout().velocity(found->second, c), shares);
    }
    if (layout.has_pressure(node))
      compare(layout.pressure(node), whole.layout().pressure(found->second), shares);
  }
  compare(*layout.inlet_pressure, *whole.layout().inlet_pressure, 1);
  compare(*layout.outlet_pressure, *whole.layout().outlet_pressure, 1);
  compare(*layout.windkessel_pressure, *whole.layout().windkessel_pressure, 1);
  for (const Boundary boundary : {Boundary::inlet, Boundary::outlet}) {
    const double flow = whole.assembler.flow(whole.stage, whole.value, boundary).net;
    EXPECT_NEAR(part.assembler.flow(part.stage, part.value, boundary).net, flow, 1e-13 * std::abs(flow));
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, SectorsOfVessels,
                         testing::Combine(testing::ValuesIn(test_support::solid_cases),
                                          testing::Values(Sector::half, Sector::quarter)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param).name) +
                                  (std::get<1>(test.param) == Sector::half ? "_half" : "_quarter");
                         });

}  // namespace
}  // namespace tunica::full3d
