// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/locate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "full3d/o_grid.hpp"
#include "tests/support/solid_measures.hpp"

namespace {

using namespace tunica;
using namespace tunica::full3d;
using element::solid::Local;

struct Case {
  Shape shape;
  bool quadratic;
};

class Places : public testing::TestWithParam<Case> {
 protected:
  static VesselSpec bent(Case each) {
    VesselSpec spec;
    spec.radius = 1;
    spec.layers = {0.1, 0.2};
    spec.length = 7;
    spec.bend_angle = 3;
    spec.around_cells = 8;
    spec.ring_cells = 2;
    spec.wall_cells = 3;
    spec.axial_cells = 10;
    spec.end_grading = 2;
    spec.interface_grading = 3;
    spec.shape = each.shape;
    spec.quadratic = each.quadratic;
    return spec;
  }
  Local random_local() {
    std::uniform_real_distribution<double> unit(0.001, 0.999);
    Local x{unit(random_), unit(random_), unit(random_)};
    if (mesh_.shape == Shape::hexahedron) return {2 * x[0] - 1, 2 * x[1] - 1, 2 * x[2] - 1};
    while (x[0] + x[1] + x[2] > 0.999) x = {unit(random_), unit(random_), unit(random_)};
    return x;
  }
  void expect_at(const Place& place, const Point& point) const {
    const Point at = image(mesh_, place.cell, place.local).point;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(at[i], point[i], 1e-9);  // the promise, of cells of size 1
  }

