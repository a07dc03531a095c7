// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "app/report/quantise.hpp"
#include "app/report/report.hpp"
#include "app/report/scene_3d.hpp"
#include "core/error.hpp"
#include "tests/support/bent_tube.hpp"
#include "tests/support/synthetic.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using namespace tunica::report;
using test_support::bent_tube;
using test_support::BentTube;
using test_support::synthetic_run;
using test_support::TemporaryFolder;

namespace {

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

unsigned code(const Quantised& values, int bytes, std::size_t index) {
  unsigned found = 0;
  for (int k = bytes; k-- > 0;)
    found = found << 8 | static_cast<unsigned char>(values.bytes[bytes * index + k]);
  return found;
}

StoredResult with_tube(const BentTube& tube) {
  StoredResult run = synthetic_run({});
  run.result.fields = bent_tube(tube);
  return run;
}

nlohmann::json scene_of(const std::vector<StoredResult>& runs, std::size_t budget = scene_budget) {
  return nlohmann::json::parse(scene_3d(summarize(runs), budget).json);
}

}  // namespace

TEST(ReportQuantise, IsWithinHalfAStep) {
  std::vector<std::vector<float>> rows(3);
  for (int k = 0; k < 3000; ++k) rows[k % 3].push_back(static_cast<float>(-3 + 40 * std::sin(0.37 * k)));
  for (const int bytes : {1, 2}) {
    const Span range = span_of(rows);
    const Quantised made = quantise(rows, range, bytes);
    EXPECT_NEAR(made.step, (range.highest - range.lowest) / (bytes == 1 ? 254 : 65534), 1e-12);
    std::size_t index = 0;
    // Single precision in, so that half a step and its rounding bound the error.
    for (const auto& row : rows)
      for (const float value : row)
        EXPECT_LE(std::abs(made.lowest + made.step * code(made, bytes, index++) - value), 0.5001 * made.step);
  }
}

TEST(ReportQuantise, NoValueHasACodeOfItsOwn) {
  const Quantised made = quantise({{1, missing, 3}}, {1, 3}, 2);
  EXPECT_EQ(code(made, 2, 0), 0U);
  EXPECT_EQ(code(made, 2, 1), 0xffffU);
  EXPECT_EQ(code(made, 2, 2), 0xfffeU);
  const Quantised same = quantise({{5, 5}}, span_of({{5, 5, missing}}), 1);
  EXPECT_EQ(same.lowest, 5);
  EXPECT_EQ(same.step, 0);
  EXPECT_EQ(same.bytes, std::string(2, '\0'));
  EXPECT_EQ(quantise({{-9, 9}}, {0, 1}, 1).bytes, std::string("\0\xfe", 2));
  EXPECT_THROW(quantise({{1}}, {0, 1}, 3), std::logic_error);
}

TEST(ReportQuantise, AFewOutliersDoNotTakeTheColours) {
  std::vector<float> row;
  for (int k = 0; k < 1000; ++k) row.push_back(static_cast<float>(k) / 1000);
  EXPECT_EQ(telling_span({row}).highest, span_of({row}).highest);
  row.push_back(50);
  row.push_back(missing);
  EXPECT_NEAR(telling_span({row}).highest, 0.995, 0.002);
  EXPECT_EQ(span_of({row}).highest, 50);
}

