// SPDX-License-Identifier: GPL-3.0-or-later
// A slice of a long artery under pressure, its ends sliding, against the thick ring of the 0D wall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "core/coupled/newton.hpp"
#include "core/radial/wall_curve.hpp"
#include "core/wall/from_scene.hpp"
#include "tests/support/ring_cases.hpp"

namespace tunica::axisym {
namespace {

constexpr double mmhg = 1333.22387;

class ThickRing {
 public:
  ThickRing(const std::string& law, double pressure)
      : scene_(test_support::scene_with({"wall.law=\"" + law + "\""})),
        curve_(radial::ring_model(scene_, {}), {}),
        pressure_(pressure),
        stretch_(curve_.stretch_at(pressure)) {}

  /// Greatest difference of the radial displacement at any node with so many cells through the wall,
  /// relative to that of the lumen; and the greatest axial displacement.
  struct Difference {
    double radial = 0, axial = 0;
  };
  Difference difference(int cells, CellShape shape = CellShape::quadrilateral,
                        Element element = Element::quadratic) const {
    const auto& ring = curve_.model().ring();
    Problem problem;
    TubeSpec spec;
    spec.radius = ring.inner_radius;
    spec.layers = {ring.thickness};
    spec.length = 2 * ring.thickness / cells;
    spec.wall_cells = cells;
    spec.axial_cells = 2;
    spec.blood = false;
    spec.shape = shape;
    problem.mesh = structured_tube(spec);
    problem.discretisation.element = element;
    problem.laws = {wall::wall_from_scene(SeededScene<double>(scene_))[0].law};
    problem.tether = {ring.tether_stiffness, ring.traction};
    problem.lumen_pressure = [this](double) { return pressure_; };
    for (const auto end : {Boundary::wall_inlet, Boundary::wall_outlet})
      problem.on(end).displacement = {false, true};

    std::vector<double> places;
    for (const auto& point : problem.mesh.points)
      places.push_back(std::clamp((point[0] - ring.inner_radius) / ring.thickness, 0.0, 1.0));
    const auto exact = curve_.model().respond(stretch_, places, false).states;
    const Assembler assembler(problem);
    const Layout& layout = assembler.layout();
    std::vector<double> y(layout.size());
    const auto for_each_node = [&](const auto& visit) {
      for (std::size_t n = 0; n < exact.size(); ++n)
        if (layout.has_displacement(static_cast<int>(n))) visit(static_cast<int>(n), exact[n].displacement);
    };
    for_each_node([&](int node, double u) { y[layout.displacement(node, 0)] = u; });
    coupled::Newton newton(assembler);
    const auto report = newton.solve({}, y, {1e-12, 60});
    EXPECT_TRUE(report.converged) << report.failure;
    Difference greatest;
    const double lumen = (stretch_ - 1) * ring.inner_radius;
    for_each_node([&](int node, double u) {
      greatest.radial = std::max(greatest.radial, std::abs(y[layout.displacement(node, 0)] - u) / lumen);
      greatest.axial = std::max(greatest.axial, std::abs(y[layout.displacement(node, 1)]) / lumen);
    });
    return greatest;
  }

 private:
  Scene scene_;
  radial::WallCurve curve_;
  double pressure_, stretch_;
};

class PaperLaw : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Laws, PaperLaw, testing::ValuesIn(test_support::paper_laws),
                         [](const auto& test) { return "law" + std::to_string(test.index); });

// Stresses are smooth through the wall at 100 mmHg: the fibres of EXP1+EXP2-FS are recruited above. At the
// nodes quadratic elements then converge with order 4, twice their degree (Douglas and Dupont, Numer. Math.
// 22:99, 1974).
TEST_P(PaperLaw, MeetsTheRing) {
  const ThickRing ring(GetParam(), 100 * mmhg);
  const auto coarse = ring.difference(4), fine = ring.difference(8);
  EXPECT_LT(coarse.radial, 2e-7);
  EXPECT_NEAR(std::log2(coarse.radial / fine.radial), 4, 0.1);
  EXPECT_LT(fine.axial, 1e-14);
}

// On triangles the nodes are not special: order 3, and 2 with linear elements.
TEST_P(PaperLaw, MeetsTheRingOnTriangles) {
  const ThickRing ring(GetParam(), 100 * mmhg);
  const auto coarse = ring.difference(8, CellShape::triangle),
             fine = ring.difference(16, CellShape::triangle);
  EXPECT_LT(fine.radial, 1e-6);
  EXPECT_NEAR(std::log2(coarse.radial / fine.radial), 3, 0.15);
}

TEST_P(PaperLaw, MeetsTheRingWithLinearElements) {
  const ThickRing ring(GetParam(), 100 * mmhg);
  const auto coarse = ring.difference(16, CellShape::quadrilateral, Element::linear),
             fine = ring.difference(32, CellShape::quadrilateral, Element::linear);
  EXPECT_LT(fine.radial, 5e-6);
  EXPECT_NEAR(std::log2(coarse.radial / fine.radial), 2, 0.1);
}

TEST(RecruitmentFront, BeyondItTheOrderIsThatOfSmoothStress) {
  const ThickRing ring("EXP1+EXP2-FS", 180 * mmhg);
  const auto coarse = ring.difference(8), fine = ring.difference(16);
  EXPECT_LT(fine.radial, 1e-6);
  EXPECT_NEAR(std::log2(coarse.radial / fine.radial), 4, 0.1);
}

// At 140 mmHg the front lies within the wall. The stress bends there, and a quadrature rule is wrong by h^2
// in the cell that holds it, more or less as it lies in the cell: order 2 on the average over meshes.
TEST(RecruitmentFront, CostsOrders) {
  const ThickRing ring("EXP1+EXP2-FS", 140 * mmhg);
  const auto mean_square = [&](int first, int last) {
    double sum = 0;
    for (int cells = first; cells <= last; ++cells) sum += std::pow(ring.difference(cells).radial, 2);
    return sum / (last - first + 1);
  };
  // The root mean squares of two pairs of octaves.
  const double coarse = mean_square(4, 15), fine = mean_square(16, 63);
  EXPECT_NEAR(std::log2(coarse / fine) / 4, 2, 0.5);
  EXPECT_LT(ring.difference(32).radial, 1e-6);
}

}  // namespace
}  // namespace tunica::axisym
