// SPDX-License-Identifier: GPL-3.0-or-later
// The cylinder in space: against the axisymmetric tier on equal cells, its sectors against the whole, and how
// axisymmetric the whole is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <numbers>

#include "tests/support/cylinder_by_law.hpp"

namespace tunica {
namespace {

using test_support::artery;
using test_support::coarsest;
using test_support::CylinderByLaw;
using test_support::difference;
using test_support::joined;
using test_support::range;
using test_support::run_axisym;
using test_support::run_full3d;
using test_support::short_flow;
using test_support::values;

INSTANTIATE_TEST_SUITE_P(, CylinderByLaw,
                         testing::ValuesIn(test_support::laws({"time.step=0.01", "mesh.wall_cells=2",
                                                               "mesh.blood_cells=1", "mesh.axial_cells=8",
                                                               "mesh.around_cells=8"})),
                         test_support::name_of_law);
Scene short_cylinder(const std::string& symmetry, std::vector<std::string> more = {}) {
  // Newton's method leaves a thousandth of the tolerance: here less than what is looked for.
  return artery(
      joined({"mesh.symmetry=" + symmetry, "accuracy.tolerance=1e-4"}, {coarsest, short_flow, more}));
}

TEST(CylinderInSpace, BloodThatAPressureDrivesInKeepsItsProfile) {
  // Without resistance against the energy that it brings, the inlet's profile grows as cos 4 theta, which the
  // half plane has not, from 30 ms on.
  const auto settings = joined({"inlet.profile=natural", "wall.law=EXP1", "inlet.period=0.12", "time.beats=1",
                                "time.step=0.002", "mesh.wall_cells=2", "mesh.blood_cells=1",
                                "mesh.axial_cells=10", "mesh.around_cells=8", "accuracy.tolerance=5%"},
                               {});
  const auto space = run_full3d(artery(settings)).observables;
  const auto plane = run_axisym(artery(settings)).observables;
  for (const char* column : {"pressure", "outflow", "radial_displacement.P1"})
    EXPECT_LT(difference(values(plane, column), values(space, column)), 3e-3 * range(values(plane, column)))
        << column;
}

TEST(CylinderInSpace, SectorsAreTheWhole) {
  const auto whole = run_full3d(short_cylinder("full")).observables;
  for (const char* sector : {"half", "quarter"}) {
    const auto part = run_full3d(short_cylinder(sector)).observables;
    for (const auto& column : whole.columns())
      EXPECT_LT(difference(column.values, values(part, column.name)), 1e-6 * range(column.values) + 1e-300)
          << sector << ' ' << column.name;
  }
}

TEST(CylinderInSpace, IsAxisymmetric) {
  Scene scene =
      parse_scene("[wall]\n", "artery", ".",
                  joined({"mesh.symmetry=full", "output.field_interval=0.1"}, {coarsest, short_flow}));
  const Result result = run_full3d(scene);
  const auto wall = std::find_if(result.fields.begin(), result.fields.end(),
                                 [](const auto& series) { return series.name == "wall"; });
  ASSERT_NE(wall, result.fields.end());
  const auto& displacement = wall->frames.back().values.at(0);
  const auto& points = wall->mesh.points;
  // Radial displacement at equal places of all corners of cells, which are on circles; points between them
  // are within circles.
  struct Corner {
    double r, z, u, turn;
  };
  std::vector<Corner> corners;
  double most = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double x = points[p][0], y = points[p][1], r = std::hypot(x, y);
    const double angle = std::atan2(y, x) / (std::numbers::pi / 4);
    const double ux = displacement[3 * p], uy = displacement[3 * p + 1];
    const double u = (x * ux + y * uy) / r, turn = (x * uy - y * ux) / r;
    most = std::max(most, std::abs(u));
    if (std::abs(angle - std::round(angle)) < 1e-6) corners.push_back({r, points[p][2], u, turn});
  }
  EXPECT_GT(most, 1e-3);
  int compared = 0;
  for (const Corner& a : corners) {
    EXPECT_LT(std::abs(a.turn), 1e-3 * most);
    for (const Corner& b : corners)
      if (std::abs(a.r - b.r) < 1e-6 && std::abs(a.z - b.z) < 1e-6) {
        EXPECT_LT(std::abs(a.u - b.u), 1e-3 * most);
        ++compared;
      }
  }
  EXPECT_GE(compared, 8 * static_cast<int>(corners.size()));
}

}  // namespace
}  // namespace tunica
