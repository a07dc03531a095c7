// SPDX-License-Identifier: GPL-3.0-or-later
// Every scene that comes with Tunica, run as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/observables/result.hpp"
#include "core/units.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

namespace fs = std::filesystem;
using test_support::Ended;
using test_support::TemporaryFolder;

const fs::path scenes = fs::path(TUNICA_SOURCE_DIR) / "scenes";

/// DESIGN, section 4, written out.
constexpr const char* header =
    "time[s],inflow[cm3/s],outflow[cm3/s],pressure[dyn/cm2],outlet_pressure[dyn/cm2],"
    "transmural_pressure[dyn/cm2],"
    "radial_displacement.P1[cm],fiber_angle.P1[deg],fiber_stretch.P1[1],recruitment.P1[1],von_mises.P1[dyn/"
    "cm2],"
    "radial_displacement.P2[cm],fiber_angle.P2[deg],fiber_stretch.P2[1],recruitment.P2[1],von_mises.P2[dyn/"
    "cm2],"
    "radial_displacement.P3[cm],fiber_angle.P3[deg],fiber_stretch.P3[1],recruitment.P3[1],von_mises.P3[dyn/"
    "cm2],"
    "radial_displacement.P4[cm],fiber_angle.P4[deg],fiber_stretch.P4[1],recruitment.P4[1],von_mises.P4[dyn/"
    "cm2]";

std::vector<std::string> shipped() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(scenes))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

bool is_torus(const std::string& name) {
  return read_scene(scenes / (name + ".toml")).text("geometry.kind") == "torus";
}
/// Bent arteries: tori, and the mesh in space.
bool is_bent(const std::string& name) {
  return is_torus(name) || name == "tapering_bend";
}

class ShippedScene : public testing::TestWithParam<std::string> {
 protected:
  fs::path file() const { return scenes / (GetParam() + ".toml"); }
  /// The program's arguments. Bent arteries take minutes: a beat of a third of the bend, in few cells, does,
  /// or one in linear elements.
  std::vector<std::string> arguments(const fs::path& out) const { return arguments(file(), out); }
  static std::vector<std::string> arguments(const fs::path& scene, const fs::path& out) {
    std::vector<std::string> all{"run", scene, "--out", out, "--quiet"}, settings;
    if (is_torus(GetParam()))
      settings = {"geometry.bend_angle=60",   "mesh.axial_cells=6",  "mesh.wall_cells=1",
                  "mesh.blood_cells=1",       "mesh.around_cells=8", "time.beats=1",
                  "output.field_interval=0.4"};
    else if (is_bent(GetParam()))
      settings = {"mesh.element=linear", "time.step=0.02", "output.field_interval=0.4"};
    for (const std::string& setting : settings) {
      all.emplace_back("--set");
      all.push_back(setting);
    }
    return all;
  }
  TemporaryFolder folder_;
};

TEST_P(ShippedScene, RunsToItsEndWithTheColumnsOfTheContract) {
  const fs::path out = folder_.path() / "results";
  const Ended ended = test_support::tunica(arguments(out), folder_.path());
  ASSERT_EQ(ended.code, 0) << ended.errors;
  EXPECT_EQ(ended.output, "");
  EXPECT_EQ(ended.errors, "");
  const std::string csv = test_support::read_text(out / "observables.csv");
  const std::string columns = csv.substr(0, csv.find('\n'));
  // A tier's own columns follow.
  EXPECT_EQ(columns.substr(0, std::string(header).size()), header);
  EXPECT_EQ(columns.size() > std::string(header).size(), is_bent(GetParam()));
  EXPECT_EQ(test_support::broken_file(out), "");
  EXPECT_TRUE(fs::exists(out / "report.html"));

  const StoredResult stored = read_result(out);
  EXPECT_EQ(stored.record.at("converged"), true);
  for (const auto& finding : stored.record.at("findings"))
    EXPECT_EQ(finding.get<std::string>().find("last beat"), std::string::npos) << finding;
  const Scene scene = read_scene(file());
  const bool is_static = scene.text("time.mode") == "static";
  const bool needs_mesh = is_static || scene.text("geometry.kind") == "mesh" || GetParam() == "elastic_tube";
  EXPECT_EQ(stored.record.at("tier"), is_bent(GetParam()) ? "full3d" : needs_mesh ? "axisym" : "lumped");
  for (const char* key : {"unknowns", "steps", "newton_iterations"})
    EXPECT_GT(stored.record.at(key), 0) << key;
  const observables::Table& table = stored.result.observables;
  const std::string law = scene.text("wall.law");
  const bool has_fibers = law.find("S") != std::string::npos && law.find("EXP1+") == 0;
  for (const auto& column : table.columns()) {
    const bool of_fibers = column.name.starts_with("fiber_") || column.name.starts_with("recruitment");
    // A layered wall may have fibres at some points only.
    if (of_fibers && GetParam() == "layered") continue;
    // Blood at rest under a given pressure is not computed.
    const bool of_blood =
        column.name == "inflow" || column.name == "outflow" || column.name == "outlet_pressure";
    for (const double value : column.values)
      ASSERT_EQ(observables::is_none(value), (of_fibers && !has_fibers) || (of_blood && is_static))
          << column.name;
  }
  EXPECT_EQ(table.find("time")->values.front(), 0);
}

