// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of the last beat of a run.
#include <gtest/gtest.h>

#include <cmath>

#include "core/observables/beat_remarks.hpp"
#include "core/stored_run.hpp"
#include "core/units.hpp"
#include "tests/support/fake_tier.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

using Lines = std::vector<std::string>;

Scene scene_with(std::vector<std::string> overrides) {
  overrides.emplace_back("output.field_interval=0");
  return parse_scene("[geometry]\n", "some.toml", ".", overrides);
}

/// A run whose pressure (mmHg) and inflow (cm3/s) are functions of time.
template <class Pressure, class Inflow>
Result run_of(const Scene& scene, const Pressure& pressure, const Inflow& inflow) {
  Result result;
  result.observables = observables::standard_table();
  result.record.converged = true;
  const double end = static_cast<double>(scene.integer("time.beats")) * scene.number("inlet.period");
  constexpr int rows = 200;
  for (int k = 0; k <= rows; ++k) {
    observables::Sample sample;
    sample.time = end * k / rows;
    sample.inflow = sample.outflow = inflow(sample.time);
    sample.pressure = pressure(sample.time) * mmhg;
    observables::append(result.observables, sample);
  }
  return result;
}

double beat(double time) {
  return std::sin(2 * M_PI * time / 0.8);
}
double forward(double time) {
  return 0.12 + 0.05 * beat(time);
}

void expect_words(const Lines& lines, const Lines& words) {
  ASSERT_EQ(lines.size(), 1U);
  for (const std::string& word : words)
    EXPECT_NE(lines[0].find(word), std::string::npos) << lines[0] << '\n' << word;
}

TEST(BeatRemarks, NoneOfABeatThatLives) {
  const Scene scene = scene_with({});
  const Result run = run_of(
      scene, [](double time) { return 100 + 25 * beat(time); }, forward);
  EXPECT_EQ(observables::beat_remarks(scene, false, run), Lines{});
}

TEST(BeatRemarks, TellPressuresThatNobodyHas) {
  const Scene scene = scene_with({});
  const Result run = run_of(
      scene, [](double time) { return 1400 + 200 * beat(time); }, forward);
  expect_words(observables::beat_remarks(scene, false, run),
               {"1200 to 1600 mmHg in the last beat", "1400 in the mean", "30 to 200"});
  // Of a pressure that is given the user knows; without a resistance it is no artery's.
  EXPECT_EQ(observables::beat_remarks(scene, true, run), Lines{});
  EXPECT_EQ(observables::beat_remarks(scene_with({"outlet.resistance=0"}), false, run), Lines{});
  const Result peaks = run_of(
      scene, [](double time) { return 150 + 160 * beat(time); }, forward);
  expect_words(observables::beat_remarks(scene, false, peaks), {"-10", "to 310 mmHg"});
}

// From 0.8 to 1.6 s the pressure falls by 50 (exp(-0.8/2) - exp(-1.6/2)) = 11.05 mmHg of 93.5.
TEST(BeatRemarks, TellABeatThatDoesNotRepeatItself) {
  const Scene scene = scene_with({});
  const auto settling = [](double time) { return 60 + 50 * std::exp(-time / 2); };
  const Result run = run_of(scene, settling, forward);
  expect_words(
      observables::beat_remarks(scene, false, run),
      {"does not repeat itself", "the pressure falls by 11 mmHg", "12 % of its largest", "periodic"});
  // The first beat from rest is no other's; one from the limit cycle is.
  const Scene one = scene_with({"time.beats=1"}), cycle = scene_with({"time.beats=1", "time.start=periodic"});
  EXPECT_EQ(observables::beat_remarks(one, false, run_of(one, settling, forward)), Lines{});
  EXPECT_EQ(observables::beat_remarks(cycle, false, run_of(cycle, settling, forward)).size(), 1U);
  // A constant state has no range to be measured by, and repeats itself to the last digit but some.
  const auto still = [](double time) { return 100 + 1e-6 * time; };
  EXPECT_EQ(observables::beat_remarks(scene, false, run_of(scene, still, [](double) { return 0.1; })),
            Lines{});
}

TEST(BeatRemarks, TellAMeanFlowThatLeavesThroughTheInlet) {
  const Scene scene = scene_with({"inlet.waveform=pressure"});
  const auto pressure = [](double) { return 90.0; };
  const Result back = run_of(scene, pressure, [](double time) { return -0.02 + 0.1 * beat(time); });
  expect_words(observables::beat_remarks(scene, true, back), {"leaves through the inlet", "-0.02 cm3/s"});
  const Result to_and_fro = run_of(scene, pressure, [](double time) { return 0.1 * beat(time); });
  EXPECT_EQ(observables::beat_remarks(scene, true, to_and_fro), Lines{});
}

TEST(BeatRemarks, AreAmongTheFindingsOfEveryTiersRun) {
  const test_support::TemporaryFolder folder;
  const Scene scene = scene_with({});
  const test_support::FakeTier tier("some", [](const Scene& asked, const RunControl&) {
    return run_of(
        asked, [](double) { return 500.0; }, forward);
  });
  StoredRun run(tier, scene, folder.path() / "out", false);
  const Result result = run.execute({});
  expect_words(result.record.findings, {"500 to 500 mmHg"});
  run.store(result);
  EXPECT_EQ(read_result(folder.path() / "out").record.at("findings").size(), 1U);
}

// What did not come to its end says so, and nothing else.
TEST(BeatRemarks, NoneOfARunThatWasStopped) {
  const Scene scene = scene_with({});
  Result run = run_of(
      scene, [](double) { return 500.0; }, forward);
  run.record.converged = false;
  EXPECT_EQ(observables::beat_remarks(scene, false, run), Lines{});
}

}  // namespace
}  // namespace tunica
