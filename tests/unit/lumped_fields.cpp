// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "tests/support/lumped_runs.hpp"

namespace tunica {
namespace {

using observables::FieldSeries;
using test_support::column;
using test_support::run_lumped;

constexpr double single_precision = 1e-7;

const std::vector<float>& values_of(const FieldSeries& series, std::size_t frame, std::string_view name) {
  for (std::size_t f = 0; f < series.point_fields.size(); ++f)
    if (series.point_fields[f].name == name) return series.frames.at(frame).values[f];
  throw std::runtime_error(fmt::format("no field {}", name));
}

std::vector<std::string> names_of(const FieldSeries& series) {
  std::vector<std::string> names;
  for (const auto& field : series.point_fields) names.push_back(field.name);
  return names;
}

double radius_of(const FieldSeries& series, std::size_t point) {
  return std::hypot(series.mesh.points[point][0], series.mesh.points[point][1]);
}

/// Row of the table at a time of the fields.
std::size_t row_at(const observables::Table& table, double time) {
  const auto& times = column(table, "time");
  for (std::size_t k = 0; k < times.size(); ++k)
    if (std::abs(times[k] - time) < 1e-9) return k;
  throw std::runtime_error("no row at that time");
}

std::vector<double> times_of(const FieldSeries& series) {
  std::vector<double> times;
  for (const auto& frame : series.frames) times.push_back(frame.time);
  return times;
}

}  // namespace

TEST(LumpedFields, AreAtMultiplesOfTheIntervalAtTheEndAndAtTheTimesOfProfiles) {
  const auto coarse = run_lumped({"output.field_interval=0.3"}).fields;
  ASSERT_EQ(coarse.size(), 1U);
  EXPECT_EQ(coarse[0].name, "wall");
  const std::vector<double> expected{0, 0.3, 0.6, 0.9, 1.0112, 1.2, 1.4, 1.5, 1.6};
  const std::vector<double> times = times_of(coarse[0]);
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(times[k], expected[k], 1e-12);
  EXPECT_EQ(times_of(run_lumped({"output.field_interval=5"}).fields[0]),
            (std::vector<double>{0, 0.8 + 0.2112, 0.8 + 0.6, 1.6}));
  // Of the two times of profiles, 0.6 s of the beat is a multiple of 0.05 s anyway.
  EXPECT_EQ(run_lumped(std::vector<std::string>{}).fields[0].frames.size(), 34U);
  EXPECT_EQ(times_of(run_lumped({"output.field_interval=0.8", "output.profile_times=0.3,0.3"}).fields[0]),
            (std::vector<double>{0, 0.8, 0.8 + 0.3, 1.6}));
  EXPECT_TRUE(run_lumped({"output.field_interval=0"}).fields.empty());
}

TEST(LumpedFields, DoNotChangeTheRun) {
  const Result with = run_lumped({"output.field_interval=0.0137"});
  const Result without = run_lumped({"output.field_interval=0"});
  EXPECT_EQ(observables::to_csv(with.observables), observables::to_csv(without.observables));
  // Roots are looked for between stops, so that these may differ by round-off.
  const auto &events = column(with.events, "time"), &expected = column(without.events, "time");
  ASSERT_EQ(events.size(), expected.size());
  for (std::size_t k = 0; k < events.size(); ++k) EXPECT_NEAR(events[k], expected[k], 1e-12);
}

TEST(LumpedFields, FibreFieldsAreThereWithFibresOnly) {
  const std::vector<std::string> common{"displacement", "von_mises", "circumferential_stress",
                                        "radial_stress", "axial_stress"};
  EXPECT_EQ(names_of(run_lumped({"wall.law=EXP1"}).fields[0]), common);
  EXPECT_EQ(names_of(run_lumped({"wall.law=EXP1+EXP2-ZS"}).fields[0]),
            test_support::joined(common, {"recruitment", "fiber_stretch"}));
}

TEST(LumpedFields, AgreeWithTheObservablesAtP1ToP4) {
  // All pictures at the time of a row, that of the profile too.
  const Result result = run_lumped({"output.profile_times=0.211"});
  const FieldSeries& series = result.fields[0];
  for (std::size_t frame = 0; frame < series.frames.size(); ++frame) {
    const std::size_t row = row_at(result.observables, series.frames[frame].time);
    for (int p = 1; p <= observables::wall_points; ++p) {
      const double radius = 0.033 + 0.01 * (p - 1) / 3;
      const auto expected = [&](const char* quantity) {
        return column(result.observables, fmt::format("{}.P{}", quantity, p))[row];
      };
      int found = 0;
      for (std::size_t i = 0; i < series.mesh.points.size(); ++i) {
        if (std::abs(radius_of(series, i) - radius) > 1e-9) continue;
        ++found;
        const auto& position = series.mesh.points[i];
        EXPECT_DOUBLE_EQ(position[2], 0.33);
        const auto& displacement = values_of(series, frame, "displacement");
        const double u = expected("radial_displacement");
        EXPECT_NEAR(displacement[3 * i], u * position[0] / radius, single_precision * u + 1e-12);
        EXPECT_NEAR(displacement[3 * i + 1], u * position[1] / radius, single_precision * u + 1e-12);
        EXPECT_EQ(displacement[3 * i + 2], 0);
        // The table interpolates displacement and slope of the wall to 1e-9 or so, of which stress is
        // some 1e2 times more.
        const double von_mises = expected("von_mises");
        EXPECT_NEAR(values_of(series, frame, "von_mises")[i], von_mises, 1e-6 * von_mises + 1e-2);
        EXPECT_NEAR(values_of(series, frame, "fiber_stretch")[i], expected("fiber_stretch"), 1e-6);
      }
      EXPECT_EQ(found, 32) << "P" << p;
    }
  }
}

// At the lumen the radial stress is the pressure, outside it is the tether's.
TEST(LumpedFields, RadialStressIsInEquilibriumWithWhatIsOutside) {
  for (const char* incompressible : {"wall.incompressible=false", "wall.incompressible=true"}) {
    const Result result =
        run_lumped({incompressible, "output.field_interval=0.2", "output.profile_times=0.211"});
    const FieldSeries& series = result.fields[0];
    for (std::size_t frame = 1; frame < series.frames.size(); ++frame) {
      const std::size_t row = row_at(result.observables, series.frames[frame].time);
      const double pressure = column(result.observables, "pressure")[row];
      const double outside = pressure - column(result.observables, "transmural_pressure")[row];
      const auto& stress = values_of(series, frame, "radial_stress");
      EXPECT_NEAR(stress.front(), -pressure, 1e-5 * pressure) << incompressible;
      EXPECT_NEAR(stress.back(), -outside, 1e-5 * pressure) << incompressible;
    }
  }
}

TEST(LumpedFields, CellsEndWhereLayersEnd) {
  const std::string layers =
      "wall.layers=[{fraction=0.4, law=\"EXP1\"}, {fraction=0.55, law=\"EXP1+EXP2-ZS\"}, {fraction=0.05, "
      "law=\"EXP1\"}]";
  const Result result =
      test_support::run_lumped(parse_scene("[wall]\n" + layers.substr(5) + "\n", "layered", "."));
  const FieldSeries& series = result.fields[0];
  ASSERT_EQ(series.cell_fields.size(), 1U);
  EXPECT_EQ(series.cell_fields[0].name, "layer");
  const double ends[] = {0.033, 0.037, 0.0425, 0.043};
  double area = 0;
  for (std::size_t cell = 0; 4 * cell < series.mesh.cells.size(); ++cell) {
    const int layer = series.cell_fields[0].values[cell];
    double twice_area = 0;
    for (int k = 0; k < 4; ++k) {
      const int corner = series.mesh.cells[4 * cell + k], next = series.mesh.cells[4 * cell + (k + 1) % 4];
      EXPECT_GT(radius_of(series, corner), ends[layer] - 1e-9);
      EXPECT_LT(radius_of(series, corner), ends[layer + 1] + 1e-9);
      const auto &a = series.mesh.points[corner], &b = series.mesh.points[next];
      twice_area += a[0] * b[1] - a[1] * b[0];
      const bool has_fibers = layer == 1;
      for (const char* field : {"recruitment", "fiber_stretch"})
        EXPECT_EQ(std::isnan(values_of(series, 3, field)[corner]), !has_fibers) << field << layer;
      EXPECT_FALSE(std::isnan(values_of(series, 3, "von_mises")[corner]));
    }
    EXPECT_GT(twice_area, 0) << "a cell is turned over";
    area += twice_area / 2;
  }
  // Polygons of 32 corners instead of circles: n/2 sin(2 pi/n) of r^2.
  EXPECT_NEAR(area, 16 * std::sin(2 * M_PI / 32) * (0.043 * 0.043 - 0.033 * 0.033), 1e-12);
}

// Radial stress passes through the boundary between layers, circumferential stress jumps there.
TEST(LumpedFields, KeepTheJumpOfStressBetweenLayers) {
  const FieldSeries series =
      run_lumped(parse_scene("[wall]\nlayers=[{fraction=0.5, law=\"EXP1\"}, {fraction=0.5, law=\"EXP1\", "
                             "stiffness=3e5}]\n",
                             "layered", "."))
          .fields[0];
  std::vector<std::size_t> boundary;
  for (std::size_t i = 0; i < series.mesh.points.size(); i += 32)
    if (std::abs(radius_of(series, i) - 0.038) < 1e-9) boundary.push_back(i);
  ASSERT_EQ(boundary.size(), 2U);
  const auto jump = [&](const char* field, std::size_t components = 1) {
    const auto& values = values_of(series, 20, field);
    return std::abs(values[components * boundary[1]] - values[components * boundary[0]]);
  };
  const double pressure = std::abs(values_of(series, 20, "radial_stress")[0]);
  EXPECT_LT(jump("radial_stress"), 1e-5 * pressure);
  EXPECT_LT(jump("displacement", 3), 1e-9);
  EXPECT_GT(jump("circumferential_stress"), 0.1 * pressure);
}

}  // namespace tunica
