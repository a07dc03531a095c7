// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/gmsh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>

#include "core/element/gmsh_file.hpp"
#include "full3d/inlet_profile.hpp"
#include "full3d/measures.hpp"
#include "tests/support/solid_cases.hpp"
#include "tests/support/solid_gmsh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace tunica;
using namespace tunica::full3d;
using test_support::gmsh_model;
using test_support::GmshModel;
using test_support::SolidCase;

constexpr Boundary boundaries[] = {Boundary::inlet, Boundary::outlet,     Boundary::interface,
                                   Boundary::outer, Boundary::wall_inlet, Boundary::wall_outlet};

Mesh read(const GmshModel& model, const std::string& version = "4.1") {
  return parse_gmsh(model.text(version), "mesh file artery.msh");
}

VesselSpec bent_vessel(const SolidCase& kind) {
  VesselSpec spec = test_support::coarse_vessel(kind, Sector::full, 0.8);
  spec.layers = {0.3, 0.2};
  spec.wall_cells = 2;
  return spec;
}

class WrittenVessel : public testing::TestWithParam<std::tuple<SolidCase, std::string>> {};

INSTANTIATE_TEST_SUITE_P(, WrittenVessel,
                         testing::Combine(testing::ValuesIn(std::begin(test_support::solid_cases),
                                                            std::end(test_support::solid_cases) - 1),
                                          testing::Values("2.2", "4.1")),
                         [](const auto& instance) {
                           return std::string(std::get<0>(instance.param).name) +
                                  (std::get<1>(instance.param) == "2.2" ? "_2_2" : "_4_1");
                         });

TEST_P(WrittenVessel, IsTheOneThatIsRead) {
  const auto& [kind, version] = GetParam();
  const Mesh built = o_grid_vessel(bent_vessel(kind));
  const Mesh found = adapted(read(gmsh_model(built), version), kind.element, true);
  EXPECT_EQ(found.cells.size(), built.cells.size());
  EXPECT_EQ(found.faces.size(), built.faces.size());
  EXPECT_EQ(found.layers(), 2);
  // Coordinates have ten digits.
  constexpr double digits = 1e-8;
  for (const Part part : {Part::blood, Part::wall})
    EXPECT_NEAR(volume(found, part), volume(built, part), digits);
  for (const Boundary boundary : boundaries) {
    const Surface a = surface(built, boundary), b = surface(found, boundary);
    EXPECT_NEAR(a.area, b.area, digits) << name(boundary);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a.centre[i], b.centre[i], digits) << name(boundary);
  }
}

TEST_P(WrittenVessel, TurnsLeftHandedCellsRound) {
  const auto& [kind, version] = GetParam();
  const Mesh built = o_grid_vessel(bent_vessel(kind));
  GmshModel model = gmsh_model(built);
  for (auto& node : model.nodes) node.y = -node.y;
  const Mesh found = adapted(read(model, version), kind.element, true);
  // In hexahedra the mirror image's faces are divided into the same shapes.
  for (const Part part : {Part::blood, Part::wall})
    EXPECT_NEAR(volume(found, part), volume(built, part), 1e-8);
}

TEST(GmshInSpace, NumbersCellsAndNodesFromTheInlet) {
  VesselSpec spec = bent_vessel(test_support::solid_cases[0]);
  spec.axial_cells = 6;
  GmshModel model = gmsh_model(o_grid_vessel(spec));
  std::reverse(model.elements.begin(), model.elements.end());
  const Mesh mesh = read(model);
  const int slice = static_cast<int>(mesh.cells.size()) / spec.axial_cells;
  for (const Face& face : mesh.faces) {
    EXPECT_TRUE(face.boundary != Boundary::inlet || face.cell < slice);
    EXPECT_TRUE(face.boundary != Boundary::wall_outlet ||
                face.cell >= static_cast<int>(mesh.cells.size()) - slice);
  }
  EXPECT_LT(*std::max_element(mesh.cells[0].nodes.begin(), mesh.cells[0].nodes.end()), 27);
}