/// The scenes of an artery in the body: the others are benchmarks, or prescribe the pressure themselves.
class PhysiologicScene : public ShippedScene {
 public:
  static std::vector<std::string> names() {
    std::vector<std::string> all = shipped();
    for (const char* other : {"neo_hookean", "pressure_driven", "elastic_tube", "static_tube"})
      std::erase(all, other);
    std::erase_if(all, is_bent);
    return all;
  }
};

TEST_P(PhysiologicScene, StaysWithinTheBody) {
  const fs::path out = folder_.path() / "results";
  ASSERT_EQ(
      test_support::tunica({"run", file(), "--out", out, "--quiet", "--no-report"}, folder_.path()).code, 0);
  EXPECT_FALSE(fs::exists(out / "report.html"));
  const observables::Table table = read_result(out).result.observables;
  const auto& time = table.find("time")->values;
  const double end = time.back();
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double u1 = table.find("radial_displacement.P1")->values[k];
    const double u4 = table.find("radial_displacement.P4")->values[k];
    if (time[k] < 0.5 * end) continue;
    const double pressure = table.find("pressure")->values[k] / mmhg;
    // Mean flow times resistance is 94 mmHg; the waveform is 0.77 to 1.44 of its mean.
    EXPECT_GT(pressure, 70) << time[k];
    EXPECT_LT(pressure, 140) << time[k];
    // The wall thins: it is nearly incompressible.
    EXPECT_GT(u1, u4);
    EXPECT_GT(u4, 0);
    EXPECT_LT(u1, 0.033);
    const double transmural = table.find("transmural_pressure")->values[k] / mmhg;
    EXPECT_GT(transmural, 0);
    EXPECT_LT(transmural, pressure);
  }
}

TEST_P(ShippedScene, GivesTheSameResultFromItsCompleteText) {
  const Ended described = test_support::tunica({"scene", file()}, folder_.path());
  ASSERT_EQ(described.code, 0) << described.errors;
  const fs::path complete = folder_.path() / (GetParam() + ".toml");
  std::ofstream(complete) << described.output;
  for (const char* extension : {".csv", ".msh"})
    if (fs::exists(scenes / (GetParam() + extension)))
      fs::copy_file(scenes / (GetParam() + extension), folder_.path() / (GetParam() + extension));
  EXPECT_EQ(test_support::tunica({"scene", complete}, folder_.path()).output, described.output);

  ASSERT_EQ(test_support::tunica(arguments("a"), folder_.path()).code, 0);
  ASSERT_EQ(test_support::tunica(arguments(complete, "b"), folder_.path()).code, 0);
  // The mean flow, made of the radius in one and given in the other, may differ in its last digit, and
  // steps of the integrator with it: by much less than its errors.
  const observables::Table a = read_result(folder_.path() / "a").result.observables,
                           b = read_result(folder_.path() / "b").result.observables;
  ASSERT_EQ(a.rows(), b.rows());
  for (std::size_t c = 0; c < a.columns().size(); ++c) {
    if (a[c].name.starts_with("recruitment")) continue;  // as good as a step
    double largest = 0, gap = 0;
    for (std::size_t k = 0; k < a.rows(); ++k) {
      if (observables::is_none(a[c].values[k])) continue;
      largest = std::max(largest, std::abs(a[c].values[k]));
      gap = std::max(gap, std::abs(a[c].values[k] - b[c].values[k]));
    }
    EXPECT_LE(gap, 1e-7 * largest) << a[c].name;
  }
}

