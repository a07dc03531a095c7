// SPDX-License-Identifier: GPL-3.0-or-later
#include "full3d/wall_axes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "full3d/given_course.hpp"
#include "full3d/measures.hpp"
#include "full3d/vessel_shape.hpp"
#include "tests/support/solid_cases.hpp"
#include "tests/support/solid_gmsh.hpp"

namespace {

using namespace tunica;
using namespace tunica::full3d;
using test_support::SolidCase;

/// Root mean square over the wall of the angle between directions and exact ones, rad.
struct Errors {
  double circumferential = 0, axial = 0;
};
double square_of_difference(const Vector<double>& a, const Vector<double>& b) {
  const Vector<double> off{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return dot(off, off);
}
template <class Exact>
Errors errors(const Mesh& mesh, const Exact& exact) {
  const WallAxes axes(mesh);
  const auto rule = element::solid::cell_rule(
      mesh.shape, mesh.quadratic ? element::solid::Basis::quadratic : element::solid::Basis::linear);
  double volume = 0;
  Errors sum;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    if (mesh.cells[cell].part != Part::wall) continue;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Image at = image(mesh, cell, rule.points[q]);
      const auto found = axes.at(cell, rule.points[q]), known = exact(at.point);
      const double weight = rule.weights[q] * at.determinant();
      EXPECT_NEAR(dot(found.axial, found.axial), 1, 1e-12);
      EXPECT_NEAR(dot(found.circumferential, found.circumferential), 1, 1e-12);
      EXPECT_NEAR(dot(found.circumferential, found.axial), 0, 1e-12);
      // The same sense, too: products with opposite vectors would be -1.
      sum.circumferential += weight * square_of_difference(found.circumferential, known.circumferential);
      sum.axial += weight * square_of_difference(found.axial, known.axial);
      volume += weight;
    }
  }
  return {std::sqrt(sum.circumferential / volume), std::sqrt(sum.axial / volume)};
}

VesselSpec vessel(const SolidCase& kind, double bend, int refinement) {
  VesselSpec spec = test_support::coarse_vessel(kind, Sector::full, bend);
  spec.around_cells = 16 * refinement;
  spec.wall_cells = 2 * refinement;
  spec.axial_cells = 6 * refinement;
  return spec;
}

class AxesInSpace : public testing::TestWithParam<SolidCase> {};
INSTANTIATE_TEST_SUITE_P(, AxesInSpace,
                         testing::Values(test_support::solid_cases[0], test_support::solid_cases[1],
                                         test_support::solid_cases[2], test_support::solid_cases[3]),
                         [](const auto& instance) { return instance.param.name; });

// In a torus a is the angle about the bend's centre, and t the logarithm of the section's radius.
TEST_P(AxesInSpace, AreThoseOfATorusToTheOrderOfTheirGradients) {
  const bool quadratic = GetParam().element == Element::quadratic;
  Errors found[2];
  for (int k = 0; k < 2; ++k) {
    const VesselSpec spec = vessel(GetParam(), 1, k + 1);
    const VesselShape shape{spec.radius, spec.layers[0], spec.length, spec.bend_angle};
    found[k] = errors(o_grid_vessel(spec), [&](const Point& x) { return shape.axes(x); });
  }
  EXPECT_LT(found[0].circumferential, quadratic ? 1e-2 : 0.15);
  EXPECT_LT(found[0].axial, quadratic ? 1e-2 : 0.15);
  const double order = quadratic ? 1.8 : 0.9;
  EXPECT_GT(std::log2(found[0].circumferential / found[1].circumferential), order);
  // In hexahedra that stand in rows along the bend the angle is linear.
  if (GetParam().shape == Shape::hexahedron)
    EXPECT_LT(found[0].axial, 1e-10);
  else
    EXPECT_GT(std::log2(found[0].axial / found[1].axial), order);
}

TEST_P(AxesInSpace, AreTheAxisOfAStraightVesselExactly) {
  const VesselSpec spec = vessel(GetParam(), 0, 1);
  const VesselShape shape{spec.radius, spec.layers[0], spec.length, 0};
  const Errors found = errors(o_grid_vessel(spec), [&](const Point& x) { return shape.axes(x); });
  // A linear function is in all bases.
  EXPECT_LT(found.axial, 1e-10);
}

