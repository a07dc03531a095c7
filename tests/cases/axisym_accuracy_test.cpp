// SPDX-License-Identifier: GPL-3.0-or-later
// What accuracy.tolerance promises of the 2D tier: errors of all observables, relative to their ranges,
// over two beats of the paper's cylinder from rest. tools/study accuracy measures the same against much
// finer runs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/support/axisym_runs.hpp"
#include "tests/support/pressure_pulse.hpp"

namespace tunica {
namespace {

using test_support::artery;
using test_support::run_axisym;

const Result& computed(const std::string& law, const std::string& tolerance) {
  static std::map<std::pair<std::string, std::string>, Result> results;
  const auto [place, is_new] = results.try_emplace({law, tolerance});
  if (is_new) place->second = run_axisym(artery({"wall.law=" + law, "accuracy.tolerance=" + tolerance}));
  return place->second;
}

/// Greatest difference by column, relative to the reference's range; columns that a law has not are left
/// out, and the recruited share, which jumps within milliseconds: its times are compared by tunica verify.
std::map<std::string, double> errors(const Result& result, const Result& reference) {
  std::map<std::string, double> all;
  for (const auto& column : reference.observables.columns()) {
    if (column.name == "time" || column.name.starts_with("recruitment") ||
        observables::is_none(column.values[0]))
      continue;
    const auto [least, greatest] = std::minmax_element(column.values.begin(), column.values.end());
    if (!(*greatest > *least)) continue;
    double largest = 0;
    const auto& ours = test_support::values(result.observables, column.name);
    for (std::size_t k = 0; k < ours.size(); ++k)
      largest = std::max(largest, std::abs(ours[k] - column.values[k]));
    all[column.name] = largest / (*greatest - *least);
  }
  return all;
}

std::string without_signs(const testing::TestParamInfo<std::string>& instance) {
  std::string name = instance.param;
  std::erase_if(name, [](char c) { return c == '+' || c == '-'; });
  return name;
}

class Tolerance : public testing::TestWithParam<std::string> {};

// The reference is ten times more accurate: a tenth of a percent is left for its own error.
TEST_P(Tolerance, OfOnePercentIsKeptInEveryColumn) {
  const auto all = errors(computed(GetParam(), "0.01"), computed(GetParam(), "0.001"));
  EXPECT_GT(all.size(), 12u);
  for (const auto& [column, error] : all) EXPECT_LT(error, 0.009) << column;
}
INSTANTIATE_TEST_SUITE_P(, Tolerance, testing::Values("EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS"),
                         without_signs);

class FineTolerance : public testing::TestWithParam<std::string> {};

// The reference's own error, a third of the tolerance, is left room for. Where a front of recruitment passes
// (FS), the stress has a kink within a cell, and is right to 0.2 % only (tools/study accuracy).
TEST_P(FineTolerance, IsKept) {
  for (const auto& [column, error] : errors(computed(GetParam(), "0.001"), computed(GetParam(), "0.0003"))) {
    const bool jagged = GetParam() == "EXP1+EXP2-FS" && column.starts_with("von_mises");
    EXPECT_LT(error, jagged ? 0.003 : 0.001) << column;
  }
}
INSTANTIATE_TEST_SUITE_P(, FineTolerance, testing::Values("EXP1+EXP2-ZS", "EXP1+EXP2-FS"), without_signs);

// Pulses shorter than the artery, which run to and fro: cells by their length, steps by the error of each. A
// reference has twice the cells along and steps of a fifth of the tolerance.
class PulseTolerance : public testing::TestWithParam<double> {};

TEST_P(PulseTolerance, IsKeptWhateverTheLengthOfTheWave) {
  const test_support::PressurePulse pulse(GetParam(), 6e-3);
  const Result result = run_axisym(pulse.scene({"accuracy.tolerance=0.01"}));
  const int cells = result.record.resolution.at("axial_cells").get<int>();
  const Result reference =
      run_axisym(pulse.scene({"accuracy.tolerance=0.002", "mesh.wall_cells=3", "mesh.blood_cells=2",
                              fmt::format("mesh.axial_cells={}", 2 * cells)}));
  for (const auto& [column, error] : errors(result, reference)) EXPECT_LT(error, 0.01) << column;
}
INSTANTIATE_TEST_SUITE_P(, PulseTolerance, testing::Values(2e-3, 1e-3));

}  // namespace
/// The paper's cylinder with a mesh that moves as said.
Result moving(const std::string& motion, std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"mesh.motion=" + motion, "output.field_interval=0"});
  const Scene scene = parse_scene("[geometry]\n", motion, ".", overrides);
  return axisym::AxisymTier().prepare(scene)->execute({});
}

// Where the mesh's points are is no part of the solution: it is that of harmonic motion to the scene's
// tolerance.
TEST(SectionalMesh, GivesWhatHarmonicMotionGives) {
  const Result harmonic = moving("harmonic", {}), shares = moving("sectional", {});
  ASSERT_TRUE(shares.record.converged) << shares.record.failure;
  EXPECT_LT(shares.record.unknowns, harmonic.record.unknowns);
  for (const char* name : {"pressure", "outflow", "radial_displacement.P1", "von_mises.P1"}) {
    const auto &a = harmonic.observables.find(name)->values, &b = shares.observables.find(name)->values;
    ASSERT_EQ(a.size(), b.size());
    const auto [least, greatest] = std::minmax_element(a.begin(), a.end());
    for (std::size_t k = 0; k < a.size(); ++k)
      EXPECT_NEAR(a[k], b[k], 0.01 * (*greatest - *least)) << name << " row " << k;
  }
}

// Twice the paper's resistance opens the lumen by 0.77 R0, where harmonic motion folds beside the clamped
// end.
TEST(SectionalMesh, BearsWhatFoldsAHarmonicOne) {
  const std::vector<std::string> wide{"outlet.resistance=2.0e6", "accuracy.tolerance=0.003", "time.beats=1"};
  const Result run = moving("sectional", wide);
  EXPECT_TRUE(run.record.converged) << run.record.failure;
  EXPECT_FALSE(moving("harmonic", wide).record.converged);
}

}  // namespace tunica
