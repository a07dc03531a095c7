// SPDX-License-Identifier: GPL-3.0-or-later
#include "axisym/gmsh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "axisym/locate.hpp"
#include "axisym/mesh_check.hpp"
#include "axisym/structured.hpp"
#include "core/coupled/gmsh_parts.hpp"
#include "core/error.hpp"
#include "tests/support/gmsh_model.hpp"
#include "tests/support/mesh_measures.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace tunica;
using namespace tunica::axisym;
using namespace tunica::test_support;

constexpr double pi = std::numbers::pi;

/// Smooth over its whole length, so that orders of convergence are clean.
Stenosis smooth(int type, int refinement = 1) {
  Stenosis shape;
  shape.length = shape.width = 0.2;
  shape.blood_cells = 2 * refinement;
  shape.wall_cells = 2 * refinement;
  shape.axial_cells = 8 * refinement;
  shape.type = type;
  return shape;
}

/// Of the lumen: pi R0^2 (L - s w + 3/8 s^2 w), the means of cos^2 and cos^4 being 1/2 and 3/8.
double lumen_volume(const Stenosis& s) {
  return pi * s.radius * s.radius *
         (s.length - s.severity * s.width + 0.375 * s.severity * s.severity * s.width);
}
double wall_volume(const Stenosis& s) {
  return pi * std::pow(s.radius + s.thickness, 2) * s.length - lumen_volume(s);
}

Mesh read(const Stenosis& shape, const std::string& version = "4.1") {
  return parse_gmsh(stenosis_mesh(shape).text(version), "test");
}

struct Kind {
  int type;
  const char* name;
  double order;  ///< of the volume: a parabola per side, integrated like Simpson's rule, or a chord
};
std::ostream& operator<<(std::ostream& stream, const Kind& kind) {
  return stream << kind.name;
}

class GmshCellsOf : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(Types, GmshCellsOf,
                         testing::Values(Kind{triangle3, "triangle3", 2}, Kind{triangle6, "triangle6", 4},
                                         Kind{quadrilateral4, "quadrilateral4", 2},
                                         Kind{quadrilateral8, "quadrilateral8", 4},
                                         Kind{quadrilateral9, "quadrilateral9", 4}),
                         [](const auto& test) { return test.param.name; });

TEST_P(GmshCellsOf, ConvergeToTheVolumesOfASinusoidalStenosis) {
  for (const Part part : {Part::blood, Part::wall}) {
    double errors[2];
    for (const int level : {0, 1}) {
      const Stenosis shape = smooth(GetParam().type, level == 0 ? 2 : 4);
      const double exact = part == Part::blood ? lumen_volume(shape) : wall_volume(shape);
      errors[level] = std::abs(volume(read(shape), part) / exact - 1);
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), GetParam().order, 0.15) << errors[0] << ' ' << errors[1];
  }
}

TEST_P(GmshCellsOf, HaveAllNodesSharedAndKeepTheGivenOnes) {
  const Stenosis shape = smooth(GetParam().type);
  const GmshModel model = stenosis_mesh(shape);
  const Mesh mesh = parse_gmsh(model.text("4.1"), "test");
  const bool triangles = GetParam().type == triangle3 || GetParam().type == triangle6;
  EXPECT_EQ(mesh.shape, triangles ? CellShape::triangle : CellShape::quadrilateral);
  EXPECT_EQ(mesh.cells.size(), triangles ? 64U : 32U);
  for (const auto& [corners, use] : sides_of(mesh)) {
    EXPECT_EQ(use.middles.size(), 1U);
    EXPECT_LE(use.parts.size(), 2U);
  }
  // A grid of 9 x 17 corners and middles of sides, plus the centres of triangles.
  EXPECT_EQ(mesh.points.size(), 9U * 17U + (triangles ? 64U : 0U));
  for (const GmshModel::Node& node : model.nodes)
    EXPECT_EQ(std::count_if(mesh.points.begin(), mesh.points.end(),
                            [&](const auto& p) { return std::hypot(p[0] - node.x, p[1] - node.y) < 1e-11; }),
              1);
  // The centre lies where the other nodes' map takes it: its parabolas meet there.
  if (GetParam().type != quadrilateral9) {
    const double of_corner = triangles ? -1.0 / 9 : -0.25, of_middle = triangles ? 4.0 / 9 : 0.5;
    for (const Cell& cell : mesh.cells) {
      double sum = 0;
      for (int n = 0; n < mesh.centre_node(); ++n)
        sum += (n < mesh.corners() ? of_corner : of_middle) * mesh.points[cell.nodes[n]][0];
      EXPECT_NEAR(mesh.points[cell.nodes[mesh.centre_node()]][0], sum, 1e-16);
    }
  }
}

