// SPDX-License-Identifier: GPL-3.0-or-later
// A quarter of a slice of a long artery under pressure, its ends sliding, against the thick ring of the 0D
// wall.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/units.hpp"
#include "full3d/assembler.hpp"
#include "full3d/o_grid.hpp"
#include "tests/mms/thick_ring.hpp"
#include "tests/support/solid_cases.hpp"

namespace tunica::full3d {
namespace {

using test_support::ThickRing;

/// With so many cells through the wall, and eight times as many around the whole of it.
ThickRing::Difference difference(const ThickRing& ring, int cells,
                                 const test_support::SolidCase& kind = test_support::solid_cases[0]) {
  Problem problem;
  VesselSpec spec;
  spec.radius = ring.inner_radius();
  spec.layers = {ring.thickness()};
  spec.length = 2 * ring.thickness() / cells;
  spec.around_cells = 8 * cells;
  spec.wall_cells = cells;
  spec.axial_cells = 2;
  spec.sector = Sector::quarter;
  spec.blood = false;
  spec.shape = kind.shape;
  spec.quadratic = kind.element == Element::quadratic;
  problem.mesh = o_grid_vessel(spec);
  problem.directions = test_support::directions_of(spec);
  problem.discretisation.element = kind.element;
  ring.set_conditions(problem);
  const Ranks ranks;
  return ring.difference(Assembler(problem, ranks), problem.mesh.points);
}

class PaperLaw : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Laws, PaperLaw, testing::ValuesIn(test_support::paper_laws),
                         [](const auto& test) { return "law" + std::to_string(test.index); });

// Stresses are smooth through the wall at 100 mmHg: the fibres of EXP1+EXP2-FS are recruited above. As in two
// dimensions the nodes are special: order 4.
TEST_P(PaperLaw, MeetsTheRing) {
  const ThickRing ring(GetParam(), 100 * mmhg);
  const auto coarse = difference(ring, 3), fine = difference(ring, 6);
  RecordProperty("difference", testing::PrintToString(fine.radial));
  EXPECT_LT(fine.radial, 1e-5);
  EXPECT_NEAR(std::log2(coarse.radial / fine.radial), 4, 0.15);
}

// On tetrahedra they are not, and differ in how cells meet there: the greatest error falls with a little less
// than the order 3 of norms.
TEST_P(PaperLaw, MeetsTheRingOnTetrahedra) {
  const ThickRing ring(GetParam(), 100 * mmhg);
  const auto coarse = difference(ring, 2, test_support::solid_cases[1]),
             fine = difference(ring, 8, test_support::solid_cases[1]);
  RecordProperty("difference", testing::PrintToString(fine.radial));
  EXPECT_LT(fine.radial, 1.5e-5);
  EXPECT_GT(std::log(coarse.radial / fine.radial) / std::log(4.0), 2.5);
}

}  // namespace
}  // namespace tunica::full3d
