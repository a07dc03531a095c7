// SPDX-License-Identifier: GPL-3.0-or-later
// Cells along the artery by the waves in it, and the meshes that lead to a fine one.
#include "core/coupled/cell_counts.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/coupled/waves.hpp"
#include "core/element/grading.hpp"
#include "core/radial/from_scene.hpp"
#include "core/radial/wall_curve.hpp"
#include "tests/support/pressure_pulse.hpp"

namespace tunica::coupled {
namespace {

using test_support::PressurePulse;

int along(const Scene& scene) {
  CellCounts counts = cell_counts(scene);
  take_given(scene, counts);
  return counts.axial_cells;
}
/// Without waves.
int at_rest(const std::vector<std::string>& overrides) {
  return along(parse_scene("[time]\nmode = \"static\"\n", "rest", ".", overrides));
}
double longest(const Scene& scene) {
  const int cells = along(scene);
  const auto lines = element::lines_along(scene.number("geometry.length"), cells, end_grading(scene));
  return lines[cells / 2] - lines[cells / 2 - 1];
}

/// A thin tube in plane strain, whose outside is held by springs K: c^2 = [E h/(R (1 - nu^2)) + K R]/(2 rho).
double moens_korteweg(double young, double nu, double thickness, double radius, double spring, double rho) {
  return std::sqrt((young * thickness / radius / (1 - nu * nu) + spring * radius) / (2 * rho));
}

TEST(WaveSpeed, OfAThinTubeIsMoensAndKortewegs) {
  for (const double spring : {0.0, 1e6})
    for (const double rho : {1.0, 1.06}) {
      const auto scene = parse_scene(
          fmt::format("[geometry]\nradius = 0.1\nthickness = 0.001\n[wall]\nlaw = \"linear-elastic\"\n"
                      "young_modulus = 3e6\npoisson_ratio = 0.4\n[tether]\nstiffness = {}\n",
                      spring),
          "tube", ".");
      // The wall's half thickness over the radius is 5e-3.
      EXPECT_NEAR(wave_speed(*radial::ring_model(scene, {}), 0, rho) /
                      moens_korteweg(3e6, 0.4, 0.001, 0.1, spring, rho),
                  1, 1e-2);
    }
}

// Met to a twentieth of stretch, from the slower side.
TEST(WaveSpeed, IsThatAtTheWorkingPressure) {
  for (const char* law : {"wall.law=EXP1", "wall.law=EXP2", "wall.law=EXP1+EXP2-FS"}) {
    const auto scene = parse_scene("[wall]\n", "artery", ".", {law});
    const radial::WallCurve curve(radial::ring_model(scene, {}), {});
    for (const double pressure : {5e4, 1.3e5, 2e5}) {
      const double stretch = curve.stretch_at(pressure);
      const double speed = std::sqrt(0.5 * stretch * curve.pressure_slope(stretch));
      const double met = wave_speed(*radial::ring_model(scene, {}), pressure, 1);
      EXPECT_LT(met, 1.001 * speed) << law << ' ' << pressure;
      EXPECT_GT(met, 0.85 * speed) << law << ' ' << pressure;
    }
  }
}

TEST(Spectrum, OfACosineIsItsHarmonic) {
  const PressurePulse wave(0.5, 0.5);
  const auto scene = wave.scene({"time.start=periodic"});
  double inside = 0, all = 0;
  for (const auto& [frequency, energy] : spectrum(inlet_from_scene(scene), false)) {
    all += energy;
    if (std::abs(frequency - 2) < 1e-9) inside += energy;
  }
  // p (1 - cos)/2, through a spline.
  EXPECT_NEAR(all / std::pow(0.5 * PressurePulse::height, 2), 1, 1e-6);
  EXPECT_NEAR(inside / all, 1, 1e-6);
}

// (1 - cos(2 pi t/d))/2 for 0 < t < d: of its second derivative's root mean square over its own, the
// frequency (1/3)^(1/4)/d = 0.76/d. Eighteen cells in such a wave's length make 1 %.
TEST(CellsAlong, FollowTheLengthOfTheWaves) {
  const double speed = moens_korteweg(3e6, 0.3, 0.01, 0.038, 1e7 * 0.043 / 0.038, 1);
  for (const double duration : {2e-3, 1e-3})
    for (const double tolerance : {1e-2, 1e-3}) {
      const PressurePulse pulse(duration, 20e-3);
      const Scene scene = pulse.scene({fmt::format("accuracy.tolerance={}", tolerance)});
      const double wanted = std::sqrt(tolerance / 0.01) / 18 * speed * duration / std::pow(3, -0.25);
      EXPECT_GT(along(scene), at_rest({fmt::format("accuracy.tolerance={}", tolerance)}));
      // The thick wall's speed is 5 % off the thin one's, the count is even, and the bands of frequencies
      // are 5 % wide.
      EXPECT_NEAR(longest(scene) / wanted, 1, 0.2) << duration << ' ' << tolerance;
    }
}

TEST(CellsAlong, DoNotLookAtWavesLongerThanTheyResolve) {
  for (const double duration : {0.2, 0.05}) {
    const PressurePulse pulse(duration, 0.8);
    EXPECT_EQ(along(pulse.scene({"accuracy.tolerance=1e-3"})), at_rest({"accuracy.tolerance=1e-3"}));
  }
}

TEST(CellsAlong, AreThoseOfTheEndsInEveryStoredScene) {
  for (const auto& file : std::filesystem::directory_iterator(TUNICA_SOURCE_DIR "/scenes")) {
    if (file.path().extension() != ".toml") continue;
    for (const char* tolerance : {"accuracy.tolerance=0.03", "accuracy.tolerance=0.01",
                                  "accuracy.tolerance=0.001", "accuracy.tolerance=1e-4"})
      EXPECT_EQ(along(read_scene(file.path(), {tolerance})),
                along(read_scene(file.path(), {tolerance, "time.mode=static"})))
          << file.path() << ' ' << tolerance;
  }
}

// A jump has waves of every length: cells as short as those that resolve the wall's bending, and no shorter.
TEST(CellsAlong, AreNoShorterThanTheWallsBendingForJumps) {
  const std::vector<std::string> jumps{"inlet.waveform=pulse", "inlet.duration=0.001"};
  const Scene scene = parse_scene("[wall]\n", "jump", ".", jumps);
  const double in_layers = element::bending_layer(0.033, 0.01) / (0.25 * at_rest({}));
  EXPECT_LE(longest(scene), in_layers);
  EXPECT_GT(longest(scene), 0.9 * in_layers);
  // So does a start from rest without a ramp.
  EXPECT_EQ(along(parse_scene("[wall]\n", "rest", ".", {"inlet.waveform=constant", "time.ramp=0"})),
            along(scene));
  EXPECT_EQ(along(parse_scene("[wall]\n", "rest", ".", {"inlet.waveform=constant"})), at_rest({}));
}

TEST(CellsAlong, ThatAreGivenStay) {
  const PressurePulse pulse(1e-3, 20e-3);
  const Scene given = pulse.scene({"mesh.axial_cells=6"});
  EXPECT_EQ(along(given), 6);
  // And so do the steps, which waves shorten.
  EXPECT_DOUBLE_EQ(cell_counts(given).local_tolerance,
                   cell_counts(parse_scene("[wall]\n", "slow", ".")).local_tolerance);
  EXPECT_LT(cell_counts(pulse.scene({})).local_tolerance, 0.5 * cell_counts(given).local_tolerance);
}

TEST(CoarserCounts, AtMostDoubleInEveryDirection) {
  for (const int wall : {1, 2, 3, 5, 7, 13, 31})
    for (const int blood : {1, 3, 9, 11})
      for (const int along : {4, 10, 14, 30, 38, 62, 126}) {
        const std::vector<CellDirection> directions{{wall, 2}, {blood, 2}, {along, 10, 2}, {24, 8, 8}};
        auto meshes = coarser_counts(directions);
        meshes.push_back({wall, blood, along, 24});
        for (std::size_t d = 0; d < directions.size(); ++d) {
          const auto& [finest, least, multiple] = directions[d];
          EXPECT_EQ(meshes.front()[d], std::min(finest, least));
          for (std::size_t k = 0; k + 1 < meshes.size(); ++k) {
            EXPECT_LE(meshes[k][d], meshes[k + 1][d]);
            EXPECT_LE(meshes[k + 1][d], 2 * meshes[k][d]) << "of " << finest << " from " << least;
            EXPECT_EQ(meshes[k][d] % multiple, 0);
          }
        }
      }
}

// By hand: 3 cells from 2 in the two steps that 5 from 2 take pass 2 (1.5)^(1/2) = 2.4, so 3.
TEST(CoarserCounts, OfOddNumbersDivideAsNumbersDo) {
  EXPECT_EQ(coarser_counts({{3, 2}, {5, 2}}), (std::vector<std::vector<int>>{{2, 2}, {3, 4}}));
  EXPECT_EQ(coarser_counts({{7, 2}}), (std::vector<std::vector<int>>{{2}, {4}}));
  EXPECT_EQ(coarser_counts({{2, 2}}), std::vector<std::vector<int>>{});
}

}  // namespace
}  // namespace tunica::coupled