INSTANTIATE_TEST_SUITE_P(, ShippedScene, testing::ValuesIn(shipped()),
                         [](const auto& instance) { return instance.param; });
INSTANTIATE_TEST_SUITE_P(, PhysiologicScene, testing::ValuesIn(PhysiologicScene::names()),
                         [](const auto& instance) { return instance.param; });

TEST(RunProgram, TellsWhatItDid) {
  const TemporaryFolder folder;
  const Ended ended = test_support::tunica({"run", scenes / "cylinder.toml", "--no-report"}, folder.path());
  EXPECT_EQ(ended.code, 0) << ended.errors;
  EXPECT_NE(ended.output.find("results/cylinder: tier lumped"), std::string::npos) << ended.output;
  EXPECT_TRUE(fs::exists(folder.path() / "results/cylinder/observables.csv"));
  const Ended again =
      test_support::tunica({"run", scenes / "cylinder.toml", "--no-report", "--resume"}, folder.path());
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.output.find("this run is complete"), std::string::npos) << again.output;
}

// A first own artery at the resistance of a much smaller one: what the terminal says is kept in the record.
TEST(RunProgram, RemarksOnAnArteryThatCannotLive) {
  const TemporaryFolder folder;
  const Ended ended = test_support::tunica(
      {"run", scenes / "cylinder.toml", "--out", "r", "--tier", "lumped", "--set", "geometry.radius=0.15",
       "--set", "geometry.thickness=0.03", "--set", "geometry.length=5", "--set", "wall.law=EXP1"},
      folder.path());
  EXPECT_EQ(ended.code, 0) << ended.errors;
  const StoredResult stored = read_result(folder.path() / "r");
  const auto said = [&](const char* list, const char* words) {
    return std::any_of(stored.record.at(list).begin(), stored.record.at(list).end(), [&](const auto& line) {
      const std::string text = line.template get<std::string>();
      return text.find(words) != std::string::npos && ended.errors.find(text) != std::string::npos;
    });
  };
  EXPECT_TRUE(said("remarks", "mean pressure of 1947 mmHg")) << ended.errors;
  EXPECT_TRUE(said("findings", "mmHg in the last beat")) << ended.errors;
  EXPECT_TRUE(said("findings", "does not repeat itself")) << ended.errors;
}

TEST(RunProgram, ReplacesAnEarlierRunsReport) {
  const TemporaryFolder folder;
  EXPECT_EQ(test_support::tunica({"run", scenes / "cylinder.toml", "--out", "r"}, folder.path()).code, 0);
  EXPECT_TRUE(fs::exists(folder.path() / "r/report.html"));
  EXPECT_EQ(
      test_support::tunica({"run", scenes / "cylinder_exp1.toml", "--out", "r", "--no-report"}, folder.path())
          .code,
      0);
  EXPECT_FALSE(fs::exists(folder.path() / "r/report.html"));
}

TEST(RunProgram, WritesSensitivitiesOfWhatIsNamed) {
  const TemporaryFolder folder;
  const Ended ended = test_support::tunica({"run", scenes / "cylinder.toml", "--out", "r", "--set",
                                            "sensitivity.parameters=inlet.flow,geometry.radius"},
                                           folder.path());
  ASSERT_EQ(ended.code, 0) << ended.errors;
  const StoredResult stored = read_result(folder.path() / "r");
  const auto& result = stored.result;
  EXPECT_EQ(result.sensitivities.rows(), result.observables.rows());
  EXPECT_EQ(result.event_sensitivities.rows(), result.events.rows());
  EXPECT_GT(result.events.rows(), 0U);
  // At the end outflow follows inflow but for what the lumen stores: d(outflow)/d(mean flow) is near 0.95 /
  // mean.
  const auto* by_flow = result.sensitivities.find("d(outflow)/d(inlet.flow)");
  ASSERT_NE(by_flow, nullptr);
  EXPECT_NEAR(by_flow->values.back() * 0.1217, result.observables.find("outflow")->values.back(), 0.01);
}

