// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/scene/unused.hpp"

namespace tunica::scene {
namespace {

const std::vector<Unused> unused{{{"geometry.ends", "time.step"}, "it is round"},
                                 {{"mesh.", "time.step"}, "it has no cells"}};

std::vector<std::string> remarks(const std::string& toml, const std::vector<std::string>& overrides = {}) {
  return remarks_on(parse_scene("[geometry]\nradius = 0.1\n" + toml, "some.toml", ".", overrides), unused);
}

TEST(UnusedKeys, DefaultsAreNotRemarkedOn) {
  EXPECT_TRUE(remarks("").empty());
}

TEST(UnusedKeys, ThoseThatAreSetAreNamedWithTheReasonAndOnce) {
  EXPECT_EQ(remarks("ends = \"sliding\"\n"),
            std::vector<std::string>{"geometry.ends is not used: it is round"});
  EXPECT_EQ(
      remarks("ends = \"clamped\"\n[mesh]\nelement = \"linear\"\nmotion = \"stiffened\"\nwall_cells = 2\n",
              {"time.step=0.1"}),
      (std::vector<std::string>{
          "geometry.ends and time.step are not used: it is round",
          "mesh.element, mesh.motion and mesh.wall_cells are not used: it has no cells"}));
}

}  // namespace
}  // namespace tunica::scene
