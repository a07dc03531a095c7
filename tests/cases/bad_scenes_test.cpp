// SPDX-License-Identifier: GPL-3.0-or-later
// Malformed scenes, as the library sees them: refused with InvalidInput and one line that helps.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.hpp"
#include "core/scene/scene.hpp"
#include "tests/support/bad_scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

using test_support::bad_scenes;
using test_support::BadScene;

class BadScenes : public testing::TestWithParam<BadScene> {
 protected:
  test_support::TemporaryFolder folder_;
};

/// The refusal of a scene; empty when it is accepted.
std::string refusal_of(const BadScene& bad, const std::filesystem::path& folder) {
  const std::filesystem::path file = bad.prepare(folder);
  try {
    read_scene(file, bad.overrides);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST_P(BadScenes, AreRefusedWithOneLineThatHelps) {
  const std::string message = refusal_of(GetParam(), folder_.path());
  ASSERT_FALSE(message.empty()) << "the scene was accepted";
  for (const char letter : message) {
    const auto code = static_cast<unsigned char>(letter);
    EXPECT_TRUE(code >= 0x20 && code != 0x7f) << "control character " << int{code} << " in: " << message;
  }
  EXPECT_LT(message.size(), 1000U) << message;
  for (const std::string& word : GetParam().words)
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' is not in: " << message;
  RecordProperty("message", message);
}

INSTANTIATE_TEST_SUITE_P(, BadScenes, testing::ValuesIn(bad_scenes()),
                         [](const auto& instance) { return instance.param.name; });

TEST(BadSceneTable, HasAtLeastSixtyScenes) {
  EXPECT_GE(bad_scenes().size(), 60U);
}

}  // namespace
}  // namespace tunica
