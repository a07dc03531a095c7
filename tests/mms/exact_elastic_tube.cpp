// SPDX-License-Identifier: GPL-3.0-or-later
// Pulse waves in a thick elastic tube full of blood.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "tests/mms/elastic_tube_waves.hpp"

namespace tunica::axisym {
namespace {

struct Case {
  const char* name;
  test_support::ElasticTube tube;
  double length, frequency;
  int blood_cells, axial_cells;
  double interface_grading;
};
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

class ElasticTube : public testing::TestWithParam<Case> {};

TEST_P(ElasticTube, HasTheExactWaves) {
  const Case& c = GetParam();
  const test_support::ElasticTubeWaves waves(c.tube, c.length, c.frequency);
  Problem problem;
  TubeSpec spec;
  spec.radius = c.tube.radius;
  spec.layers = {c.tube.thickness};
  spec.length = c.length;
  spec.blood_cells = c.blood_cells;
  spec.wall_cells = 2;
  spec.axial_cells = c.axial_cells;
  spec.interface_grading = c.interface_grading;
  problem.mesh = structured_tube(spec);
  waves.set_conditions(problem);
  waves.expect_within(1e-3, Assembler(problem), problem.mesh.points, 256);
}

INSTANTIATE_TEST_SUITE_P(
    Tubes, ElasticTube,
    testing::Values(Case{"artery_5_Hz", {0.033, 0.01, 4e5, 0.45, 1.2, 1.0, 0.035, 1e7}, 0.3, 5, 4, 6, 2},
                    Case{"artery_100_Hz", {0.033, 0.01, 4e5, 0.45, 1.2, 1.0, 0.035, 1e7}, 0.3, 100, 7, 12, 2},
                    Case{"benchmark_2_Hz", {0.5, 0.1, 3e6, 0.3, 1.2, 1.0, 0.03, 0}, 3, 2, 12, 6, 3}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace tunica::axisym