TEST(GmshInSpace, HexahedraWithoutMiddlesOfFacesAreNearlyTheSame) {
  VesselSpec spec = bent_vessel(test_support::solid_cases[0]);
  double errors[2];
  for (double& error : errors) {
    const Mesh built = o_grid_vessel(spec);
    const Mesh found = read(test_support::serendipity(gmsh_model(built)));
    EXPECT_EQ(found.cells.size(), built.cells.size());
    error = std::abs(volume(found, Part::wall) - volume(built, Part::wall)) / volume(built, Part::wall);
    spec.around_cells *= 2;
    spec.axial_cells *= 2;
  }
  // Edges are the same; what is between them differs by fourth order and its volume by no less.
  EXPECT_LT(errors[0], 1e-2);
  EXPECT_LT(errors[1], errors[0] / 8);
}

TEST(GmshInSpace, BubblesAndWallsAloneAreTaken) {
  const SolidCase bubble = test_support::solid_cases[4];
  const Mesh built = o_grid_vessel(bent_vessel(bubble)), file = read(gmsh_model(built));
  const Mesh found = adapted(file, Element::bubble, true);
  EXPECT_EQ(found.points.size(), built.points.size());
  const Cell& cell = found.cells[0];
  Point sum{};
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) sum[i] += 0.25 * found.points[cell.nodes[k]][i];
  EXPECT_EQ(found.points[cell.nodes[10]], sum);

  const Mesh wall = adapted(file, Element::quadratic, false);
  EXPECT_FALSE(wall.has(Part::blood));
  EXPECT_NEAR(volume(wall, Part::wall), volume(file, Part::wall), 1e-12);
  EXPECT_NEAR(surface(wall, Boundary::interface).area, surface(file, Boundary::interface).area, 1e-12);
  // The file of a wall alone names its interface.
  VesselSpec spec = bent_vessel(test_support::solid_cases[0]);
  spec.blood = false;
  EXPECT_FALSE(read(gmsh_model(o_grid_vessel(spec))).has(Part::blood));
}

TEST(GmshInSpace, IsToldFromAHalfPlane) {
  const test_support::TemporaryFolder folder;
  const auto dimensions = [&](const std::string& text) {
    std::ofstream(folder.path() / "a.msh") << text;
    return element::gmsh_dimensions(folder.path() / "a.msh");
  };
  for (const char* version : {"2.2", "4.1"}) {
    EXPECT_EQ(dimensions(gmsh_model(o_grid_vessel(bent_vessel(test_support::solid_cases[0]))).text(version)),
              3);
    EXPECT_EQ(dimensions(test_support::stenosis_mesh({}).text(version)), 2);
    // Its cells tell when its names do not.
    GmshModel model = gmsh_model(o_grid_vessel(bent_vessel(test_support::solid_cases[1])));
    for (auto& element : model.elements) element.name.clear();
    EXPECT_EQ(dimensions(model.text(version)), 3);
    model = test_support::stenosis_mesh({});
    for (auto& element : model.elements) element.name.clear();
    EXPECT_EQ(dimensions(model.text(version)), 2);
  }
  EXPECT_EQ(dimensions(""), 0);
  EXPECT_EQ(dimensions("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n"), 0);
  EXPECT_EQ(element::gmsh_dimensions(folder.path() / "none.msh"), 0);
}

TEST(MeanTube, OfAStraightVesselIsItself) {
  VesselSpec spec = test_support::coarse_vessel(test_support::solid_cases[0], Sector::full);
  spec.around_cells = 16;
  const MeanTube tube = mean_tube(o_grid_vessel(spec));
  // The radius is off the circle by less than 2e-5 in parabolas through three points of a 16th of it; a third
  // of the difference of the surfaces' areas is the ring's relative error.
  EXPECT_NEAR(tube.radius, 1, 5e-5);
  EXPECT_NEAR(tube.thickness, 0.5, 5e-5);
  EXPECT_NEAR(tube.length, 2, 1e-4);
}

