// SPDX-License-Identifier: GPL-3.0-or-later
// Remarks on numbers that look like another unit's and on loads that no artery lives with.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/scene/scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

using Lines = std::vector<std::string>;

Lines remarks(const std::vector<std::string>& overrides, const std::filesystem::path& folder = ".") {
  return parse_scene("[geometry]\n", "some.toml", folder, overrides).remarks();
}

/// The only remark; fails where there are none or several.
std::string remark(const std::vector<std::string>& overrides, const std::filesystem::path& folder = ".") {
  const Lines lines = remarks(overrides, folder);
  EXPECT_EQ(lines.size(), 1U) << overrides.front();
  return lines.empty() ? "" : lines.front();
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << text << '\n' << word;
}

TEST(SceneSlips, NoneInTheScenesThatComeWithTunica) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TUNICA_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_EQ(read_scene(entry.path()).remarks(), Lines{}) << entry.path();
    ++scenes;
  }
  EXPECT_GT(scenes, 15);
}

struct TypedAndMeant {
  const char* typed;
  const char* meant;  ///< in the remark
};

class UnitSlips : public testing::TestWithParam<TypedAndMeant> {};

TEST_P(UnitSlips, AreAskedAbout) {
  const auto& [typed, meant] = GetParam();
  expect_words(remark({typed}), {"did you mean", meant});
}

INSTANTIATE_TEST_SUITE_P(
    , UnitSlips,
    testing::Values(TypedAndMeant{"outlet.pressure=80", "\"80 mmHg\"?"},
                    TypedAndMeant{"wall.fiber_angle=0.747", "\"0.747 rad\"?"},
                    TypedAndMeant{"blood.viscosity=3.5", "\"3.5 cP\"?"},
                    TypedAndMeant{"blood.viscosity=0.0035", "\"0.0035 Pa s\"?"},
                    TypedAndMeant{"inlet.flow=8", "inlet.flow = \"8 ml/min\"?"},
                    TypedAndMeant{"geometry.radius=0.33", "geometry.radius = \"0.33 mm\"?"},
                    TypedAndMeant{"geometry.thickness=0.1", "\"0.1 mm\"?"},
                    TypedAndMeant{"outlet.resistance=774", "outlet.resistance = \"774 mmHg s/ml\"?"},
                    TypedAndMeant{"wall.stiffness=3.5", "\"3.5 kPa\"?"},
                    TypedAndMeant{"wall.bulk_modulus=0.9", "\"0.9 MPa\"?"},
                    TypedAndMeant{"output.interval=1", "\"1 ms\"?"}));

TEST(SceneSlips, AreNoneWithAUnitOrWhereTheyAreUsual) {
  for (const char* meant :
       {"outlet.pressure=80 dyn/cm2", "outlet.pressure=5 mmHg", "outlet.pressure=0", "outlet.pressure=1e4",
        "wall.fiber_angle=0.747 deg", "wall.fiber_angle=0", "wall.fiber_angle=1", "blood.viscosity=3.5 P",
        "blood.viscosity=0", "blood.viscosity=0.01", "inlet.flow=8 ml/min", "geometry.radius=0.33 mm",
        "inlet.flow=0", "wall.stiffness=2e3"})
    EXPECT_EQ(remarks({meant}), Lines{}) << meant;
}

TEST(SceneSlips, AreNamedWhereTheValueIsRefused) {
  const auto refusal = [](const char* typed) -> std::string {
    try {
      remarks({typed});
      return {};
    } catch (const InvalidInput& error) {
      return error.what();
    }
  };
  expect_words(refusal("blood.density=1060"), {"out of range", "did you mean \"1060 kg/m3\"?"});
  expect_words(refusal("geometry.radius=330"), {"out of range", "did you mean \"330 um\"?"});
  expect_words(refusal("accuracy.tolerance=1"), {"out of range", "did you mean \"1%\"?"});
  expect_words(refusal("time.step=1"), {"no shorter than the period", "did you mean \"1 ms\"?"});
  EXPECT_EQ(refusal("blood.density=1060 g/cm3").find("did you mean"), std::string::npos);
}

