// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/locate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "axisym/structured.hpp"
#include "core/error.hpp"
#include "tests/support/mesh_measures.hpp"
#include "tests/support/random_deformation.hpp"

namespace {

using namespace tunica;
using namespace tunica::axisym;
using element::Local;
using test_support::RandomDeformation;

/// Centres of triangles belong to the quadratic map: -1/9 of the corners and 4/9 of the middles.
void put_centres_on_the_map(Mesh& mesh) {
  for (const Cell& cell : mesh.cells) {
    Local centre{};
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 2; ++i)
        centre[i] += (4 * mesh.points[cell.nodes[3 + k]][i] - mesh.points[cell.nodes[k]][i]) / 9;
    mesh.points[cell.nodes[6]] = centre;
  }
}

/// A wavy tube: every node of a straight one (R = 1, wall 0.4, L = 4) is moved, so that sides are curved.
Mesh wavy_tube(CellShape shape, int blood_cells = 3, int axial_cells = 8) {
  TubeSpec spec;
  spec.radius = 1;
  spec.layers = {0.1, 0.3};
  spec.length = 4;
  spec.blood_cells = blood_cells;
  spec.wall_cells = 3;
  spec.axial_cells = axial_cells;
  spec.interface_grading = 2;
  spec.shape = shape;
  Mesh mesh = structured_tube(spec);
  for (auto& [r, z] : mesh.points) {
    r *= 1 - 0.3 * std::pow(std::sin(std::numbers::pi * z / 4), 2);
    z += 0.1 * r * r * std::sin(std::numbers::pi * z / 2);
  }
  if (shape == CellShape::triangle) put_centres_on_the_map(mesh);
  return mesh;
}

class Locate : public testing::TestWithParam<CellShape> {};

INSTANTIATE_TEST_SUITE_P(Cells, Locate, testing::Values(CellShape::quadrilateral, CellShape::triangle),
                         [](const auto& test) {
                           return test.param == CellShape::triangle ? "triangles" : "quadrilaterals";
                         });

Local random_local(RandomDeformation& random, CellShape shape) {
  if (shape == CellShape::quadrilateral) return {random.uniform(-1, 1), random.uniform(-1, 1)};
  const double a = random.uniform(0, 1), b = random.uniform(0, 1);
  return a + b <= 1 ? Local{a, b} : Local{1 - a, 1 - b};
}

TEST_P(Locate, ComesBackToTheCellAndItsCoordinates) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  const Mesh mesh = wavy_tube(GetParam());
  for (int trial = 0; trial < 2000; ++trial) {
    const int cell = static_cast<int>(random.uniform(0, static_cast<double>(mesh.cells.size())));
    const Local local = random_local(random, mesh.shape);
    const auto place = locate(mesh, image(mesh, cell, local).point, mesh.cells[cell].part);
    ASSERT_TRUE(place);
    EXPECT_EQ(place->cell, cell);
    // Rounding of the point, 1e-16 L, over the least singular value of the map, about 0.05 cm.
    for (int c = 0; c < 2; ++c) EXPECT_NEAR(place->local[c], local[c], 1e-13);
  }
}

/// A cell whose nodes are anywhere within `most` of their places, with a map that is one to one: its
/// determinant is positive at 400 points and more.
Mesh distorted_cell(RandomDeformation& random, CellShape shape, double most) {
  for (;;) {
    Mesh mesh;
    mesh.shape = shape;
    Cell cell{{}, Part::wall, 0};
    for (int n = 0; n < mesh.nodes_per_cell(); ++n) {
      const Local at = element::node_position(shape, n);
      mesh.points.push_back({5 + at[0] + random.uniform(-most, most), at[1] + random.uniform(-most, most)});
      cell.nodes[n] = n;
    }
    mesh.cells.push_back(cell);
    if (shape == CellShape::triangle) put_centres_on_the_map(mesh);
    bool one_to_one = true;
    constexpr int intervals = 28;
    for (int i = 0; i <= intervals; ++i)
      for (int j = 0; j <= (shape == CellShape::triangle ? intervals - i : intervals); ++j) {
        const double a = static_cast<double>(i) / intervals, b = static_cast<double>(j) / intervals;
        const Local local = shape == CellShape::triangle ? Local{a, b} : Local{2 * a - 1, 2 * b - 1};
        one_to_one = one_to_one && image(mesh, 0, local).determinant() > 1e-3;
      }
    if (one_to_one) return mesh;
  }
}