TEST_P(GmshCellsOf, HaveTheBoundariesOfTheVessel) {
  const Stenosis shape = smooth(GetParam().type);
  const double a = shape.radius, b = a + shape.thickness, length = shape.length;
  for (const char* version : {"2.2", "4.1"}) {
    const Mesh mesh = read(shape, version);
    const auto expect = [](double actual, double exact) { EXPECT_NEAR(actual, exact, 1e-10 * exact); };
    expect(-surface(mesh, Boundary::inlet, Part::blood).axial, pi * a * a);
    expect(surface(mesh, Boundary::outlet, Part::blood).axial, pi * a * a);
    expect(-surface(mesh, Boundary::wall_inlet, Part::wall).axial, pi * (b * b - a * a));
    expect(surface(mesh, Boundary::wall_outlet, Part::wall).axial, pi * (b * b - a * a));
    expect(surface(mesh, Boundary::outer, Part::wall).radial, 2 * pi * b * length);
    const auto inner = surface(mesh, Boundary::interface, Part::blood);
    const auto outer = surface(mesh, Boundary::interface, Part::wall);
    expect(inner.area, outer.area);
    expect(inner.radial, -outer.radial);
    // int 2 pi R dz with the mean of cos^2 being 1/2; chords and parabolas are that near on 8 cells.
    EXPECT_NEAR(inner.radial, 2 * pi * a * length * (1 - 0.5 * shape.severity), 2e-2 * inner.radial);
    EXPECT_NEAR(extent(mesh).length(), length, 1e-12);
    EXPECT_NEAR(inlet_radius(mesh), a, 1e-12);
    EXPECT_EQ(std::count_if(mesh.edges.begin(), mesh.edges.end(),
                            [](const Edge& e) { return e.boundary == Boundary::axis; }),
              shape.axial_cells);
  }
}

TEST_P(GmshCellsOf, AreTheSameInBothFormats) {
  const Stenosis shape = smooth(GetParam().type);
  const Mesh older = read(shape, "2.2"), newer = read(shape, "4.1");
  // Format 4.1 sorts elements by groups, in which the generator's order is kept: same cells, other places.
  ASSERT_EQ(older.cells.size(), newer.cells.size());
  ASSERT_EQ(older.points.size(), newer.points.size());
  const auto sorted = [](const Mesh& mesh) {
    std::vector<std::vector<double>> cells;
    for (const Cell& cell : mesh.cells) {
      std::vector<double> numbers = {cell.part == Part::wall ? 1.0 : 0.0};
      for (int n = 0; n < mesh.nodes_per_cell(); ++n)
        numbers.insert(numbers.end(), mesh.points[cell.nodes[n]].begin(), mesh.points[cell.nodes[n]].end());
      cells.push_back(numbers);
    }
    std::sort(cells.begin(), cells.end());
    return cells;
  };
  EXPECT_EQ(sorted(older), sorted(newer));
}