  const Mesh mesh_ = o_grid_vessel(bent(GetParam()));
  const Locator locator_{mesh_};
  std::mt19937 random_{7};
};

INSTANTIATE_TEST_SUITE_P(full3d, Places,
                         testing::Values(Case{Shape::hexahedron, true}, Case{Shape::tetrahedron, true},
                                         Case{Shape::hexahedron, false}, Case{Shape::tetrahedron, false}),
                         [](const auto& test) {
                           return std::string(test.param.quadratic ? "curved" : "linear") +
                                  (test.param.shape == Shape::hexahedron ? "_hexahedra" : "_tetrahedra");
                         });

TEST_P(Places, AreFoundAgainInTheirCells) {
  for (int cell = 0; cell < static_cast<int>(mesh_.cells.size()); ++cell) {
    const Local local = random_local();
    const auto place = locator_.find(image(mesh_, cell, local).point, mesh_.cells[cell].part);
    ASSERT_TRUE(place) << "cell " << cell;
    EXPECT_EQ(place->cell, cell);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(place->local[i], local[i], 1e-11);  // rounding by aspect ratio
  }
}

TEST_P(Places, OfNodesAreInTheLowestCellThatHasThem) {
  for (const Part part : {Part::blood, Part::wall}) {
    std::vector<int> lowest(mesh_.points.size(), -1);
    const auto basis = element::solid::Basis::linear;
    const int corners = element::solid::shape_count(mesh_.shape, basis);
    for (int cell = static_cast<int>(mesh_.cells.size()) - 1; cell >= 0; --cell)
      if (mesh_.cells[cell].part == part)
        for (int k = 0; k < corners; ++k) lowest[mesh_.node(cell, basis, k)] = cell;
    for (std::size_t node = 0; node < lowest.size(); ++node) {
      if (lowest[node] < 0) continue;
      const auto place = locator_.find(mesh_.points[node], part);
      ASSERT_TRUE(place) << "node " << node;
      EXPECT_EQ(place->cell, lowest[node]);
      expect_at(*place, mesh_.points[node]);
      // All cells around the node meet there, and no other.
      std::vector<int> around;
      for (int cell = 0; cell < static_cast<int>(mesh_.cells.size()); ++cell)
        for (int k = 0; k < corners && mesh_.cells[cell].part == part; ++k)
          if (mesh_.node(cell, basis, k) == static_cast<int>(node)) around.push_back(cell);
      std::vector<int> met;
      for (const Place& each : locator_.meeting(*place)) {
        met.push_back(each.cell);
        expect_at(each, mesh_.points[node]);
      }
      EXPECT_EQ(met, around);
    }
  }
}

TEST_P(Places, OnFacesMeetTheNeighbour) {
  const int faces = element::solid::faces(mesh_.shape);
  for (const auto& [nodes, cells] : test_support::faces_of(mesh_)) {
    std::vector<int> expected;
    const Part part = mesh_.cells[cells[0].cell].part;
    for (const auto& each : cells)
      if (mesh_.cells[each.cell].part == part) expected.push_back(each.cell);
    std::sort(expected.begin(), expected.end());
    Local local = random_local();
    const int face = cells[0].face;
    if (faces == 6) {
      local[face / 2] = face % 2 == 0 ? -1 : 1;
    } else if (face > 0) {
      local[face - 1] = 0;
    } else {
      const double sum = local[0] + local[1] + local[2];
      for (double& coordinate : local) coordinate /= sum;
    }
    const Point point = image(mesh_, cells[0].cell, local).point;
    std::vector<int> met;
    for (const Place& each : locator_.meeting({cells[0].cell, local})) {
      met.push_back(each.cell);
      expect_at(each, point);
    }
    EXPECT_EQ(met, expected);
  }
}

TEST_P(Places, OnEdgesMeetAllCellsAround) {
  // They are those that share its two ends.
  const auto basis = element::solid::Basis::linear;
  const int corners = element::solid::shape_count(mesh_.shape, basis);
  for (int cell = 0; cell < static_cast<int>(mesh_.cells.size()); cell += 7) {
    const Local a = element::solid::node_position(mesh_.shape, basis, 0),
                b = element::solid::node_position(mesh_.shape, basis, 1);
    const Local local{0.3 * a[0] + 0.7 * b[0], 0.3 * a[1] + 0.7 * b[1], 0.3 * a[2] + 0.7 * b[2]};
    const std::set<int> ends{mesh_.node(cell, basis, 0), mesh_.node(cell, basis, 1)};
    std::vector<int> around, met;
    for (int other = 0; other < static_cast<int>(mesh_.cells.size()); ++other) {
      int shared = 0;
      for (int k = 0; k < corners; ++k) shared += static_cast<int>(ends.count(mesh_.node(other, basis, k)));
      if (shared == 2 && mesh_.cells[other].part == mesh_.cells[cell].part) around.push_back(other);
    }
    const Point point = image(mesh_, cell, local).point;
    for (const Place& each : locator_.meeting({cell, local})) {
      met.push_back(each.cell);
      expect_at(each, point);
    }
    EXPECT_EQ(met, around);
  }
}

TEST_P(Places, OutsideAreNone) {
  const double bend = 7.0 / 3;
  const auto at = [&](double r, double angle, double s) {
    const double x = r * std::cos(angle), phi = s / bend;
    return Point{-bend + (bend + x) * std::cos(phi), r * std::sin(angle), (bend + x) * std::sin(phi)};
  };
  EXPECT_FALSE(locator_.find(at(1.35, 1, 3), Part::wall));
  EXPECT_FALSE(locator_.find(at(0.5, 1, 3), Part::wall));
  EXPECT_FALSE(locator_.find(at(1.15, 1, 3), Part::blood));
  EXPECT_FALSE(locator_.find(at(0.5, 1, 7.001), Part::blood));
  EXPECT_FALSE(locator_.find(at(0.5, 1, -0.001), Part::blood));
  EXPECT_FALSE(locator_.find({-bend, 0, 0.2}, Part::blood));  // the bend's centre
  EXPECT_FALSE(locator_.find({NAN, 0, 0}, Part::blood));
  EXPECT_FALSE(locator_.find({1e300, 0, 0}, Part::blood));
  EXPECT_TRUE(locator_.find(at(0.5, 1, 3), Part::blood));
  EXPECT_TRUE(locator_.find(at(1.15, 1, 3), Part::wall));
  // As far beside the inlet as counts as inside, and further.
  EXPECT_TRUE(locator_.find({0.2, 0.1, -1e-10}, Part::blood));
  EXPECT_FALSE(locator_.find({0.2, 0.1, -1e-8}, Part::blood));
}

}  // namespace
