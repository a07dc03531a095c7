// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "app/report/surface.hpp"
#include "tests/support/bent_tube.hpp"

using namespace tunica;
using namespace tunica::report;
using observables::CellShape;
using observables::FieldMesh;
using test_support::bent_tube;
using test_support::BentTube;
using Point = std::array<double, 3>;

namespace {

/// Cubes of side 1 in a row along x, which share points or not, from y = -1/2 to 1/2.
FieldMesh cubes(int count, bool share_points) {
  FieldMesh mesh;
  mesh.shape = CellShape::hexahedron;
  for (int cell = 0; cell < count; ++cell) {
    const bool begins = cell == 0 || !share_points;
    for (int x = begins ? 0 : 1; x < 2; ++x)
      for (const auto& [y, z] : {std::pair{-0.5, 0.0}, {0.5, 0.0}, {0.5, 1.0}, {-0.5, 1.0}})
        mesh.points.push_back({cell + x * 1.0, y, z});
    const int first = share_points ? 4 * cell : 8 * cell;
    for (int k = 0; k < 8; ++k) mesh.cells.push_back(first + k);
  }
  return mesh;
}

FieldMesh mesh_of(const BentTube& wanted, std::size_t part) {
  return bent_tube(wanted)[part].mesh;
}

Point position(const FieldMesh& mesh, const Surface& surface, int vertex) {
  const auto& [first, second, weight] = surface.places[surface.vertices[vertex]];
  Point point;
  for (int k = 0; k < 3; ++k)
    point[k] = (1 - weight) * mesh.points[first][k] + weight * mesh.points[second][k];
  return point;
}

/// Integral of the normal over triangles, their area, and their cone's volume over the origin, which is the
/// body's when they close it and are oriented outwards.
struct Measures {
  Point normal{};
  double area = 0;
  double volume = 0;
};
Measures measure(const FieldMesh& mesh, const Surface& surface,
                 const std::vector<Surface::Triangle>& triangles) {
  Measures sum;
  for (const auto& triangle : triangles) {
    Point p[3];
    for (int k = 0; k < 3; ++k) p[k] = position(mesh, surface, triangle[k]);
    Point u, v;
    for (int k = 0; k < 3; ++k) {
      u[k] = p[1][k] - p[0][k];
      v[k] = p[2][k] - p[0][k];
    }
    const Point n{(u[1] * v[2] - u[2] * v[1]) / 2, (u[2] * v[0] - u[0] * v[2]) / 2,
                  (u[0] * v[1] - u[1] * v[0]) / 2};
    for (int k = 0; k < 3; ++k) {
      sum.normal[k] += n[k];
      sum.volume += p[0][k] * n[k] / 3;
    }
    sum.area += std::hypot(n[0], n[1], n[2]);
  }
  return sum;
}

}  // namespace

TEST(ReportSurface, TwoCubesHaveTenFaces) {
  for (const bool share_points : {true, false}) {
    const FieldMesh mesh = cubes(2, share_points);
    EXPECT_EQ(boundary_faces(mesh).size(), 10U);
    const Surface surface = visible_surface(mesh, 0);
    EXPECT_EQ(surface.outer.size(), 20U);
    const Measures sum = measure(mesh, surface, surface.outer);
    EXPECT_NEAR(sum.area, 10, 1e-12);
    EXPECT_NEAR(sum.volume, 2, 1e-12);
  }
}

TEST(ReportSurface, EachSideOfAnEdgeHasItsOwnVertex) {
  const auto count = [](const FieldMesh& mesh) {
    std::set<int> used;
    const Surface surface = visible_surface(mesh, 0);
    for (const auto& triangle : surface.outer) used.insert(triangle.begin(), triangle.end());
    return used.size();
  };
  // A cube's corner belongs to three faces. Between two cubes four edges go on smoothly, and so do the four
  // faces: each of the four points there is a vertex for both its faces.
  EXPECT_EQ(count(cubes(1, true)), 24U);
  EXPECT_EQ(count(cubes(2, true)), 24U + 8U);
}

