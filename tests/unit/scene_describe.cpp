// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <filesystem>

#include "core/scene/scene.hpp"

namespace tunica {
namespace {

void expect_same(const Scene& scene, const Scene& again) {
  EXPECT_EQ(scene.name(), again.name());
  EXPECT_EQ(scene.values(), again.values());
  EXPECT_EQ(scene.count("wall.layers"), again.count("wall.layers"));
  EXPECT_EQ(scene.count("wall.families"), again.count("wall.families"));
}

Scene read_back(const Scene& scene) {
  return parse_scene(describe(scene), scene.name() + ".toml", scene.folder());
}

class ShippedScene : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ShippedScene, ReadsBackFromItsDescription) {
  const Scene scene = read_scene(GetParam());
  EXPECT_TRUE(scene.remarks().empty()) << scene.remarks().front();
  const Scene again = read_back(scene);
  expect_same(scene, again);
  EXPECT_TRUE(again.remarks().empty()) << again.remarks().front();
  EXPECT_EQ(describe(again), describe(read_back(again)));
}

std::vector<std::filesystem::path> shipped_scenes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(TUNICA_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  return files;
}

INSTANTIATE_TEST_SUITE_P(, ShippedScene, testing::ValuesIn(shipped_scenes()),
                         [](const auto& instance) { return instance.param.stem().string(); });

TEST(Description, KeepsEveryDigitAndEveryTable) {
  const Scene scene = parse_scene(R"([wall]
stiffness = 12345.678901234567
activation_squared = 1.6740000000000002
[[wall.families]]
angle = 0.1
[[wall.layers]]
name = "in \"quotes\" \\ back"
fraction = 0.33333333333333331
[[wall.layers.families]]
angle = -12.3456789012345678
weight = 1e-7
[[wall.layers]]
name = "β"
fraction = 0.66666666666666669
law = "neo-Hookean-compressible"
[tether]
stiffness = 1.2345678901234567e11
[sensitivity]
parameters = ["outlet.resistance", "wall.layers[0].stiffness"]
)",
                                  "layered.toml", ".");
  expect_same(scene, read_back(scene));
}

TEST(Description, SaysUnitAndMeaning) {
  const std::string text = describe(parse_scene("[geometry]\n", "small.toml", "."));
  EXPECT_NE(text.find("radius = 0.033 "), std::string::npos);
  EXPECT_NE(text.find("# [cm] Inner radius"), std::string::npos);
  EXPECT_NE(text.find("One of: normal, reference, current."), std::string::npos);
  EXPECT_EQ(text.find("bend_angle"), std::string::npos);
}

}  // namespace
}  // namespace tunica
