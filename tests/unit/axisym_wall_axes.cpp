// SPDX-License-Identifier: GPL-3.0-or-later
// The wall's axial direction against walls whose potential is known, surfaces and symmetries.
#include "axisym/assembler.hpp"
#include "axisym/wall_axes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "axisym/fields.hpp"
#include "axisym/gmsh.hpp"
#include "axisym/structured.hpp"
#include "axisym/tables.hpp"
#include "core/error.hpp"
#include "tests/support/axisym_state.hpp"
#include "tests/support/gmsh_model.hpp"

namespace tunica::axisym {
namespace {

constexpr double pi = std::numbers::pi;

Problem problem_of(Mesh mesh, Element element) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.discretisation.element = element;
  problem.laws.assign(problem.mesh.layers(), wall::EnergyLaw<wall::LinearElastic<double>>{{1, 0.3}});
  return problem;
}

/// A wall alone on 0 <= u, v <= 1, u to the outside and v along the vessel.
Mesh unit_wall(CellShape shape, int across, int along) {
  TubeSpec spec;
  spec.radius = 1;
  spec.layers = {1};
  spec.length = 1;
  spec.blood_cells = 1;
  spec.wall_cells = across;
  spec.axial_cells = along;
  spec.blood = false;
  spec.shape = shape;
  Mesh mesh = structured_tube(spec);
  for (Point& point : mesh.points) point[0] -= 1;
  return mesh;
}

Mesh mapped(Mesh mesh, const std::function<Point(double u, double v)>& map) {
  for (Point& point : mesh.points) point = map(point[0], point[1]);
  return mesh;
}

Mesh stenosis(int refinement, int type = test_support::quadrilateral9) {
  test_support::Stenosis shape;
  shape.type = type;
  shape.blood_cells = 0;
  shape.wall_cells = refinement;
  shape.axial_cells = 32 * refinement;
  return parse_gmsh(test_support::stenosis_mesh(shape).text("4.1"), "stenosis");
}

/// Inclination to the z axis.
double angle(const Vector<double>& axial) {
  return std::atan2(axial[0], axial[2]);
}

struct Discretised {
  CellShape shape;
  Element element;
  double order;  ///< of the gradient
};
std::ostream& operator<<(std::ostream& out, const Discretised& d) {
  return out << (d.shape == CellShape::triangle ? "triangle" : "quadrilateral")
             << (d.element == Element::quadratic ? "_quadratic"
                 : d.element == Element::linear  ? "_linear"
                                                 : "_bubble");
}
class WallDirections : public testing::TestWithParam<Discretised> {};
INSTANTIATE_TEST_SUITE_P(Elements, WallDirections,
                         testing::Values(Discretised{CellShape::quadrilateral, Element::quadratic, 2},
                                         Discretised{CellShape::triangle, Element::quadratic, 2},
                                         Discretised{CellShape::quadrilateral, Element::linear, 1},
                                         Discretised{CellShape::triangle, Element::linear, 1},
                                         Discretised{CellShape::triangle, Element::bubble, 1}),
                         testing::PrintToStringParamName());

void expect_exactly_axial(const Mesh& mesh, Element element) {
  const Problem problem = problem_of(mesh, element);
  const Tables tables = tabulate(problem);
  ASSERT_FALSE(tables.wall.empty());
  for (const WallTable& table : tables.wall)
    for (const WallPoint& point : table.points) {
      EXPECT_EQ(point.axes.circumferential, (Vector<double>{0, 1, 0}));
      EXPECT_EQ(point.axes.axial, (Vector<double>{0, 0, 1}));
    }
  EXPECT_EQ(tables.axes.at(tables.wall.front().cell, {0.3, 0.2}).axial, (Vector<double>{0, 0, 1}));
}

TEST_P(WallDirections, AreExactInAStraightTube) {
  TubeSpec spec;
  spec.radius = 0.033;
  spec.layers = {0.004, 0.006};
  spec.length = 0.66;
  spec.blood_cells = 2;
  spec.wall_cells = 3;
  spec.axial_cells = 12;
  spec.end_grading = 5;
  spec.wall_grading = 2;
  spec.shape = GetParam().shape;
  Mesh mesh = structured_tube(spec);
  expect_exactly_axial(mesh, GetParam().element);

  // What a mesh generator makes of it: nodes anywhere inside, coordinates rounded.
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(-1, 1);
  std::vector<bool> outside(mesh.points.size(), false);
  for (const Edge& edge : mesh.edges)
    for (const int node : mesh.side_nodes(edge.cell, edge.side)) outside[node] = true;
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    for (double& coordinate : mesh.points[k]) coordinate += (outside[k] ? 1e-16 : 1e-5) * within(random);
  expect_exactly_axial(mesh, GetParam().element);
}

TEST(WallDirectionsOfAFile, AreExactInAStraightTube) {
  test_support::Stenosis shape;
  shape.severity = 0;
  expect_exactly_axial(parse_gmsh(test_support::stenosis_mesh(shape).text("2.2"), "straight"),
                       Element::quadratic);
}

/// Root mean square over the quadrature points, and the greatest at the nodes of the displacement, of the
/// angle to an exact direction.
struct Deviation {
  double mean, at_nodes;
};
Deviation deviation(const Problem& problem, const std::function<Vector<double>(const Point&)>& exact) {
  const Mesh& mesh = problem.mesh;
  const Element element = problem.discretisation.element;
  const Tables tables = tabulate(problem);
  double sum = 0, weight = 0, at_nodes = 0;
  for (const WallTable& table : tables.wall) {
    for (const WallPoint& point : table.points) {
      sum += point.weight * std::pow(angle(point.axes.axial) - angle(exact(point.place)), 2);
      weight += point.weight;
    }
    for (int k = 0; k < counts(mesh.shape, element).displacement; ++k) {
      const auto local = element::node_position(mesh.shape, k);
      const Point& place = mesh.points[mesh.cells[table.cell].nodes[k]];
      at_nodes =
          std::max(at_nodes, std::abs(angle(tables.axes.at(table.cell, local).axial) - angle(exact(place))));
    }
  }
  return {std::sqrt(sum / weight), at_nodes};
}

void expect_order(const std::function<Point(double u, double v)>& map,
                  const std::function<Vector<double>(const Point&)>& exact, const Discretised& d) {
  std::vector<Deviation> found;
  for (const int refinement : {4, 8, 16})
    found.push_back(
        deviation(problem_of(mapped(unit_wall(d.shape, refinement, 4 * refinement), map), d.element), exact));
  const double mean_order = std::log2(found[1].mean / found[2].mean);
  const double node_order = std::log2(found[1].at_nodes / found[2].at_nodes);
  std::cout << d << ": mean " << found[2].mean << " rad of order " << mean_order << ", at nodes "
            << found[2].at_nodes << " rad of order " << node_order << "\n";
  EXPECT_GT(mean_order, d.order - 0.15);
  EXPECT_GT(node_order, d.order - 0.15);
}

// Cones about one axis with one apex, between spheres about it: phi = -1/distance.
TEST_P(WallDirections, AreTheGeneratorsOfACone) {
  expect_order(
      [](double u, double v) -> Point {
        const double slope = 0.3 + 0.25 * u, distance = 1 + v;
        return {distance * std::sin(slope), distance * std::cos(slope)};
      },
      [](const Point& x) -> Vector<double> {
        return {x[0], 0, x[1]};
      },
      GetParam());
}

// phi = z^2 - r^2/2, a potential about the axis and none in the plane, with stream lines r^2 z = const.
TEST_P(WallDirections, FollowAHornAboutTheAxis) {
  expect_order(
      [](double u, double v) -> Point {
        const double stream = 0.2 + 0.3 * u, potential = 1 + 1.5 * v;
        double z = 2;  // z^3 - potential z - stream/2 = 0, from beyond its only positive root
        for (int k = 0; k < 20; ++k) z -= (z * z * z - potential * z - stream / 2) / (3 * z * z - potential);
        return {std::sqrt(stream / z), z};
      },
      [](const Point& x) -> Vector<double> {
        return {-x[0], 0, 2 * x[1]};
      },
      GetParam());
}

// A wall of constant thickness h about a wavy middle surface r = R(z), with inclination theta. Both of its
// surfaces have the inclination theta of the middle surface at the foot of the normal, and in between the
// direction's angle obeys  Laplace(angle) = sin(2 angle)/(2 r^2) + (sin(2 angle) d/dz - cos(2 angle) d/dr)
// angle/r  in the half plane, so that with s the length along the middle surface it differs from theta by at
// most h^2/8 times the greatest |theta''(s)| + |sin(2 theta)| (1/(2 r^2) + 2 |theta'(s)|/r), but for the
// share h |theta'| of it that the curvature of the surfaces is worth, for which 10 % are given.
TEST(WallDirectionsInWaves, FollowTheMiddleSurface) {
  constexpr double radius = 0.038, amplitude = 0.004, thickness = 0.01, wave_number = 2 * pi / 0.2,
                   length = 0.4;
  const auto slope = [](double z) { return -amplitude * wave_number * std::sin(wave_number * z); };
  const Mesh flat = unit_wall(CellShape::quadrilateral, 4, 160);
  const Problem problem =
      problem_of(mapped(flat,
                        [&](double u, double v) -> Point {
                          const double z = length * v, theta = std::atan(slope(z));
                          const double offset = thickness * (u - 0.5);
                          return {radius + amplitude * std::cos(wave_number * z) + offset * std::cos(theta),
                                  z - offset * std::sin(theta)};
                        }),
                 Element::quadratic);
  const Tables tables = tabulate(problem);
  const auto rule = element::cell_rule(flat.shape, element::Basis::quadratic);
  double worst = 0;
  for (const WallTable& table : tables.wall)
    for (std::size_t q = 0; q < table.points.size(); ++q) {
      const double z = length * image(flat, table.cell, rule.points[q]).point[1];
      worst = std::max(worst, std::abs(angle(table.points[q].axes.axial) - std::atan(slope(z))));
    }
  // By arc length these are less than by z.
  const double greatest = std::atan(amplitude * wave_number);
  const double curvature = amplitude * wave_number * wave_number, turn = curvature * wave_number;
  const double least_radius = radius - amplitude - thickness / 2;
  const double bound =
      1.1 * thickness * thickness / 8 *
      (turn + std::sin(2 * greatest) * (0.5 / (least_radius * least_radius) + 2 * curvature / least_radius));
  std::cout << "directions differ from the middle surface by " << worst << " rad; bound " << bound
            << ", greatest inclination " << greatest << "\n";
  EXPECT_LT(worst, bound);
  EXPECT_LT(bound, 0.05 * greatest) << "the bound says something";
}

// The direction has no component along the normals of both surfaces.
TEST(WallDirectionsInAStenosis, AreTangentialToTheSurfaces) {
  std::vector<double> normal_part;
  for (const int refinement : {2, 4, 8}) {
    const Problem problem = problem_of(stenosis(refinement), Element::quadratic);
    const Tables tables = tabulate(problem);
    double worst = 0;
    for (const Edge& edge : problem.mesh.edges) {
      if (edge.boundary != Boundary::interface && edge.boundary != Boundary::outer) continue;
      const auto rule = element::side_rule(problem.mesh.shape, edge.side, 3);
      for (const auto& local : rule.points) {
        const Image at = image(problem.mesh, edge.cell, local);
        const double r = at.slope[0][0] * rule.direction[0] + at.slope[0][1] * rule.direction[1];
        const double z = at.slope[1][0] * rule.direction[0] + at.slope[1][1] * rule.direction[1];
        const auto axial = tables.axes.at(edge.cell, local).axial;
        worst = std::max(worst, std::abs(axial[0] * z - axial[2] * r) / std::hypot(r, z));
      }
    }
    normal_part.push_back(worst);
  }
  std::cout << "normal parts " << normal_part[0] << ", " << normal_part[1] << ", " << normal_part[2] << "\n";
  // Curvature jumps where the stenosis begins, within a cell: there the order is 1.
  EXPECT_GT(std::log2(normal_part[1] / normal_part[2]), 0.85);
  EXPECT_LT(normal_part[2], 2e-3);
}

// In an unloaded wall fibres are shown at cos(beta) e_theta + sin(beta) times the surfaces' tangent.
TEST(WallDirectionsInAStenosis, AreThoseOfTheFibersInPictures) {
  test_support::Stenosis shape;
  shape.type = test_support::triangle6;
  shape.blood_cells = 0;
  shape.wall_cells = 4;
  shape.axial_cells = 128;
  const Problem problem =
      test_support::vessel(parse_gmsh(test_support::stenosis_mesh(shape).text("4.1"), "stenosis"),
                           Element::quadratic, {"wall.fiber_angle=30"});
  const Assembler assembler(problem);
  const Fields fields(assembler);
  auto series = fields.empty_series();
  fields.append(0, std::vector<double>(assembler.layout().size(), 0.0), series);
  const observables::FieldSeries& wall = series.back();
  std::size_t field = 0;
  while (wall.point_fields[field].name != "fiber_direction") ++field;
  const auto& directions = wall.frames[0].values[field];
  double worst = 0;
  for (std::size_t k = 0; k < wall.mesh.points.size(); ++k) {
    const double r = wall.mesh.points[k][0], z = wall.mesh.points[k][2];
    const bool inner = std::abs(r - shape.lumen(z)) < 1e-9;
    if (!inner && std::abs(r - shape.radius - shape.thickness) > 1e-9) continue;
    constexpr double step = 1e-6;
    const double slope = inner ? (shape.lumen(z + step) - shape.lumen(z - step)) / (2 * step) : 0;
    EXPECT_NEAR(directions[3 * k + 1], std::sqrt(0.75), 1e-6);
    EXPECT_NEAR(std::hypot(directions[3 * k], directions[3 * k + 2]), 0.5, 1e-6);
    worst =
        std::max(worst, std::abs(std::atan2(directions[3 * k], directions[3 * k + 2]) - std::atan(slope)));
  }
  std::cout << "fibres are inclined by " << worst << " rad to the surfaces at most\n";
  // As much as the direction has of the normals (AreTangentialToTheSurfaces) on cells of this size.
  EXPECT_LT(worst, 5e-3);
}

TEST(WallDirectionsInAStenosis, AreUnitVectorsInTheHalfPlane) {
  const Problem problem = problem_of(stenosis(2, test_support::triangle6), Element::quadratic);
  const Tables tables = tabulate(problem);
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  for (const WallTable& table : tables.wall) {
    const double x = share(random), y = (1 - x) * share(random);
    const auto axes = tables.axes.at(table.cell, {x, y});
    // The length, two quotients and the product are rounded: five times 2.2e-16 at most.
    EXPECT_NEAR(dot(axes.axial, axes.axial), 1, 1.1e-15);
    EXPECT_EQ(axes.axial[1], 0);
    EXPECT_GT(axes.axial[2], 0.9) << "towards the outlet";
    EXPECT_EQ(axes.circumferential, (Vector<double>{0, 1, 0}));
  }
}

/// Axial directions at all quadrature points of the wall.
std::vector<Vector<double>> directions(const Mesh& mesh) {
  const Problem problem = problem_of(mesh, Element::quadratic);
  std::vector<Vector<double>> all;
  for (const WallTable& table : tabulate(problem).wall)
    for (const WallPoint& point : table.points) all.push_back(point.axes.axial);
  return all;
}

// They do not depend on the unit of length, on layers, or on the blood; a vessel turned end for end has them
// reversed.
TEST(WallDirectionsInAStenosis, BelongToTheShapeOfTheWall) {
  const Mesh mesh = stenosis(2);
  const auto given = directions(mesh);
  const auto expect_equal = [&](const Mesh& changed, double factor) {
    const auto found = directions(changed);
    ASSERT_EQ(found.size(), given.size());
    // Round-off of a system of some 500 equations.
    for (std::size_t k = 0; k < given.size(); ++k)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[k][i], factor * given[k][i], 1e-11);
  };
  expect_equal(mapped(mesh, [](double r, double z) -> Point { return {1000 * r, 1000 * z - 7}; }), 1);