// What meshers leave of a plane: nodes off it by up to 1 % of the radius.
TEST(DevelopedFlowThroughAnUnevenInlet, IsTheOnePrescribed) {
  VesselSpec spec = test_support::coarse_vessel(test_support::solid_cases[3], Sector::full);
  spec.around_cells = 16;
  spec.ring_cells = 3;
  Mesh mesh = o_grid_vessel(spec);
  std::mt19937 random(21);
  std::uniform_real_distribution<double> noise(-0.01, 0.01);
  for (Point& x : mesh.points)
    if (x[2] == 0) x[2] += noise(random);
  const InletProfile profile(mesh, 0.01);
  // Over flat triangles the integral of a linear velocity is its mean times the area.
  double flow = 0;
  for (const Face& face : mesh.faces) {
    if (face.boundary != Boundary::inlet) continue;
    std::array<Point, 3> at;
    Vector<double> mean{};
    int n = 0;
    for (const int k : element::solid::face_nodes(mesh.shape, element::solid::Basis::linear, face.face)) {
      at[n] = mesh.points[mesh.node(face.cell, element::solid::Basis::linear, k)];
      const auto velocity = profile.at(at[n++]);
      for (int i = 0; i < 3; ++i) mean[i] += velocity[i] / 3;
    }
    Vector<double> u, v;
    for (int i = 0; i < 3; ++i) {
      u[i] = at[1][i] - at[0][i];
      v[i] = at[2][i] - at[0][i];
    }
    flow -= 0.5 * dot(mean, cross(u, v));
  }
  EXPECT_NEAR(flow, 1, 1e-12);
}

class DevelopedFlow : public testing::TestWithParam<SolidCase> {};
INSTANTIATE_TEST_SUITE_P(, DevelopedFlow,
                         testing::Values(test_support::solid_cases[0], test_support::solid_cases[1],
                                         test_support::solid_cases[2], test_support::solid_cases[3]),
                         [](const auto& instance) { return instance.param.name; });

// In an ellipse with half axes a and b, v/Q = 2/(pi a b) (1 - x^2/a^2 - y^2/b^2).
TEST_P(DevelopedFlow, ThroughAnEllipseIsTheExactOneToTheOrderOfItsElement) {
  const bool quadratic = GetParam().element == Element::quadratic;
  const double a = 1.2, b = 0.85;
  double errors[2];
  VesselSpec spec = test_support::coarse_vessel(GetParam(), Sector::full);
  spec.around_cells = 16;
  for (double& error : errors) {
    spec.ring_cells = spec.around_cells / 8;
    const Mesh mesh = test_support::tapering_bend(spec, 0.2, 0.7);
    const InletProfile profile(mesh, 1e-6);
    double squares = 0;
    int count = 0;
    for (const Point& x : mesh.points) {
      const auto v = profile.at(x);
      if (std::abs(x[2]) > 1e-12) {
        EXPECT_EQ(dot(v, v), 0);
        continue;
      }
      const double exact =
          2 / (std::numbers::pi * a * b) * std::max(0.0, 1 - x[0] * x[0] / (a * a) - x[1] * x[1] / (b * b));
      squares += (v[2] - exact) * (v[2] - exact);
      ++count;
      EXPECT_NEAR(std::hypot(v[0], v[1]), 0, 1e-12);
    }
    error = std::sqrt(squares / count);
    spec.around_cells *= 2;
  }
  // Of a peak of 0.62; with straight sides the flow misses a part of the section of that order.
  EXPECT_LT(errors[0], quadratic ? 5e-4 : 5e-2);
  EXPECT_GT(std::log2(errors[0] / errors[1]), quadratic ? 2.7 : 1.7);
}

}  // namespace
