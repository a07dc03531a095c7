// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes and meshes that the axisymmetric tier cannot compute: refused before any work with one line that
// helps, by the library and, for some of each kind, by the program.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "axisym/axisym_tier.hpp"
#include "core/error.hpp"
#include "tests/support/bad_meshes.hpp"
#include "tests/support/bad_scenes.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

namespace fs = std::filesystem;
using test_support::bad_axisym_scenes;
using test_support::bad_meshes;
using test_support::BadMesh;
using test_support::BadScene;
using test_support::Ended;
using test_support::TemporaryFolder;

void expect_words(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' is not in: " << message;
}

class BadAxisymScenes : public testing::TestWithParam<BadScene> {};

TEST_P(BadAxisymScenes, AreRefusedWithOneLineThatHelps) {
  const TemporaryFolder folder;
  // The scene itself is sound: another tier may take it.
  const Scene scene = read_scene(GetParam().prepare(folder.path()), GetParam().overrides);
  const axisym::AxisymTier tier;
  std::string message = tier.refusal(scene);
  EXPECT_EQ(tier.suits(scene), message.empty());
  try {
    if (message.empty()) tier.prepare(scene);
  } catch (const InvalidInput& error) {
    message = error.what();
  }
  ASSERT_FALSE(message.empty()) << "the scene was accepted";
  EXPECT_EQ(message.find_first_of("\r\n"), std::string::npos) << message;
  EXPECT_LT(message.size(), 500U) << message;
  expect_words(message, GetParam().words);
}

INSTANTIATE_TEST_SUITE_P(, BadAxisymScenes, testing::ValuesIn(bad_axisym_scenes()),
                         [](const auto& instance) { return instance.param.name; });

/// Exit code 2, one line on stderr that holds the words, and nothing written.
void expect_refused(const fs::path& scene, const std::vector<std::string>& words) {
  const TemporaryFolder work;
  const Ended ended =
      test_support::tunica({"run", scene, "--tier", "axisym", "--out", "results"}, work.path());
  EXPECT_EQ(ended.code, 2) << ended.errors;
  EXPECT_TRUE(test_support::is_one_line(ended.errors)) << ended.errors;
  EXPECT_EQ(ended.output, "");
  EXPECT_TRUE(fs::is_empty(work.path())) << "something was written";
  expect_words(ended.errors, words);
}

TEST(BadAxisymScenesInProgram, EndWithCodeTwoAndOneLine) {
  for (const char* name : {"mesh_missing", "mesh_in_millimetres", "mesh_a_thousand_times_too_small",
                           "mesh_a_thousand_times_too_large", "mesh_with_layers_that_the_scene_has_not",
                           "torus", "alpha_without_step", "parabola_that_widens", "one_handed_fibres"}) {
    SCOPED_TRACE(name);
    const auto& all = bad_axisym_scenes();
    const auto bad = std::find_if(all.begin(), all.end(), [&](const BadScene& b) { return b.name == name; });
    ASSERT_NE(bad, all.end());
    const TemporaryFolder folder;
    expect_refused(bad->prepare(folder.path()), bad->words);
  }
}

TEST(BadMeshesInProgram, EndWithCodeTwoAndOneLine) {
  for (const char* name : {"empty", "binary_flag", "node_missing", "tetrahedron", "no_area",
                           "crossed_corners", "side_beyond_its_cell", "part_misspelt", "nodes_not_shared",
                           "no_inlet", "no_outer", "open_interface", "ends_swapped"}) {
    SCOPED_TRACE(name);
    const auto& all = bad_meshes();
    const auto bad = std::find_if(all.begin(), all.end(), [&](const BadMesh& b) { return b.name == name; });
    ASSERT_NE(bad, all.end());
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "artery.msh", std::ios::binary) << bad->text;
    const fs::path scene = folder.path() / "bad.toml";
    std::ofstream(scene)
        << "[geometry]\nkind = \"mesh\"\nfile = \"artery.msh\"\nradius = 1\nthickness = 0.5\n";
    expect_refused(scene, bad->words);
  }
}

}  // namespace
}  // namespace tunica