  Mesh layered = mesh;
  for (std::size_t k = 0; k < layered.cells.size(); ++k) layered.cells[k].layer = static_cast<int>(k % 2);
  expect_equal(layered, 1);

  Mesh turned = mesh;
  for (Edge& edge : turned.edges) {
    if (edge.boundary == Boundary::wall_inlet)
      edge.boundary = Boundary::wall_outlet;
    else if (edge.boundary == Boundary::wall_outlet)
      edge.boundary = Boundary::wall_inlet;
  }
  expect_equal(turned, -1);

  test_support::Stenosis with_blood;
  with_blood.type = test_support::quadrilateral9;
  with_blood.blood_cells = 3;
  with_blood.wall_cells = 2;
  with_blood.axial_cells = 64;
  expect_equal(parse_gmsh(test_support::stenosis_mesh(with_blood).text("4.1"), "with blood"), 1);
}

void expect_refusal(const std::function<void()>& work, const std::string& reason) {
  try {
    work();
    ADD_FAILURE() << "accepted";
  } catch (const InvalidInput& refused) {
    EXPECT_NE(std::string(refused.what()).find(reason), std::string::npos) << refused.what();
  }
}

TEST(WallDirectionsInAStenosis, NeedBothEndFaces) {
  Mesh mesh = stenosis(2);
  for (Edge& edge : mesh.edges)
    if (edge.boundary == Boundary::wall_outlet || edge.boundary == Boundary::wall_inlet)
      edge.boundary = Boundary::outer;
  expect_refusal([&] { directions(mesh); }, "it takes both end faces");
}

