// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/assembler.hpp"
#include "axisym/prolong.hpp"

#include <gtest/gtest.h>

#include "axisym/setup.hpp"

namespace tunica::axisym {
namespace {

/// A field that quadratic cells hold exactly, and one that linear pressures do.
double quadratic(const Point& x, double seed) {
  return seed + 3 * x[0] - 2 * x[1] + seed * x[0] * x[0] + 0.7 * x[0] * x[1] - 0.4 * x[1] * x[1];
}
double linear(const Point& x) {
  return 5 - 7 * x[0] + 11 * x[1];
}

std::vector<double> fill(const Assembler& assembler) {
  const Layout& layout = assembler.layout();
  const Mesh& mesh = assembler.problem().mesh;
  std::vector<double> y(layout.size());
  for (std::size_t k = 0; k < mesh.points.size(); ++k) {
    const int node = static_cast<int>(k);
    for (int c = 0; c < 2; ++c) {
      y[layout.displacement(node, c)] = quadratic(mesh.points[k], 1 + c);
      y[layout.velocity(node, c)] = quadratic(mesh.points[k], 5 + c);
    }
    if (layout.has_pressure(node)) y[layout.pressure(node)] = linear(mesh.points[k]);
  }
  for (std::size_t e = layout.scalar_begin(); e < layout.size(); ++e) y[e] = 13 + static_cast<double>(e);
  return y;
}

// On straight cells, whose map is affine, polynomials of the basis stay what they are.
TEST(Prolong, KeepsWhatTheCoarseMeshHolds) {
  const Scene scene = parse_scene("[wall]\n", "tube", ".", {"outlet.kind=rcr", "inlet.profile=natural"});
  const auto coarse = setup_of(scene, Resolution{.wall_cells = 2, .blood_cells = 2, .axial_cells = 6});
  const auto fine = setup_of(scene, Resolution{.wall_cells = 5, .blood_cells = 3, .axial_cells = 10});
  const Assembler from(coarse->problem), to(fine->problem);
  const auto state = fill(from), expected = fill(to), found = prolong(from, state, to);
  ASSERT_EQ(found.size(), expected.size());
  const std::size_t scalars = to.layout().scalar_begin();
  for (std::size_t e = 0; e < scalars; ++e) ASSERT_NEAR(found[e], expected[e], 1e-12) << e;
  for (std::size_t s = 0; s + scalars < found.size(); ++s)
    EXPECT_EQ(found[scalars + s], state[from.layout().scalar_begin() + s]);
}

TEST(Prolong, RefusesAnotherVessel) {
  const Resolution cells{.wall_cells = 2, .blood_cells = 2, .axial_cells = 6};
  const auto one = setup_of(parse_scene("[wall]\n", "tube", "."), cells);
  const auto longer = setup_of(parse_scene("[geometry]\nlength = 0.7\n", "tube", "."), cells);
  const Assembler from(one->problem), to(longer->problem);
  EXPECT_THROW(prolong(from, fill(from), to), std::logic_error);
}

}  // namespace
}  // namespace tunica::axisym
