// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "axisym/structured.hpp"
#include "core/error.hpp"
#include "tests/support/mesh_measures.hpp"

namespace {

using namespace tunica;
using namespace tunica::axisym;
using test_support::sides_of;
using test_support::surface;
using test_support::volume;

constexpr double pi = std::numbers::pi;
constexpr double round_off = 1e-13;  // relative: sums of some hundred terms of one sign

TubeSpec paper_tube(CellShape shape) {
  TubeSpec spec;
  spec.radius = 0.033;
  spec.layers = {0.004, 0.006};
  spec.length = 0.66;
  spec.blood_cells = 5;
  spec.wall_cells = 4;
  spec.axial_cells = 12;
  spec.end_grading = bending_layer_grading(0.033, 0.01, 0.66);
  spec.interface_grading = 2;
  spec.wall_grading = 1.5;
  spec.shape = shape;
  return spec;
}

/// Heights, or radii, at which there are corners of cells.
std::vector<double> cell_lines(const Mesh& mesh, int direction) {
  std::set<double> lines;
  for (const Cell& cell : mesh.cells)
    for (int k = 0; k < mesh.corners(); ++k) lines.insert(mesh.points[cell.nodes[k]][direction]);
  return {lines.begin(), lines.end()};
}

class StructuredTube : public testing::TestWithParam<CellShape> {
 protected:
  TubeSpec spec_ = paper_tube(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Cells, StructuredTube,
                         testing::Values(CellShape::quadrilateral, CellShape::triangle),
                         [](const auto& test) {
                           return test.param == CellShape::triangle ? "triangles" : "quadrilaterals";
                         });

TEST_P(StructuredTube, HasTheVolumesAndSurfacesOfACylinder) {
  const Mesh mesh = structured_tube(spec_);
  const double a = 0.033, m = 0.037, b = 0.043, length = 0.66;
  const auto expect = [](double actual, double exact) { EXPECT_NEAR(actual, exact, round_off * exact); };
  expect(volume(mesh, Part::blood), pi * a * a * length);
  expect(volume(mesh, [](const Cell& c) { return c.part == Part::wall && c.layer == 0; }),
         pi * (m * m - a * a) * length);
  expect(volume(mesh, [](const Cell& c) { return c.part == Part::wall && c.layer == 1; }),
         pi * (b * b - m * m) * length);

  // Normals out of the cells: sides are traversed with their cell on the left.
  expect(-surface(mesh, Boundary::inlet, Part::blood).axial, pi * a * a);
  expect(surface(mesh, Boundary::outlet, Part::blood).axial, pi * a * a);
  expect(-surface(mesh, Boundary::wall_inlet, Part::wall).axial, pi * (b * b - a * a));
  expect(surface(mesh, Boundary::wall_outlet, Part::wall).axial, pi * (b * b - a * a));
  expect(surface(mesh, Boundary::interface, Part::blood).radial, 2 * pi * a * length);
  expect(-surface(mesh, Boundary::interface, Part::wall).radial, 2 * pi * a * length);
  expect(surface(mesh, Boundary::outer, Part::wall).radial, 2 * pi * b * length);
  EXPECT_EQ(surface(mesh, Boundary::axis, Part::blood).area, 0);
  for (const Boundary boundary : {Boundary::inlet, Boundary::outlet, Boundary::outer}) {
    const bool end = boundary != Boundary::outer;
    const auto s = surface(mesh, boundary, end ? Part::blood : Part::wall);
    expect(s.area, std::hypot(s.radial, s.axial));  // plane, or straight
  }
}

TEST_P(StructuredTube, KnowsItsEndsAndItsLumen) {
  const Mesh mesh = structured_tube(spec_);
  EXPECT_EQ(extent(mesh).inlet, 0);
  EXPECT_EQ(extent(mesh).outlet, 0.66);
  EXPECT_EQ(inlet_radius(mesh), 0.033);
  EXPECT_EQ(mesh.layers(), 2);
  spec_.blood = false;
  const Mesh wall = structured_tube(spec_);
  EXPECT_EQ(extent(wall).length(), 0.66);
  EXPECT_EQ(inlet_radius(wall), 0.033);
  EXPECT_FALSE(wall.has(Part::blood));
}

TEST_P(StructuredTube, SharesEverySideAndItsMiddle) {
  const Mesh mesh = structured_tube(spec_);
  const auto sides = sides_of(mesh);
  std::set<std::pair<int, int>> boundary;
  int between_parts = 0;
  for (const auto& [corners, use] : sides) {
    EXPECT_EQ(use.middles.size(), 1U);
    ASSERT_LE(use.parts.size(), 2U);
    if (use.parts.size() == 1) boundary.insert(corners);
    if (use.parts.size() == 2) {
      EXPECT_EQ(use.forwards, 1);  // once in either direction
    }
    if (use.parts == std::multiset<Part>{Part::blood, Part::wall}) ++between_parts;
  }
  EXPECT_EQ(between_parts, spec_.axial_cells);

  // Euler's formula for a region without holes: corners - sides + cells = 1.
  std::set<int> corners, nodes;
  for (const Cell& cell : mesh.cells)
    for (int k = 0; k < mesh.nodes_per_cell(); ++k) {
      nodes.insert(cell.nodes[k]);
      if (k < mesh.corners()) corners.insert(cell.nodes[k]);
    }
  EXPECT_EQ(corners.size() + mesh.cells.size(), sides.size() + 1);
  EXPECT_EQ(nodes.size(), mesh.points.size());
  EXPECT_EQ(*nodes.rbegin(), static_cast<int>(mesh.points.size()) - 1);

  const auto across = neighbours(mesh);
  int listed_interface = 0;
  for (const Edge& edge : mesh.edges) {
    const auto [first, second, middle] = mesh.side_nodes(edge.cell, edge.side);
    const int other = across[edge.cell * mesh.sides() + edge.side];
    if (edge.boundary == Boundary::interface) {
      ++listed_interface;
      ASSERT_GE(other, 0);
      EXPECT_NE(mesh.cells[other].part, mesh.cells[edge.cell].part);
      for (const int node : {first, second, middle}) EXPECT_EQ(mesh.points[node][0], 0.033);
    } else {
      EXPECT_EQ(other, -1);
      EXPECT_EQ(boundary.erase(std::minmax(first, second)), 1U);
    }
    if (edge.boundary == Boundary::axis) {
      for (const int node : {first, second, middle}) EXPECT_EQ(mesh.points[node][0], 0);
    }
  }
  EXPECT_EQ(listed_interface, 2 * between_parts);
  EXPECT_TRUE(boundary.empty()) << "sides on the boundary that mesh.edges leaves out";
}

TEST_P(StructuredTube, CountsItsCells) {
  const Mesh mesh = structured_tube(spec_);
  const int halves = GetParam() == CellShape::triangle ? 2 : 1;
  EXPECT_EQ(static_cast<int>(mesh.cells.size()), halves * 9 * 12);
  spec_.wall = false;
  const Mesh blood = structured_tube(spec_);
  EXPECT_EQ(static_cast<int>(blood.cells.size()), halves * 5 * 12);
  const auto s = surface(blood, Boundary::interface, Part::blood);
  EXPECT_NEAR(s.radial, 2 * pi * 0.033 * 0.66, round_off);
  EXPECT_EQ(surface(blood, Boundary::outer, Part::blood).area, 0);
}

TEST_P(StructuredTube, IsItsOwnMirrorImageAboutMidLength) {
  const Mesh mesh = structured_tube(spec_);
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * spec_.length;
  // Cells as sets of corners, with coordinates in units of the rounding, which is far below any cell.
  const auto rounded = [&](double x) { return std::llround(x / (64 * rounding)); };
  std::set<std::set<std::pair<long long, long long>>> cells, mirrored;
  for (const Cell& cell : mesh.cells) {
    std::set<std::pair<long long, long long>> here, there;
    for (int k = 0; k < mesh.corners(); ++k) {
      const auto& [r, z] = mesh.points[cell.nodes[k]];
      here.emplace(rounded(r), rounded(z - 0.33));
      there.emplace(rounded(r), rounded(0.33 - z));
    }
    cells.insert(here);
    mirrored.insert(there);
  }
  EXPECT_EQ(cells, mirrored);
  EXPECT_EQ(cell_lines(mesh, 1)[6], 0.33);  // mid-length is a cell line
}

TEST_P(StructuredTube, PutsCellLinesOnLayers) {
  spec_.layers = {0.001, 0.007, 0.002};
  spec_.blood_cells = 1;
  spec_.wall_grading = 1;
  spec_.wall_cells = 8;
  // Thinnest widest cell: 1, 5 and 2 cells of 0.001, 0.0014 and 0.001 cm.
  const std::vector<double> expected = {0, 0.033, 0.034, 0.0354, 0.0368, 0.0382, 0.0396, 0.041, 0.042, 0.043};
  const auto lines = cell_lines(structured_tube(spec_), 0);
  ASSERT_EQ(lines.size(), expected.size());
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_NEAR(lines[i], expected[i], 1e-15);
  spec_.wall_cells = 1;  // as many cells as layers at the least
  EXPECT_EQ(cell_lines(structured_tube(spec_), 0).size(), 5U);
  spec_.wall_grading = 20;
  spec_.wall_cells = 7;
  const auto graded = cell_lines(structured_tube(spec_), 0);
  for (const double boundary : {0.033, 0.034, 0.041, 0.043})
    EXPECT_TRUE(std::any_of(graded.begin(), graded.end(), [=](double line) {
      return std::abs(line - boundary) < 1e-15;
    })) << boundary;
}

TEST(GradedTube, GivesHalfOfTheCellsToTheBendingLayers) {
  TubeSpec spec = paper_tube(CellShape::quadrilateral);
  spec.axial_cells = 400;
  const auto lines = cell_lines(structured_tube(spec), 1);
  EXPECT_NEAR(lines[100], 3 * std::sqrt(0.033 * 0.01), 1e-14);
  // cosh^2 d compares the map's slopes, which many cells come near to: to 1/400 of it at the ends.
  const double at_ends = lines[1] - lines[0], at_middle = lines[200] - lines[199];
  EXPECT_NEAR(at_middle / at_ends / spec.end_grading, 1, 0.02);
  EXPECT_EQ(bending_layer_grading(0.033, 0.01, 0.2), 1);  // too short for layers of their own
  // Continuous there: the layer's share is 1/4 at L = 12 sqrt(R h).
  EXPECT_NEAR(bending_layer_grading(0.033, 0.01, 12.001 * std::sqrt(0.033 * 0.01)), 1, 1e-3);
}

TEST(GradedTube, IsUniformWithoutGradings) {
  TubeSpec spec = paper_tube(CellShape::quadrilateral);
  spec.end_grading = spec.interface_grading = spec.wall_grading = 1;
  spec.layers = {0.01};
  const Mesh mesh = structured_tube(spec);
  const auto heights = cell_lines(mesh, 1), radii = cell_lines(mesh, 0);
  ASSERT_EQ(heights.size(), 13U);
  ASSERT_EQ(radii.size(), 10U);
  for (int j = 0; j < 13; ++j) EXPECT_NEAR(heights[j], 0.055 * j, 1e-15);
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(radii[i], i < 5 ? 0.0066 * i : 0.033 + 0.0025 * (i - 5), 1e-16);
}

TEST(GradedTube, ShrinksCellsInGeometricProgressionTowardsTheInterface) {
  TubeSpec spec = paper_tube(CellShape::quadrilateral);
  spec.interface_grading = 3;
  spec.wall_grading = 2;
  spec.layers = {0.01};
  const auto radii = cell_lines(structured_tube(spec), 0);
  ASSERT_EQ(radii.size(), 10U);
  for (int i = 1; i < 5; ++i)  // five cells, ratio of slopes 1/3 over all of them
    EXPECT_NEAR((radii[i + 1] - radii[i]) / (radii[i] - radii[i - 1]), std::pow(1.0 / 3, 0.2), 1e-12);
  for (int i = 6; i < 9; ++i)
    EXPECT_NEAR((radii[i + 1] - radii[i]) / (radii[i] - radii[i - 1]), std::pow(2.0, 0.25), 1e-12);
}

TEST(GradedTube, IsRefinedByHalvingInTheSameMap) {
  TubeSpec spec = paper_tube(CellShape::quadrilateral);
  spec.layers = {0.01};
  const Mesh coarse = structured_tube(spec);
  spec.blood_cells *= 2;
  spec.wall_cells *= 2;
  spec.axial_cells *= 2;
  const Mesh fine = structured_tube(spec);
  for (const int direction : {0, 1}) {
    const auto few = cell_lines(coarse, direction), many = cell_lines(fine, direction);
    ASSERT_EQ(many.size(), 2 * few.size() - 1);
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_NEAR(few[i], many[2 * i], 1e-15);
  }
}

TEST(TriangularTube, LeavesNoTriangleWithBothSidesWhereVelocityIsGiven) {
  for (const int blood_cells : {1, 4, 5}) {
    TubeSpec spec = paper_tube(CellShape::triangle);
    spec.blood_cells = blood_cells;
    const Mesh mesh = structured_tube(spec);
    std::vector<int> given(mesh.cells.size(), 0);
    for (const Edge& edge : mesh.edges)
      if (edge.boundary != Boundary::axis) ++given[edge.cell];
    for (std::size_t k = 0; k < mesh.cells.size(); ++k)
      if (mesh.cells[k].part == Part::blood) {
        EXPECT_LE(given[k], 1) << "of cell " << k;
      }
  }
}

TEST(TubeSpecification, IsRefusedByName) {
  struct Bad {
    std::function<void(TubeSpec&)> spoil;
    std::vector<std::string> words;
  };
  const double nan = std::nan("");
  const std::vector<Bad> bad = {
      {[](TubeSpec& s) { s.radius = 0; }, {"geometry.radius = 0 cm", "positive"}},
      {[=](TubeSpec& s) { s.length = nan; }, {"geometry.length = nan", "positive"}},
      {[](TubeSpec& s) {
         s.layers = {0.01, -0.002};
       },
       {"geometry.thickness = -0.002", "positive"}},
      {[](TubeSpec& s) { s.layers.clear(); }, {"no layer", "thickness"}},
      {[](TubeSpec& s) { s.axial_cells = 7; }, {"mesh.axial_cells = 7 is odd", "take 8", "mid-length"}},
      {[](TubeSpec& s) { s.axial_cells = 0; }, {"mesh.axial_cells = 0", "at least 1"}},
      {[](TubeSpec& s) { s.blood_cells = -3; }, {"mesh.blood_cells = -3", "at least 1"}},
      {[](TubeSpec& s) { s.wall_cells = 0; }, {"mesh.wall_cells = 0", "at least 1"}},
      {[](TubeSpec& s) { s.end_grading = 0.5; }, {"end grading = 0.5", "1 (uniform) to 1e+06"}},
      {[](TubeSpec& s) { s.wall_grading = 1e7; }, {"wall grading = 1e+07", "to 1e+06"}},
      {[=](TubeSpec& s) { s.interface_grading = nan; }, {"interface grading = nan"}},
      {[](TubeSpec& s) { s.blood = s.wall = false; }, {"without blood and without wall"}},
      {[](TubeSpec& s) { s.axial_cells = 2'000'000'000; }, {"nodes", "at most 1e+07", "mesh.axial_cells"}},
      {[](TubeSpec& s) {
         s.layers = {0.01, 1e-19};
       },
       {"no width", "fewer cells"}},
  };
  for (const Bad& each : bad) {
    TubeSpec spec = paper_tube(CellShape::quadrilateral);
    each.spoil(spec);
    try {
      structured_tube(spec);
      ADD_FAILURE() << "not refused: " << each.words.front();
    } catch (const InvalidInput& error) {
      for (const std::string& word : each.words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what() << '\n' << word;
    }
  }
}

}  // namespace