TEST_P(Locate, FindsPointsOfCellsInWhichOneStartDoesNotConverge) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  // From the centre alone Newton's method misses one point of 700.
  for (int trial = 0; trial < 1000; ++trial) {
    const Mesh mesh = distorted_cell(random, GetParam(), GetParam() == CellShape::triangle ? 0.2 : 0.35);
    for (int k = 0; k < 20; ++k) {
      Local local = random_local(random, mesh.shape);
      if (k % 4 == 0) local[0] = mesh.shape == CellShape::triangle ? 0 : -1;
      const auto place = locate(mesh, image(mesh, 0, local).point, Part::wall);
      ASSERT_TRUE(place);
      // The determinant is above 1e-3: rounding of 1e-15 grows to 1e-12 at most.
      for (int c = 0; c < 2; ++c) EXPECT_NEAR(place->local[c], local[c], 1e-11);
    }
  }
}

TEST(LocateParts, FollowsASideBeyondItsNodes) {
  Mesh mesh;
  // r = 1 + 0.95 s - 0.7 s^2 on the right side: 1.32 at s = 0.68, beyond all nodes.
  mesh.points = {{0, 0}, {1, 0}, {1.25, 1}, {0, 1}, {0.5, 0}, {1.3, 0.5}, {0.6, 1}, {0, 0.5}, {0.6, 0.5}};
  mesh.cells = {{{0, 1, 2, 3, 4, 5, 6, 7, 8}, Part::blood, 0}};
  const double s = 0.68, r = 1 + 0.95 * s - 0.7 * s * s;
  EXPECT_TRUE(locate(mesh, {r - 1e-6, s}, Part::blood));
  EXPECT_FALSE(locate(mesh, {r + 1e-6, s}, Part::blood));
}

TEST_P(Locate, FindsNodesOfBothPartsInTheCellOfLowestIndex) {
  const Mesh mesh = wavy_tube(GetParam());
  std::vector<std::array<int, 2>> first(mesh.points.size(), {-1, -1});
  for (int k = 0; k < static_cast<int>(mesh.cells.size()); ++k)
    for (int n = 0; n < mesh.nodes_per_cell(); ++n) {
      int& known = first[mesh.cells[k].nodes[n]][mesh.cells[k].part == Part::wall ? 1 : 0];
      if (known < 0) known = k;
    }
  for (std::size_t node = 0; node < mesh.points.size(); ++node)
    for (const Part part : {Part::blood, Part::wall}) {
      const int cell = first[node][part == Part::wall ? 1 : 0];
      const auto place = locate(mesh, mesh.points[node], part);
      ASSERT_EQ(place.has_value(), cell >= 0) << "node " << node;
      if (!place) continue;
      EXPECT_EQ(place->cell, cell);
      const Local point = image(mesh, place->cell, place->local).point;
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(point[i], mesh.points[node][i], 1e-14);
    }
}

TEST_P(Locate, IsInTheClosedReferenceCellUpToRounding) {
  const Mesh mesh = wavy_tube(GetParam());
  for (const Edge& edge : mesh.edges) {
    const auto rule = element::side_rule(mesh.shape, edge.side, 3);
    for (const Local& local : rule.points) {
      const auto place = locate(mesh, image(mesh, edge.cell, local).point, mesh.cells[edge.cell].part);
      ASSERT_TRUE(place);
      const Local& x = place->local;
      if (mesh.shape == CellShape::quadrilateral)
        EXPECT_TRUE(std::abs(x[0]) <= 1 && std::abs(x[1]) <= 1) << x[0] << ", " << x[1];
      else
        EXPECT_TRUE(x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1) << x[0] << ", " << x[1];
    }
  }
}