TEST_P(GmshCellsOf, AreTurnedRoundWhereClockwise) {
  const Stenosis shape = smooth(GetParam().type);
  GmshModel model = stenosis_mesh(shape);
  const Mesh before = parse_gmsh(model.text("2.2"), "test");
  for (std::size_t k = 0; k < model.elements.size(); k += 3) {
    auto& nodes = model.elements[k].nodes;
    const auto corners = static_cast<std::ptrdiff_t>(before.corners());
    if (model.elements[k].type != GetParam().type) continue;
    std::reverse(nodes.begin(), nodes.begin() + corners);
    // Corner i is the former corner n - 1 - i: sides come in the order n - 2, ..., 0, n - 1.
    if (static_cast<std::ptrdiff_t>(nodes.size()) > corners)
      std::reverse(nodes.begin() + corners, nodes.begin() + 2 * corners - 1);
  }
  const Mesh after = parse_gmsh(model.text("2.2"), "test");
  check_cells(after, "turned");
  for (const Part part : {Part::blood, Part::wall})
    EXPECT_NEAR(volume(after, part) / volume(before, part), 1, 1e-14);
  EXPECT_EQ(after.edges.size(), before.edges.size());
}

TEST(GmshMesh, MayBeAPipeOrAWallAlone) {
  Stenosis shape = smooth(triangle6);
  shape.wall_cells = 0;
  const Mesh pipe = read(shape);
  EXPECT_FALSE(pipe.has(Part::wall));
  EXPECT_NEAR(volume(pipe, Part::blood) / lumen_volume(shape), 1, 1e-3);
  EXPECT_GT(surface(pipe, Boundary::interface, Part::blood).radial, 0);
  shape = smooth(quadrilateral8);
  shape.blood_cells = 0;
  const Mesh wall = read(shape, "2.2");
  EXPECT_FALSE(wall.has(Part::blood));
  EXPECT_NEAR(volume(wall, Part::wall) / wall_volume(shape), 1, 1e-3);
  EXPECT_LT(surface(wall, Boundary::interface, Part::wall).radial, 0);
  EXPECT_NEAR(inlet_radius(wall), 0.033, 1e-12);
}

TEST(GmshMesh, MayNameItsInsideAndItsLayers) {
  Stenosis shape = smooth(triangle6);
  shape.name_inside = shape.layered = true;
  const Mesh mesh = read(shape);
  EXPECT_EQ(mesh.layers(), 2);
  double inner = 0;
  for (const Cell& cell : mesh.cells) {
    if (cell.part == Part::blood) continue;
    const auto& [r, z] = mesh.points[cell.nodes[mesh.centre_node()]];
    const double lumen = shape.lumen(z), middle = 0.5 * (lumen + shape.radius + shape.thickness);
    EXPECT_EQ(cell.layer, r < middle ? 0 : 1);
    if (cell.layer == 0) ++inner;
  }
  EXPECT_EQ(inner, 16);
}

TEST(GmshMesh, LooksPastWhatItDoesNotNeed) {
  GmshModel model = stenosis_mesh(smooth(triangle6));
  const Mesh plain = parse_gmsh(model.text("4.1"), "test");
  for (auto& node : model.nodes) node.tag = 1'000'000'000'000 + 7 * node.tag;
  for (auto& element : model.elements) {
    for (long& tag : element.nodes) tag = 1'000'000'000'000 + 7 * tag;
    element.tag *= 3;
  }
  model.nodes.push_back({5, 1, 2, 3});                      // of no cell
  model.elements.push_back({4, 15, "corner", {5}});         // a point
  model.elements.push_back({5, 1, "centre line", {5, 5}});  // a curve of another purpose
  model.parametric = true;
  std::string text = model.text("4.1") + "$NodeData\n1\n\"p\"\n$EndNodeData\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\r\n");
  const Mesh mesh = parse_gmsh(text, "test");
  EXPECT_EQ(mesh.points, plain.points);
  EXPECT_EQ(mesh.edges.size(), plain.edges.size());
}

