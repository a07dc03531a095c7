// SPDX-License-Identifier: GPL-3.0-or-later
// A slice of a long artery under pressure, its ends sliding, against the thick ring of the 0D wall.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "core/units.hpp"
#include "tests/mms/thick_ring.hpp"

namespace tunica::axisym {
namespace {

using test_support::ThickRing;

ThickRing::Difference difference(const ThickRing& ring, int cells, CellShape shape = CellShape::quadrilateral,
                                 Element element = Element::quadratic) {
  Problem problem;
  TubeSpec spec;
  spec.radius = ring.inner_radius();
  spec.layers = {ring.thickness()};
  spec.length = 2 * ring.thickness() / cells;
  spec.wall_cells = cells;
  spec.axial_cells = 2;
  spec.blood = false;
  spec.shape = shape;
  problem.mesh = structured_tube(spec);
  problem.discretisation.element = element;
  ring.set_conditions(problem);
  return ring.difference(Assembler(problem), problem.mesh.points);
}

class PaperLaw : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Laws, PaperLaw, testing::ValuesIn(test_support::paper_laws),
                         [](const auto& test) { return "law" + std::to_string(test.index); });

// Stresses are smooth through the wall at 100 mmHg: the fibres of EXP1+EXP2-FS are recruited above. At the
// nodes quadratic elements then converge with order 4, twice their degree (Douglas and Dupont, Numer. Math.
// 22:99, 1974).
TEST_P(PaperLaw, MeetsTheRing) {
  const ThickRing ring(GetParam(), 100 * mmhg);
  const auto coarse = difference(ring, 4), fine = difference(ring, 8);
  EXPECT_LT(coarse.radial, 2e-7);
  EXPECT_NEAR(std::log2(coarse.radial / fine.radial), 4, 0.1);
  EXPECT_LT(fine.axial, 1e-14);
}

// On triangles the nodes are not special: order 3, and 2 with linear elements.
TEST_P(PaperLaw, MeetsTheRingOnTriangles) {
  const ThickRing ring(GetParam(), 100 * mmhg);
  const auto coarse = difference(ring, 8, CellShape::triangle),
             fine = difference(ring, 16, CellShape::triangle);
  EXPECT_LT(fine.radial, 1e-6);
  EXPECT_NEAR(std::log2(coarse.radial / fine.radial), 3, 0.15);
}

TEST_P(PaperLaw, MeetsTheRingWithLinearElements) {
  const ThickRing ring(GetParam(), 100 * mmhg);
  const auto coarse = difference(ring, 16, CellShape::quadrilateral, Element::linear),
             fine = difference(ring, 32, CellShape::quadrilateral, Element::linear);
  EXPECT_LT(fine.radial, 5e-6);
  EXPECT_NEAR(std::log2(coarse.radial / fine.radial), 2, 0.1);
}

TEST(RecruitmentFront, BeyondItTheOrderIsThatOfSmoothStress) {
  const ThickRing ring("EXP1+EXP2-FS", 180 * mmhg);
  const auto coarse = difference(ring, 8), fine = difference(ring, 16);
  EXPECT_LT(fine.radial, 1e-6);
  EXPECT_NEAR(std::log2(coarse.radial / fine.radial), 4, 0.1);
}

// At 140 mmHg the front lies within the wall. The stress bends there, and a quadrature rule is wrong by h^2
// in the cell that holds it, more or less as it lies in the cell: order 2 on the average over meshes.
TEST(RecruitmentFront, CostsOrders) {
  const ThickRing ring("EXP1+EXP2-FS", 140 * mmhg);
  const auto mean_square = [&](int first, int last) {
    double sum = 0;
    for (int cells = first; cells <= last; ++cells) sum += std::pow(difference(ring, cells).radial, 2);
    return sum / (last - first + 1);
  };
  // The root mean squares of two pairs of octaves.
  const double coarse = mean_square(4, 15), fine = mean_square(16, 63);
  EXPECT_NEAR(std::log2(coarse / fine) / 4, 2, 0.5);
  EXPECT_LT(difference(ring, 32).radial, 1e-6);
}

}  // namespace
}  // namespace tunica::axisym