TEST_P(Locate, FindsNothingOutside) {
  const Mesh mesh = wavy_tube(GetParam());
  const double throat = 0.7;  // radius of the interface at z = 2
  for (const Local& point : {Local{-1e-6, 1}, Local{0.3, -1e-6}, Local{throat + 1e-6, 2}, Local{0.5, 5},
                             Local{1e300, 0}, Local{0.5, std::nan("")}, Local{INFINITY, -INFINITY}})
    EXPECT_FALSE(locate(mesh, point, Part::blood)) << point[0] << ", " << point[1];
  EXPECT_TRUE(locate(mesh, {throat - 1e-6, 2}, Part::blood));
  EXPECT_TRUE(locate(mesh, {throat + 1e-6, 2}, Part::wall));
  EXPECT_FALSE(locate(mesh, {throat - 1e-6, 2}, Part::wall));
  EXPECT_FALSE(locate(mesh, {1.4 * throat + 1e-6, 2}, Part::wall));
}

TEST_P(Locate, CutsSectionsAtRadiiOfTheMap) {
  const Mesh mesh = wavy_tube(GetParam());
  // On the cell line at mid-length (z is not moved there) nodes are exact.
  const Section section = section_at(mesh, 2);
  EXPECT_NEAR(section.inner, 0.7, 1e-14);
  EXPECT_NEAR(section.outer, 0.7 * 1.4, 1e-14);
  ASSERT_EQ(section.blood.size(), 4U);
  EXPECT_EQ(section.blood.front(), 0);
  EXPECT_EQ(section.blood.back(), section.inner);
  ASSERT_EQ(section.wall.size(), 4U);
  EXPECT_NEAR(section.wall[1], 0.7 * 1.1, 1e-14);
  EXPECT_EQ(section.wall.front(), section.inner);
  EXPECT_EQ(section.wall.back(), section.outer);
  EXPECT_THROW(section_at(mesh, 4.1), InvalidInput);
  EXPECT_THROW(section_at(mesh, std::nan("")), InvalidInput);
  EXPECT_NEAR(section_at(mesh, 0).inner, 1, 1e-14);
  EXPECT_NEAR(section_at(mesh, 4).outer, 1.4, 1e-14);
}

TEST_P(Locate, IntegratesOverSections) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  const Mesh mesh = wavy_tube(GetParam());
  for (int trial = 0; trial < 20; ++trial) {
    const double z = random.uniform(0, 4);
    const Section section = section_at(mesh, z);
    double blood = 0, wall = 0;
    for (const SectionPoint& q : section_rule(mesh, section, Part::blood, 2)) {
      const Local point = image(mesh, q.place.cell, q.place.local).point;
      EXPECT_NEAR(point[0], q.radius, 1e-9);
      EXPECT_NEAR(point[1], z, 1e-9);
      blood += 2 * q.weight * q.radius;
    }
    for (const SectionPoint& q : section_rule(mesh, section, Part::wall, 2)) wall += 2 * q.weight * q.radius;
    EXPECT_NEAR(blood, section.inner * section.inner, 1e-12);
    EXPECT_NEAR(wall, section.outer * section.outer - section.inner * section.inner, 1e-12);
  }
}

TEST_P(Locate, MeetsTheCurvedInterfaceToThirdOrder) {
  // Parabolas through three points of a curve miss it by O(h^3).
  double errors[2];
  for (const int level : {0, 1}) {
    const Mesh mesh = wavy_tube(GetParam(), 3, level == 0 ? 16 : 32);
    errors[level] = 0;
    for (double z0 = 0.03; z0 < 4; z0 += 0.07) {
      const double r = 1 - 0.3 * std::pow(std::sin(std::numbers::pi * z0 / 4), 2);
      const double z = z0 + 0.1 * r * r * std::sin(std::numbers::pi * z0 / 2);
      errors[level] = std::max(errors[level], std::abs(section_at(mesh, z).inner - r));
    }
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 3, 0.15) << errors[0] << ", " << errors[1];
}

TEST(LocateParts, SeesAWallAloneAndAPipeAlone) {
  TubeSpec spec;
  spec.radius = 1;
  spec.layers = {0.5};
  spec.length = 2;
  spec.blood_cells = spec.wall_cells = spec.axial_cells = 2;
  spec.blood = false;
  const Section wall = section_at(structured_tube(spec), 0.7);
  EXPECT_TRUE(wall.blood.empty());
  EXPECT_EQ(wall.wall, (std::vector<double>{1, 1.25, 1.5}));
  spec.blood = true;
  spec.wall = false;
  const Section pipe = section_at(structured_tube(spec), 0.7);
  EXPECT_TRUE(pipe.wall.empty());
  EXPECT_EQ(pipe.blood, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(pipe.outer, 1);
}

}  // namespace
