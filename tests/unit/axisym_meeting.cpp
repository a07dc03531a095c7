// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/meeting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/axisym_state.hpp"
#include "tests/support/random_deformation.hpp"

namespace {

using namespace tunica;
using namespace tunica::axisym;
using element::Local;

class Meeting : public testing::TestWithParam<CellShape> {
 protected:
  Mesh mesh = [] {
    TubeSpec spec = test_support::small_tube(GetParam());
    spec.layers = {0.04, 0.08};
    Mesh tube = structured_tube(spec);
    test_support::make_wavy(tube, spec.length);
    return tube;
  }();

  /// Cells of the part of `cell` that have all of the nodes.
  std::set<int> cells_with(int cell, const std::vector<int>& nodes) const {
    std::set<int> found;
    for (int k = 0; k < static_cast<int>(mesh.cells.size()); ++k) {
      const auto& of = mesh.cells[k].nodes;
      const auto has = [&](int node) { return std::find(of.begin(), of.end(), node) != of.end(); };
      if (mesh.cells[k].part == mesh.cells[cell].part && std::all_of(nodes.begin(), nodes.end(), has))
        found.insert(k);
    }
    return found;
  }

  void expect_meeting(int cell, const Local& local, const std::set<int>& cells) const {
    const auto places = meeting_places(mesh, {cell, local});
    const Local expected = image(mesh, cell, local).point;
    std::set<int> found;
    for (const Place& place : places) {
      EXPECT_TRUE(found.insert(place.cell).second) << "cell " << place.cell << " twice";
      const Local point = image(mesh, place.cell, place.local).point;
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(point[i], expected[i], 1e-14);
    }
    EXPECT_EQ(found, cells) << "cell " << cell << ", local " << local[0] << ", " << local[1];
  }
};

INSTANTIATE_TEST_SUITE_P(Cells, Meeting, testing::Values(CellShape::quadrilateral, CellShape::triangle),
                         [](const auto& test) {
                           return test.param == CellShape::triangle ? "triangles" : "quadrilaterals";
                         });

TEST_P(Meeting, AtCornersOnSidesAndInside) {
  test_support::RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    for (int side = 0; side < mesh.sides(); ++side) {
      const auto nodes = mesh.side_nodes(cell, side);
      const Local a = element::node_position(mesh.shape, side);
      const Local b = element::node_position(mesh.shape, (side + 1) % mesh.corners());
      expect_meeting(cell, a, cells_with(cell, {nodes[0]}));
      const double s = random.uniform(0.01, 0.99);
      const Local on{a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])};
      EXPECT_TRUE(on_side(mesh.shape, side, on));
      expect_meeting(cell, on, cells_with(cell, {nodes[0], nodes[1]}));
      const Local centre = element::node_position(mesh.shape, mesh.centre_node());
      const Local in{on[0] + 1e-3 * (centre[0] - on[0]), on[1] + 1e-3 * (centre[1] - on[1])};
      EXPECT_FALSE(on_side(mesh.shape, side, in));
      expect_meeting(cell, in, {cell});
    }
}

TEST_P(Meeting, KeepsTheInnermostLayer) {
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (mesh.cells[cell].part != Part::wall) continue;
    for (int corner = 0; corner < mesh.corners(); ++corner) {
      const auto all = meeting_places(mesh, {cell, element::node_position(mesh.shape, corner)});
      int innermost = 1;
      for (const Place& place : all) innermost = std::min(innermost, mesh.cells[place.cell].layer);
      const auto kept = in_innermost_layer(mesh, all);
      EXPECT_FALSE(kept.empty());
      for (const Place& place : kept) EXPECT_EQ(mesh.cells[place.cell].layer, innermost);
    }
  }
}

}  // namespace