TEST(ReportQuantise, Base64) {
  // The test vectors of RFC 4648, section 10.
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(ReportScene, ReportsWithoutFieldsInSpaceHaveNoLibrary) {
  EXPECT_EQ(make_report({synthetic_run({})}).find("three"), std::string::npos);
  StoredResult plane = with_tube({});
  for (auto& series : plane.result.fields) series.mesh.shape = observables::CellShape::quadrilateral;
  EXPECT_EQ(make_report({plane}).find("three"), std::string::npos);
  EXPECT_NE(make_report({with_tube({})}).find("var THREE="), std::string::npos);
}

TEST(ReportScene, SpeaksInTheReportsUnits) {
  const auto scene = scene_of({with_tube({}), synthetic_run({})});
  ASSERT_EQ(scene["runs"].size(), 1U);
  const auto& parts = scene["runs"][0]["parts"];
  const auto field = [&](int part, const std::string& name) {
    for (const auto& one : parts[part]["fields"])
      if (one["name"] == name) return one;
    return nlohmann::json();
  };
  EXPECT_EQ(parts[0]["name"], "blood");
  EXPECT_EQ(field(0, "pressure")["unit"], "mmHg");
  EXPECT_NEAR(field(0, "pressure")["range"][0].get<double>(), 80, 1e-5);
  EXPECT_NEAR(field(0, "pressure")["range"][1].get<double>(), 120, 1e-5);
  EXPECT_EQ(field(1, "von_mises")["label"], "Von Mises stress");
  EXPECT_EQ(field(1, "von_mises")["unit"], "10⁵ dyn/cm²");
  // 8e5 dyn/cm2 times 1.3, on the inside of the bend at mid-beat.
  EXPECT_NEAR(field(1, "von_mises")["range"][1].get<double>(), 10.4, 1e-5);
  // A vector is shown by its length, a direction not at all.
  EXPECT_NEAR(field(0, "velocity")["range"][1].get<double>(), 60, 1e-5);
  EXPECT_TRUE(field(1, "fiber_direction").is_null());
  EXPECT_TRUE(field(1, "recruitment")["has_gaps"].get<bool>());
  EXPECT_FALSE(field(1, "fiber_stretch")["has_gaps"].get<bool>());
}

TEST(ReportScene, StaysWithinItsBudget) {
  const std::vector<StoredResult> runs{with_tube({.frames = 17}), with_tube({.frames = 9})};
  const auto whole = scene_3d(summarize(runs));
  EXPECT_TRUE(whole.notes.empty());
  for (const double share : {0.8, 0.5, 0.3}) {
    const auto budget = static_cast<std::size_t>(share * static_cast<double>(whole.json.size()));
    const auto less = scene_3d(summarize(runs), budget);
    // Names and numbers beside the arrays count for little.
    EXPECT_LT(less.json.size(), budget + 10000);
    EXPECT_FALSE(less.notes.empty());
    const auto times = scene_of(runs, budget)["runs"][0]["times"];
    EXPECT_EQ(times.back(), 0.8) << "the end is shown";
    if (share > 0.7) {
      EXPECT_EQ(times.size(), 17U);
    }
  }
  const auto none = scene_3d(summarize(runs), 1000);
  EXPECT_TRUE(none.json.empty());
  EXPECT_NE(viewer_section(none).find("too many cells"), std::string::npos);
}

TEST(ReportScene, PeakFlowIsShownHoweverFewTimesAre) {
  StoredResult run = synthetic_run({.beats = 1});
  run.result.fields = bent_tube({.frames = 17});
  for (auto& series : run.result.fields) series.frames[5].time = 0.2112;
  const auto budget =
      static_cast<std::size_t>(0.3 * static_cast<double>(scene_3d(summarize({run})).json.size()));
  const auto scene = scene_of({run}, budget)["runs"][0];
  const auto times = scene["times"].get<std::vector<double>>();
  EXPECT_LT(times.size(), 17U);
  EXPECT_EQ(std::count(times.begin(), times.end(), 0.2112), 1);
  EXPECT_NEAR(scene["peak"].get<double>(), 0.2112, 1e-5);
  EXPECT_EQ(scene["beat"], nlohmann::json({0.0, 0.8}));
  // Each time has its values: 2 bytes for each component of each place.
  const auto& part = scene["parts"][0];
  const std::size_t places = part["points"].get<std::string>().size() / 4 * 3 / 12;
  const std::size_t bytes = part["displacement"]["data"].get<std::string>().size() / 4 * 3;
  EXPECT_NEAR(static_cast<double>(bytes), 6.0 * static_cast<double>(places * times.size()),
              6.0 * static_cast<double>(times.size()));
}

TEST(ReportScene, FieldsComeFromTheRunsFolderToo) {
  const TemporaryFolder folder;
  StoredResult run = with_tube({.bend = 0, .is_quarter = true});
  const auto direct = scene_of({run});
  write_result(folder.path(), parse_scene("[geometry]\n", "made", "."), run.result);
  run.result.fields.clear();
  run.folder = folder.path();
  const auto stored = scene_of({run});
  EXPECT_EQ(stored["runs"][0]["parts"][1]["mirrored"], nlohmann::json({true, true}));
  for (std::size_t part = 0; part < 2; ++part)
    for (const auto& [key, value] : direct["runs"][0]["parts"][part].items()) {
      // Zeros of points lose their sign on the way.
      if (key != "points") {
        EXPECT_TRUE(stored["runs"][0]["parts"][part][key] == value) << part << key;
      }
    }

  write_whole(folder.path() / "fields/wall.xdmf", "<Topology TopologyType=\"Hexahedron\"");
  EXPECT_THROW(make_report({run}), InvalidInput);
}
