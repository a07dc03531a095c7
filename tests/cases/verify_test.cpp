// SPDX-License-Identifier: GPL-3.0-or-later
// tunica verify as a user runs it.
#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

namespace fs = std::filesystem;
using test_support::Ended;
using test_support::is_one_line;
using test_support::TemporaryFolder;

const std::string scene = std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml";

/// What is said to tiers that cannot be compared; nothing is left behind.
std::string refusal(const std::string& tiers) {
  const TemporaryFolder folder;
  const Ended ended = test_support::tunica({"verify", scene, "--tiers", tiers, "--out", "v"}, folder.path());
  EXPECT_EQ(ended.code, 2) << tiers;
  EXPECT_TRUE(is_one_line(ended.errors)) << ended.errors;
  EXPECT_FALSE(fs::exists(folder.path() / "v")) << tiers;
  return ended.errors;
}

TEST(Verify, TiersThatCannotBeComparedAreRefused) {
  EXPECT_NE(refusal("lumped,axysim").find("--tiers axysim: not a tier of this program, which has: lumped"),
            std::string::npos);
  EXPECT_NE(refusal("lumped,lumped").find("lumped is there twice"), std::string::npos);
  EXPECT_NE(refusal("lumped").find("at least two tiers, and here is only lumped"), std::string::npos);
  EXPECT_NE(refusal("auto").find("--tiers auto: not a tier"), std::string::npos);
}

TEST(Verify, ABadSceneIsRefused) {
  const TemporaryFolder folder;
  const Ended ended =
      test_support::tunica({"verify", scene, "--set", "wall.lav=EXP1", "--out", "v"}, folder.path());
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.errors.find("wall.law"), std::string::npos) << ended.errors;
  EXPECT_FALSE(fs::exists(folder.path() / "v"));
}

}  // namespace
}  // namespace tunica
