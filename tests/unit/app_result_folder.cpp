// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <set>

#include "app/result_folder.hpp"

namespace tunica {
namespace {

std::string folder(const std::vector<std::string>& overrides, const std::vector<std::string>& parts = {}) {
  return result_folder("cylinder", parts, overrides).string();
}

TEST(ResultFolder, TellsWhatTheCommandSays) {
  EXPECT_EQ(folder({}), "results/cylinder");
  EXPECT_EQ(folder({"wall.law=EXP1"}), "results/cylinder-wall.law=EXP1");
  EXPECT_EQ(folder({}, {"axisym"}), "results/cylinder-axisym");
  EXPECT_EQ(folder({" time.beats = 4 ", "accuracy.tolerance=0.1%"}, {"verify"}),
            "results/cylinder-verify-accuracy.tolerance=0.1%-time.beats=4");
}

TEST(ResultFolder, IsTheSameForTheSameScene) {
  EXPECT_EQ(folder({"time.beats=4", "wall.law=EXP1"}), folder({"wall.law=EXP1", "time.beats=4"}));
  EXPECT_EQ(folder({"time.beats=3", "time.beats=4"}), folder({"time.beats=4"}));
}

TEST(ResultFolder, HasAPlainNameOfItsOwnForEverySetting) {
  const std::string long_value = "wall.families=" + std::string(300, '7');
  std::set<std::string> names;
  const std::vector<std::string> settings{
      "geometry.file=a/b.msh",   "geometry.file=a_b.msh",       "geometry.file=a b.msh",
      "inlet.pressure=100 mmHg", "inlet.pressure=\"100 mmHg\"", long_value,
      long_value + "8",          "geometry.file=../../etc",     "geometry.file=caf\xc3\xa9"};
  for (const auto& setting : settings) {
    const std::string name = folder({setting}).substr(8);
    EXPECT_TRUE(names.insert(name).second) << setting << " shares " << name;
    EXPECT_LE(name.size(), 120U);
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._+-=%,"),
              std::string::npos)
        << name;
  }
}

// File systems take 255 bytes.
TEST(ResultFolder, BoundsLongNamesOfScenesToo) {
  const std::string scene(250, 's');
  EXPECT_EQ(result_folder(scene, {}, {}).filename().string(), scene);
  EXPECT_LE(result_folder(scene, {"axisym"}, {"time.beats=3"}).filename().string().size(), 120U);
  EXPECT_NE(result_folder(scene, {}, {"time.beats=3"}), result_folder(scene, {}, {"time.beats=4"}));
}

}  // namespace
}  // namespace tunica
