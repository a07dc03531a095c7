// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "full3d/mesh_check.hpp"
#include "full3d/o_grid.hpp"
#include "tests/support/solid_measures.hpp"

namespace {

using namespace tunica;
using namespace tunica::full3d;
using test_support::faces_of;
using test_support::integral;
using test_support::nodes_on;
using test_support::surface;
using test_support::volume;

constexpr double pi = std::numbers::pi;

VesselSpec paper_vessel(Shape shape, double bend_angle) {
  VesselSpec spec;
  spec.radius = 0.033;
  spec.layers = {0.004, 0.006};
  spec.length = 0.3;
  spec.bend_angle = bend_angle;
  spec.around_cells = 16;
  spec.ring_cells = 2;
  spec.wall_cells = 3;
  spec.axial_cells = 6;
  spec.end_grading = 3;
  spec.interface_grading = 2;
  spec.wall_grading = 1.5;
  spec.sector = Sector::half;
  spec.shape = shape;
  return spec;
}

struct Case {
  Shape shape;
  double bend_angle;
  bool quadratic;
};

class Vessel : public testing::TestWithParam<Case> {
 protected:
  VesselSpec spec() const {
    VesselSpec spec = paper_vessel(GetParam().shape, GetParam().bend_angle);
    spec.quadratic = GetParam().quadratic;
    return spec;
  }
};

INSTANTIATE_TEST_SUITE_P(full3d, Vessel,
                         testing::Values(Case{Shape::hexahedron, 0, true}, Case{Shape::hexahedron, 2, true},
                                         Case{Shape::tetrahedron, 0, true}, Case{Shape::tetrahedron, 2, true},
                                         Case{Shape::hexahedron, 2, false},
                                         Case{Shape::tetrahedron, 2, false}),
                         [](const auto& test) {
                           return std::string(test.param.bend_angle > 0 ? "bent" : "straight") +
                                  (test.param.quadratic ? "_curved" : "_linear") +
                                  (test.param.shape == Shape::hexahedron ? "_hexahedra" : "_tetrahedra");
                         });

// The sections' circles and the torus's generators have derivatives of order 3 along themselves, so that
// quadratic interpolation departs from the surface only in order 4; areas and volumes likewise. Of tetrahedra
// the mixed derivatives remain, which are odd and cancel between neighbours. Linear cells: order 2.
TEST_P(Vessel, HasVolumesAndAreasThatConverge) {
  const auto measures = [](const Mesh& mesh) {
    const auto layer = [&](int k) {
      return integral(mesh, [k](const Cell& c) { return c.part == Part::wall && c.layer == k; });
    };
    return std::vector<double>{volume(mesh, Part::blood),
                               layer(0),
                               layer(1),
                               surface(mesh, Boundary::interface, Part::blood).area,
                               surface(mesh, Boundary::interface, Part::wall).area,
                               surface(mesh, Boundary::outer, Part::wall).area,
                               surface(mesh, Boundary::inlet, Part::blood).area,
                               surface(mesh, Boundary::outlet, Part::blood).area,
                               surface(mesh, Boundary::wall_inlet, Part::wall).area,
                               surface(mesh, Boundary::symmetry_y, Part::blood).area};
  };
  const double a = 0.033, m = 0.037, b = 0.043, length = 0.3;
  // Pappus: centroids of symmetric sections and of circles travel along the centreline.
  const std::vector<double> exact{pi * a * a * length / 2,
                                  pi * (m * m - a * a) * length / 2,
                                  pi * (b * b - m * m) * length / 2,
                                  pi * a * length,
                                  pi * a * length,
                                  pi * b * length,
                                  pi * a * a / 2,
                                  pi * a * a / 2,
                                  pi * (b * b - a * a) / 2,
                                  2 * a * length};
  const VesselSpec coarse = spec();
  VesselSpec fine = coarse;
  for (int* cells : {&fine.around_cells, &fine.ring_cells, &fine.wall_cells, &fine.axial_cells}) *cells *= 2;
  const auto errors = [&](const VesselSpec& each) {
    auto values = measures(o_grid_vessel(each));
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = std::abs(values[k] / exact[k] - 1);
    return values;
  };
  const auto few = errors(coarse), many = errors(fine);
  const double order = coarse.quadratic ? 4 : 2;
  for (std::size_t k = 0; k < few.size(); ++k) {
    if (few[k] < 1e-12) continue;  // plane: exact but for rounding
    EXPECT_GT(std::log2(few[k] / many[k]), order - 0.3) << k << ": " << few[k] << " to " << many[k];
    EXPECT_LT(many[k], coarse.quadratic ? 1e-4 : 2e-2) << k;
  }
}

TEST_P(Vessel, IsClosed) {
  const Mesh mesh = o_grid_vessel(spec());
  std::map<std::vector<int>, std::vector<Boundary>> marked;
  for (const Face& face : mesh.faces) marked[nodes_on(mesh, face.cell, face.face)].push_back(face.boundary);
  test_support::Surface whole;
  int interfaces = 0;
  for (const auto& [nodes, cells] : faces_of(mesh)) {
    ASSERT_LE(cells.size(), 2U);
    const auto mark = marked.find(nodes);
    const auto first = surface(mesh, cells[0].cell, cells[0].face);
    if (cells.size() == 1) {
      ASSERT_NE(mark, marked.end());
      EXPECT_EQ(mark->second.size(), 1U);
      whole.add(first);
      continue;
    }
    const auto second = surface(mesh, cells[1].cell, cells[1].face);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(first.normal[i], -second.normal[i], 1e-12 * first.area);
    const bool parts_meet = mesh.cells[cells[0].cell].part != mesh.cells[cells[1].cell].part;
    ASSERT_EQ(mark != marked.end(), parts_meet);
    if (!parts_meet) continue;
    EXPECT_EQ(mark->second, (std::vector<Boundary>{Boundary::interface, Boundary::interface}));
    ++interfaces;
  }
  EXPECT_EQ(interfaces, 8 * 6 * (mesh.shape == Shape::hexahedron ? 1 : 2));
  for (const double component : whole.normal) EXPECT_NEAR(component, 0, 1e-13 * whole.area);
  // No unused nodes: those of the map, and centres of tetrahedra.
  std::set<int> used;
  for (const Cell& cell : mesh.cells)
    for (const int node : cell.nodes)
      if (node >= 0) used.insert(node);
  EXPECT_EQ(used.size(), mesh.points.size());
}

TEST_P(Vessel, MarksItsBoundariesWhereTheyAre) {
  const VesselSpec spec = this->spec();
  const Mesh mesh = o_grid_vessel(spec);
  std::map<Boundary, int> counts;
  const double bend = spec.bend_angle > 0 ? spec.length / spec.bend_angle : 0;
  for (const Face& face : mesh.faces) {
    ++counts[face.boundary];
    for (const int node : nodes_on(mesh, face.cell, face.face)) {
      const Point& at = mesh.points[node];
      const double angle = bend > 0 ? std::atan2(at[2], at[0] + bend) : 0;
      const double s = bend > 0 ? bend * angle : at[2];
      const double x = bend > 0 ? std::hypot(at[0] + bend, at[2]) - bend : at[0], r = std::hypot(x, at[1]);
      const double rounding = 1e-15;  // cm: some units in the last place of the bend's radius
      switch (face.boundary) {
        case Boundary::inlet:
        case Boundary::wall_inlet:
          EXPECT_EQ(at[2], 0);
          break;
        case Boundary::outlet:
        case Boundary::wall_outlet:
          EXPECT_NEAR(s, 0.3, rounding);
          break;
        case Boundary::interface:
          EXPECT_NEAR(r, 0.033, rounding);
          break;
        case Boundary::outer:
          EXPECT_NEAR(r, 0.043, rounding);
          break;
        case Boundary::axis:
        case Boundary::symmetry_x:
          ADD_FAILURE();
          break;
        case Boundary::symmetry_y:
          EXPECT_EQ(at[1], 0);
          break;
      }
    }
  }
  const int split = mesh.shape == Shape::hexahedron ? 1 : 2;
  EXPECT_EQ(counts[Boundary::inlet], (8 + 2 * 8) * split);
  EXPECT_EQ(counts[Boundary::wall_outlet], 3 * 8 * split);
  EXPECT_EQ(counts[Boundary::interface], 2 * 8 * 6 * split);
  EXPECT_EQ(counts[Boundary::symmetry_y], (4 + 2 * 2 + 2 * 3) * 6 * split);
  EXPECT_LT(surface(mesh, Boundary::inlet, Part::blood).normal[2], 0);
}

/// Corners of the cells as sets of points, so that meshes compare whatever their numbers are.
using Corners = std::multiset<Point>;
std::multiset<Corners> cells_as_points(const Mesh& mesh, const std::function<bool(const Point&)>& keep,
                                       const std::function<Point(Point)>& map) {
  std::multiset<Corners> all;
  for (const Cell& cell : mesh.cells) {
    Corners nodes;
    bool is_kept = true;
    const int count = mesh.shape == Shape::tetrahedron ? 10 : 27;  // its centre has sums that round
    for (int k = 0; k < count; ++k) {
      if (cell.nodes[k] < 0) continue;
      const Point& at = mesh.points[cell.nodes[k]];
      is_kept = is_kept && keep(at);
      const Point mapped = map(at);
      nodes.insert({mapped[0] + 0.0, mapped[1] + 0.0, mapped[2] + 0.0});  // 0 for -0
    }
    if (is_kept) all.insert(nodes);
  }
  return all;
}

TEST_P(Vessel, IsItsOwnMirrorImage) {
  VesselSpec spec = this->spec();
  const auto all = [](const Point&) { return true; };
  const auto same = [](Point p) { return p; };
  const auto half = cells_as_points(o_grid_vessel(spec), all, same);
  spec.sector = Sector::full;
  const Mesh mesh = o_grid_vessel(spec);
  const auto full = cells_as_points(mesh, all, same);
  EXPECT_TRUE(full == cells_as_points(mesh, all, [](Point p) { return Point{p[0], -p[1], p[2]}; }));
  EXPECT_TRUE(half == cells_as_points(
                          mesh, [](const Point& p) { return p[1] >= 0; }, same));
  EXPECT_EQ(full.size(), 2 * half.size());
  if (spec.bend_angle > 0) return;
  EXPECT_TRUE(full == cells_as_points(mesh, all, [](Point p) { return Point{-p[0], p[1], p[2]}; }));
  EXPECT_TRUE(full == cells_as_points(mesh, all, [](Point p) { return Point{p[1], p[0], p[2]}; }));
  spec.sector = Sector::quarter;
  EXPECT_TRUE(cells_as_points(o_grid_vessel(spec), all, same) ==
              cells_as_points(
                  mesh, [](const Point& p) { return p[0] >= 0 && p[1] >= 0; }, same));
}

TEST_P(Vessel, LeavesAFreeCornerToEachCellOfTheBlood) {
  const Mesh mesh = o_grid_vessel(spec());
  for (const Boundary end : {Boundary::inlet, Boundary::outlet}) {
    std::set<int> given;
    for (const Face& face : mesh.faces)
      if (face.boundary == end || face.boundary == Boundary::interface)
        for (const int node : nodes_on(mesh, face.cell, face.face)) given.insert(node);
    for (int k = 0; k < static_cast<int>(mesh.cells.size()); ++k) {
      if (mesh.cells[k].part != Part::blood) continue;
      bool is_free = false;
      for (int c = 0; c < element::solid::shape_count(mesh.shape, element::solid::Basis::linear); ++c)
        is_free = is_free || !given.contains(mesh.node(k, element::solid::Basis::linear, c));
      EXPECT_TRUE(is_free) << "cell " << k;
    }
  }
}

TEST_P(Vessel, HasEitherPartAlone) {
  VesselSpec spec = this->spec();
  const Mesh both = o_grid_vessel(spec);
  for (const Part part : {Part::blood, Part::wall}) {
    spec.blood = part == Part::blood;
    spec.wall = !spec.blood;
    const Mesh mesh = o_grid_vessel(spec);
    EXPECT_FALSE(mesh.has(spec.blood ? Part::wall : Part::blood));
    EXPECT_EQ(volume(mesh, part), volume(both, part));
    EXPECT_EQ(surface(mesh, Boundary::interface, part).area, surface(both, Boundary::interface, part).area);
    EXPECT_EQ(mesh.layers(), spec.wall ? 2 : 0);
    std::set<int> used;
    for (const Cell& cell : mesh.cells)
      for (const int node : cell.nodes)
        if (node >= 0) used.insert(node);
    EXPECT_EQ(used.size(), mesh.points.size());
  }
}

TEST(full3d, NumbersNodesAlongTheVessel) {
  VesselSpec spec = paper_vessel(Shape::tetrahedron, 0);
  const Mesh mesh = o_grid_vessel(spec);
  const int slices = 2 * spec.axial_cells + 1, per_row = static_cast<int>(mesh.points.size()) / slices;
  for (const Cell& cell : mesh.cells) {
    const auto [low, high] = std::minmax_element(cell.nodes.begin(), cell.nodes.begin() + 11);
    EXPECT_LT(*high - *low, 5 * per_row);
  }
}

TEST(full3d, QualityOfCoresOfAllSizes) {
  for (const int around : {8, 16, 32, 64})
    for (const int rings : {1, 2, 8}) {
      VesselSpec spec = paper_vessel(Shape::hexahedron, 0);
      spec.around_cells = around;
      spec.ring_cells = rings;
      spec.interface_grading = 1;
      const Mesh mesh = o_grid_vessel(spec);
      const DistortionMeter meter(mesh);
      double least = 1;
      for (int k = 0; k < static_cast<int>(mesh.cells.size()); ++k)
        least = std::min(least, meter.of(k).least_scaled);
      EXPECT_GT(least, 0.83) << around << ' ' << rings;  // sin 120 degrees = 0.866 at best
    }
}

TEST(full3d, CellsOfRandomVesselsAreNotInsideOut) {
  const unsigned seed = 20240611;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  const auto whole = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  for (int trial = 0; trial < 60; ++trial) {
    VesselSpec spec;
    spec.radius = std::exp(real(-4, 1));
    for (int k = whole(1, 3); k > 0; --k) spec.layers.push_back(spec.radius * real(0.05, 0.3));
    double outer = spec.radius;
    for (const double layer : spec.layers) outer += layer;
    spec.axial_cells = 2 * whole(2, 5);
    const bool hexahedra = trial % 2 == 0;
    // Mixed derivatives, which tetrahedra do not resolve, bound the turn of a cell of theirs.
    spec.bend_angle = trial % 3 == 0 ? 0 : real(0, (hexahedra ? 0.7 : 0.3) * spec.axial_cells / 2);
    spec.length = outer * (1 + real(0.1, 5)) * std::max(spec.bend_angle, 1.0);
    spec.around_cells = 8 * whole(1, 3);
    spec.ring_cells = whole(1, 4);
    spec.wall_cells = whole(1, 4);
    spec.end_grading = real(1, 2);
    spec.interface_grading = std::exp(real(0, 3));
    spec.wall_grading = std::exp(real(0, 2));
    spec.sector = static_cast<Sector>(whole(0, spec.bend_angle > 0 ? 1 : 2));
    spec.shape = hexahedra ? Shape::hexahedron : Shape::tetrahedron;
    spec.quadratic = trial % 4 < 2 || spec.bend_angle > 0;
    if (spec.bend_angle >= 6) continue;
    EXPECT_NO_THROW(o_grid_vessel(spec)) << "trial " << trial;  // it checks them itself
  }
}

}  // namespace