// A cell with all of its corners on an end face: linear functions are constant there. No law without fibres
// asks for a direction.
TEST(WallDirectionsInAStenosis, OfFibersNeedCellsThatLeaveTheEndFace) {
  Mesh mesh = stenosis(2, test_support::triangle3);
  for (Edge& edge : mesh.edges) {
    if (edge.boundary == Boundary::wall_outlet) edge.boundary = Boundary::outer;
  }
  // One triangle's sides become the whole of the end face.
  const int cell = mesh.edges.front().cell;
  for (int side = 0; side < mesh.sides(); ++side) mesh.edges.push_back({cell, side, Boundary::wall_outlet});
  Problem problem = problem_of(std::move(mesh), Element::linear);
  const Tables tables = tabulate(problem);
  int open = 0;
  for (const WallTable& table : tables.wall)
    for (const WallPoint& point : table.points) {
      EXPECT_EQ(point.axes.circumferential, (Vector<double>{0, 1, 0}));
      if (std::isnan(point.axes.axial[0])) {
        EXPECT_EQ(table.cell, cell);
        ++open;
      }
    }
  EXPECT_GT(open, 0);
  problem.laws = test_support::vessel(Mesh{problem.mesh}, Element::linear, {"wall.law=EXP1+EXP2-FS"}).laws;
  expect_refusal([&] { tabulate(problem); }, "write mesh.element = \"quadratic\"");
}

}  // namespace
}  // namespace tunica::axisym