// By its symmetry the circumference of a vessel of revolution is e_theta, whatever its wall is like.
TEST_P(AxesInSpace, GoAroundAWaist) {
  const bool quadratic = GetParam().element == Element::quadratic;
  double found[2];
  for (int k = 0; k < 2; ++k) {
    Mesh mesh = o_grid_vessel(vessel(GetParam(), 0, k + 1));
    for (Point& x : mesh.points) {
      const double scale = 0.9 + 0.1 * std::cos(std::numbers::pi * x[2]);
      x[0] *= scale;
      x[1] *= scale;
    }
    found[k] = errors(mesh, [](const Point& x) {
                 const double r = std::hypot(x[0], x[1]);
                 return wall::MaterialAxes{{-x[1] / r, x[0] / r, 0}, {0, 0, 1}};
               }).circumferential;
  }
  EXPECT_LT(found[0], quadratic ? 1e-2 : 0.15);
  EXPECT_GT(std::log2(found[0] / found[1]), quadratic ? 1.8 : 0.9);
}

TEST(AxesOfAFile, NeedAWayThrough) {
  Mesh mesh = o_grid_vessel(vessel(test_support::solid_cases[0], 0, 1));
  std::erase_if(mesh.faces, [](const Face& face) {
    return face.boundary == Boundary::wall_inlet || face.boundary == Boundary::wall_outlet;
  });
  try {
    WallAxes{mesh};
    ADD_FAILURE();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("no way through"), std::string::npos) << error.what();
  }
}

/// A vessel as the tier has it from a file.
std::unique_ptr<Setup> given(Mesh mesh) {
  auto setup = std::make_unique<Setup>();
  setup->problem.mesh = std::move(mesh);
  const MeanTube tube = mean_tube(setup->problem.mesh);
  setup->shape = {tube.radius, tube.thickness, tube.length, 0};
  setup->axes = std::make_unique<const WallAxes>(setup->problem.mesh);
  return setup;
}

class CourseOfATorus : public testing::TestWithParam<SolidCase> {};
INSTANTIATE_TEST_SUITE_P(, CourseOfATorus,
                         testing::Values(test_support::solid_cases[0], test_support::solid_cases[1],
                                         test_support::solid_cases[2], test_support::solid_cases[3]),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(CourseOfATorus, IsTheExactOne) {
  const bool quadratic = GetParam().element == Element::quadratic;
  for (const bool blood : {true, false}) {
    SCOPED_TRACE(blood);
    VesselSpec spec = vessel(GetParam(), 1, 1);
    spec.blood = blood;
    const VesselShape shape{spec.radius, spec.layers[0], spec.length, spec.bend_angle};
    const auto setup = given(o_grid_vessel(spec));
    const Locator locator(setup->problem.mesh);
    const GivenCourse course(*setup, locator);
    // Sides of cells are chords or parabolas of a 16th of the circle, which is 2 % or 3e-4 of the radius off.
    const double tolerance = quadratic ? 2e-3 : 0.03;
    EXPECT_NEAR(course.length(), spec.length, tolerance * spec.length);
    for (const int degrees : {0, 90, 180, 270}) {
      const double angle = degrees * std::numbers::pi / 180;
      const Across line = course.across(angle);
      const Point exact = shape.place({std::cos(angle), std::sin(angle), 1});
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(line.begin[i], exact[i], tolerance) << degrees;
      EXPECT_NEAR(line.thickness, 0.5, tolerance);
      EXPECT_NEAR(line.radius, 1, tolerance);
      if (GetParam().shape == Shape::tetrahedron) continue;
      const auto lines = course.cell_lines(line);
      ASSERT_EQ(lines.size(), 3U) << degrees;
      EXPECT_NEAR(lines[1], 0.25, 0.03);
      EXPECT_NEAR(lines[2], line.thickness, 1e-9);
    }
    const auto along = course.along();
    ASSERT_GT(along.size(), 60U);
    EXPECT_NEAR(along.front().s, 0, 1e-6);
    for (const AlongPoint& point : along) {
      const Point exact = shape.place({1, 0, point.s});
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(point.point[i], exact[i], tolerance * 2);
    }
  }
}

}  // namespace