// R Q = 1.032e6 x 4.25 (0.15/0.195)^2 dyn/cm2 = 1946.6 mmHg; 100 mmHg over that flow is 5.301e4 dyn s/cm5.
TEST(SceneLoads, NameTheMeanPressureAndTheResistanceOfAFirstOwnArtery) {
  const Lines lines = remarks({"geometry.radius=0.15", "geometry.thickness=0.03", "geometry.length=5"});
  ASSERT_EQ(lines.size(), 1U);
  expect_words(lines[0], {"mean pressure of 1947 mmHg", "30 to 200 mmHg",
                          "100 mmHg would take 5.3e+04 dyn s/cm5", "not the default"});
  EXPECT_EQ(lines[0].find("did you mean"), std::string::npos);
  EXPECT_EQ(remarks({"geometry.radius=0.15", "geometry.thickness=0.03", "outlet.resistance=5.3e4"}), Lines{});
}

// An RCR outlet counts with both resistances, and the pressure beyond them with them: 0.1217 x 3e6 = 274
// mmHg.
TEST(SceneLoads, CountTheWholeOutlet) {
  const std::vector<std::string> rcr{"outlet.kind=rcr", "outlet.resistance=2e6",
                                     "outlet.proximal_resistance=1e6"};
  expect_words(remark(rcr), {"and outlet.proximal_resistance = 3e+06", "mean pressure of 273.9 mmHg",
                             "7.3e+05 dyn s/cm5 beyond a proximal 3.65e+05"});
  expect_words(remark({"outlet.pressure=150 mmHg"}),
               {"mean pressure of 244.2 mmHg", "an outlet.pressure of 150 mmHg"});
  EXPECT_EQ(remark({"outlet.pressure=150 mmHg"}).find("would take"), std::string::npos);
}

TEST(SceneLoads, AreNotJudgedWithoutAResistanceOrUnderAGivenPressure) {
  EXPECT_EQ(remarks({"outlet.resistance=0"}), Lines{});
  EXPECT_EQ(remarks({"inlet.waveform=pressure", "inlet.pressure=500 mmHg", "geometry.radius=0.15"}), Lines{});
}

TEST(SceneLoads, TellAFlowThatLeavesThroughTheInlet) {
  expect_words(remark({"inlet.flow=-0.1"}), {"-0.1 cm3/s", "leaves through the inlet", "sign of inlet.flow"});
}

// Of a file the mean of its curve: (5 + 3 sin) ml/s.
TEST(SceneLoads, KnowTheMeanOfAFile) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.path() / "wave.csv")
      << "time[s],flow[ml/s]\n0,5\n0.125,7.1213\n0.25,8\n0.375,7.1213\n0.5,5\n0.625,2.8787\n0.75,2\n"
         "0.875,2.8787\n1,5\n";
  const std::vector<std::string> scene{"inlet.waveform=wave.csv", "geometry.radius=0.25",
                                       "geometry.thickness=0.05"};
  expect_words(remark(scene, folder.path()), {"a mean flow of 5 cm3/s", "100 mmHg would take 2.67e+04"});
}

TEST(SceneLoads, TellAPulseThatTheRampSwallows) {
  expect_words(
      remark({"inlet.waveform=pulse", "inlet.pressure=10 mmHg"}),
      {"time.ramp = 0.05 s is longer than the pulse, inlet.duration = 0.003 s", "0.89 %", "time.ramp = 0"});
  expect_words(remark({"time.ramp=1.2"}), {"longer than a beat of 0.8 s", "1.5 of the 2 beats"});
  EXPECT_EQ(remarks({"inlet.waveform=pulse", "inlet.pressure=10 mmHg", "time.ramp=0"}), Lines{});
}

TEST(SceneLoads, TellBeatsAMinuteAndAComplianceInMillilitres) {
  expect_words(remark({"inlet.period=75"}), {"75 beats a minute are 0.8 s"});
  expect_words(remark({"outlet.kind=rcr", "outlet.compliance=4e-5"}),
               {"41.3 s", "did you mean \"4e-05 ml/mmHg\"?"});
}

}  // namespace
}  // namespace tunica