TEST(ReportSurface, TurnedCellsAreOrientedOutwardsToo) {
  FieldMesh mesh = cubes(1, true);
  mesh.cells = {1, 0, 3, 2, 5, 4, 7, 6};
  const Surface surface = visible_surface(mesh, 0);
  EXPECT_NEAR(measure(mesh, surface, surface.outer).volume, 1, 1e-12);
}

TEST(ReportSurface, TetrahedraOfACube) {
  FieldMesh mesh = cubes(1, true);
  mesh.shape = CellShape::tetrahedron;
  // A corner's tetrahedron at four of the corners, and the one between them.
  mesh.cells = {0, 1, 3, 4, 2, 1, 3, 6, 5, 4, 6, 1, 7, 4, 6, 3, 1, 3, 4, 6};
  EXPECT_EQ(boundary_faces(mesh).size(), 12U);
  const Surface surface = visible_surface(mesh, 0);
  const Measures sum = measure(mesh, surface, surface.outer);
  EXPECT_NEAR(sum.area, 6, 1e-12);
  EXPECT_NEAR(sum.volume, 1, 1e-12);
  EXPECT_NEAR(measure(mesh, surface, surface.section).area, 1, 1e-12);
}

TEST(ReportSurface, ASectionIsWhereItIsAskedFor) {
  for (const double cut : {-0.5, -0.25, 0.0, 0.3, 0.5}) {
    const FieldMesh mesh = cubes(2, true);
    const Surface surface = visible_surface(mesh, cut);
    const Measures sum = measure(mesh, surface, surface.section);
    EXPECT_NEAR(sum.area, 2, 1e-12) << cut;
    EXPECT_NEAR(sum.normal[1], 2, 1e-12) << cut;
    std::set<int> used;
    for (const auto& triangle : surface.section) used.insert(triangle.begin(), triangle.end());
    for (const int vertex : used) EXPECT_NEAR(position(mesh, surface, vertex)[1], cut, 1e-12);
    // Values are interpolated as places are.
    std::vector<float> heights;
    for (const auto& point : mesh.points) heights.push_back(static_cast<float>(point[1]));
    const auto values = at_places(surface, heights, 1);
    for (const int vertex : used) EXPECT_NEAR(values[surface.vertices[vertex]], cut, 1e-6);
  }
}

TEST(ReportSurface, ATubesSurfaceIsClosed) {
  for (const bool of_tetrahedra : {false, true})
    for (const std::size_t part : {0U, 1U}) {
      const FieldMesh mesh = mesh_of({.of_tetrahedra = of_tetrahedra}, part);
      const Surface surface = visible_surface(mesh, 0);
      const Measures sum = measure(mesh, surface, surface.outer);
      for (const double component : sum.normal) EXPECT_NEAR(component, 0, 1e-12);
      // Sixteen corners around, so a little less than the circles' area times the centreline.
      const double inner = test_support::tube_inner, outer = test_support::tube_outer;
      const double circles = M_PI * 0.66 * (part == 0 ? inner * inner : outer * outer - inner * inner);
      EXPECT_GT(sum.volume, 0.93 * circles);
      EXPECT_LT(sum.volume, circles);
    }
}

TEST(ReportSurface, AQuarterHasNoFacesInItsPlanesOfSymmetry) {
  for (const std::size_t part : {0U, 1U}) {
    const FieldMesh quarter = mesh_of({.bend = 0, .is_quarter = true}, part);
    const FieldMesh whole = mesh_of({.bend = 0}, part);
    EXPECT_EQ(4 * boundary_faces(quarter).size(), boundary_faces(whole).size());
    const Surface surface = visible_surface(quarter, 0), all = visible_surface(whole, 0);
    EXPECT_NEAR(4 * measure(quarter, surface, surface.outer).area, measure(whole, all, all.outer).area,
                1e-12);
    EXPECT_NEAR(2 * measure(quarter, surface, surface.section).area, measure(whole, all, all.section).area,
                1e-12);
  }
}

TEST(ReportSurface, PlaneCellsHaveNone) {
  FieldMesh plane;
  EXPECT_THROW(boundary_faces(plane), std::logic_error);
}