TEST(RunProgram, ListsScenesAndParametersAndHelp) {
  const Ended list = test_support::tunica({"scene", "--list"});
  EXPECT_EQ(list.code, 0);
  for (const auto& name : shipped()) EXPECT_NE(list.output.find(name + ".toml"), std::string::npos) << name;
  // Each scene is introduced by the question that it asks.
  EXPECT_EQ(static_cast<std::size_t>(std::count(list.output.begin(), list.output.end(), '?')),
            shipped().size());
  const Ended parameters = test_support::tunica({"scene", "--parameters"});
  EXPECT_EQ(parameters.output, test_support::read_text(fs::path(TUNICA_SOURCE_DIR) / "docs/parameters.md"));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"--version"}, {"run", "--help"}}) {
    const Ended ended = test_support::tunica(arguments);
    EXPECT_EQ(ended.code, 0);
    EXPECT_NE(ended.output, "");
    EXPECT_EQ(ended.errors, "");
  }
}

TEST(RunProgram, HelpNamesTiersExamplesAndExitCodes) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"}, {"run", "--help"}}) {
    const Ended ended = test_support::tunica(arguments);
    for (const char* word : {"lumped", "axisym", "full3d", "Examples:", "tunica run scenes/cylinder.toml",
                             "mpirun -n 2 tunica run", "Exit codes", "130"})
      EXPECT_NE(ended.output.find(word), std::string::npos) << word << " is not in:\n" << ended.output;
    for (std::size_t begin = 0; begin < ended.output.size();) {
      const auto end = std::min(ended.output.find('\n', begin), ended.output.size());
      EXPECT_LE(end - begin, 120U) << ended.output.substr(begin, end - begin);
      begin = end + 1;
    }
  }
}

struct BadCall {
  const char* name;
  std::vector<std::string> arguments;
  const char* word;  ///< that the message has to hold
};

class BadCalls : public testing::TestWithParam<BadCall> {};

TEST_P(BadCalls, EndWithCodeTwoAndOneLine) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = GetParam().arguments;
  for (auto& argument : arguments)
    if (argument == "SCENE") argument = scenes / "cylinder.toml";
  const Ended ended = test_support::tunica(arguments, folder.path());
  EXPECT_EQ(ended.code, 2) << ended.errors;
  EXPECT_TRUE(test_support::is_one_line(ended.errors)) << ended.errors;
  EXPECT_NE(ended.errors.find(GetParam().word), std::string::npos) << ended.errors;
  EXPECT_EQ(ended.output, "");
  EXPECT_TRUE(fs::is_empty(folder.path())) << "something was written";
}

INSTANTIATE_TEST_SUITE_P(
    , BadCalls,
    testing::Values(
        BadCall{"NoCommand", {}, "--help"}, BadCall{"UnknownCommand", {"walk"}, "--help"},
        BadCall{"NoScene", {"run"}, "scene is required"},
        BadCall{"MissingFile", {"run", "nothing.toml"}, "nothing.toml"}, BadCall{"Folder", {"run", "/"}, "/"},
        BadCall{"UnknownTier", {"run", "SCENE", "--tier", "4d"}, "lumped"},
        BadCall{"SetWithoutValue", {"run", "SCENE", "--set", "tether.stiffness"}, "tether.stiffness"},
        BadCall{"SetUnknownKey", {"run", "SCENE", "--set", "tether.stifness=1"}, "tether.stiffness"},
        BadCall{"SetBadUnit", {"run", "SCENE", "--set", "tether.stiffness=3 mmHg"}, "tether.stiffness"},
        BadCall{"SetOutOfRange", {"run", "SCENE", "--set", "time.beats=0"}, "time.beats"},
        BadCall{"TorusInAHalfPlane",
                {"run", "SCENE", "--tier", "axisym", "--set", "geometry.kind=torus"},
                "not axisymmetric"},
        BadCall{"SceneWithoutFile", {"scene"}, "--list"},
        BadCall{"ReportOfNothing", {"report", "nowhere"}, "nowhere"},
        BadCall{"UnknownOption", {"run", "SCENE", "--fast"}, "--fast"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace tunica