TEST(GmshMesh, HasItsAxisAtZeroExactly) {
  GmshModel model = stenosis_mesh(smooth(triangle6));
  for (auto& node : model.nodes)
    if (node.x == 0) node.x = node.tag % 2 == 0 ? 3e-12 : -2e-17;
  for (const auto& [r, z] : parse_gmsh(model.text("4.1"), "test").points) EXPECT_TRUE(r == 0 || r > 1e-4);
}

TEST(ExampleMesh, IsTheStenosisThatItSays) {
  const Mesh mesh = read_gmsh(TUNICA_SOURCE_DIR "/scenes/stenosis.msh");
  check(mesh, {0.033, "scenes/stenosis.msh"});
  const Stenosis shape;
  const Mesh generated = parse_gmsh(stenosis_mesh(shape).text("4.1"), "generated");
  ASSERT_EQ(mesh.points.size(), generated.points.size());
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(mesh.points[p][i], generated.points[p][i], 1e-11);  // of 10 digits
  const Section throat = section_at(mesh, 0.33);
  EXPECT_NEAR(throat.inner, 0.6 * 0.033, 1e-11);
  EXPECT_NEAR(throat.outer, 0.043, 1e-11);
  // Parabolas over cells of 0.2/14.5 cm; the curvature jumps at both ends of the stenosis.
  EXPECT_NEAR(volume(mesh, Part::blood) / lumen_volume(shape), 1, 1e-4);
}

TEST(LengthUnits, AreCheckedAgainstTheScene) {
  const auto message = [](double scale, double radius) -> std::string {
    GmshModel model = stenosis_mesh(smooth(triangle3));
    for (auto& node : model.nodes) {
      node.x *= scale;
      node.y *= scale;
    }
    try {
      check(parse_gmsh(model.text("4.1"), "test"), {radius, "artery.msh"});
      return {};
    } catch (const InvalidInput& error) {
      return error.what();
    }
  };
  const auto expect = [&](double scale, double radius, const char* unit, const char* factor) {
    const std::string text = message(scale, radius);
    for (const char* word : {"artery.msh", "geometry.radius", "scale it by", unit, factor})
      EXPECT_NE(text.find(word), std::string::npos) << text << '\n' << word;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  };
  for (const double radius : {0.033, 0.04, 0.02, 0.1, 0.3}) EXPECT_EQ(message(1, radius), "");
  expect(10, 0.033, "millimetres", "by 0.1 ");
  // The inlet's radius need not be exactly that of the scene.
  expect(10.6, 0.033, "millimetres", "by 0.1 ");
  expect(8.2, 0.033, "millimetres", "by 0.1 ");
  EXPECT_EQ(message(7, 0.033), "");
  EXPECT_EQ(message(14, 0.033), "");
  expect(0.0106, 0.033, "metres", "by 100 ");
  expect(1.06e4, 0.033, "micrometres", "by 0.0001 ");
  expect(0.01, 0.33, "cm", "by 1");  // metres beside a radius in millimetres: a thousandth
  expect(0.01, 0.033, "metres", "by 100 ");
  expect(0.01, 0.05, "metres", "by 100 ");
  expect(1e4, 0.033, "micrometres", "by 0.0001 ");
  expect(1, 0.0005, "cm", "by 0.0152 ");  // 66 times, which is no unit
}

TEST(LengthUnits, OfTheSceneAreRemarkedOn) {
  const auto remark = [](const char* radius) {
    const Scene scene =
        parse_scene("[geometry]\n", "some.toml", ".", {std::string("geometry.radius=") + radius});
    return coupled::radius_remark(0.033, scene);
  };
  for (const char* near : {"0.033", "0.05", "0.02"}) EXPECT_FALSE(remark(near)) << near;
  for (const char* typed : {"0.33", "0.3"}) {
    ASSERT_TRUE(remark(typed)) << typed;
    EXPECT_NE(remark(typed)->find(std::string("did you mean \"") + typed + " mm\"?"), std::string::npos);
  }
  ASSERT_TRUE(remark("0.1"));
  EXPECT_EQ(remark("0.1")->find("did you mean"), std::string::npos);
}

}  // namespace
