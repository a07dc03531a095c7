// SPDX-License-Identifier: GPL-3.0-or-later
// Malformed scenes, as a user sees them: exit code 2, one line on stderr, no results.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "tests/support/bad_scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

namespace fs = std::filesystem;
using test_support::bad_scenes;
using test_support::BadScene;

std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

class BadScenesInProgram : public testing::TestWithParam<BadScene> {
 protected:
  test_support::TemporaryFolder scenes_;
  test_support::TemporaryFolder work_;
};

TEST_P(BadScenesInProgram, EndWithCodeTwoOneLineAndNoResults) {
  const fs::path scene = GetParam().prepare(scenes_.path());
  const fs::path errors = scenes_.path() / "stderr.txt";
  std::string command = "cd " + shell_quoted(work_.path()) + " && " + shell_quoted(TUNICA_PROGRAM) + " run " +
                        shell_quoted(scene) + " --out results";
  for (const std::string& text : GetParam().overrides) command += " --set " + shell_quoted(text);
  const fs::path output = scenes_.path() / "stdout.txt";
  command += " >" + shell_quoted(output) + " 2>" + shell_quoted(errors);

  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  const std::string message = test_support::read_text(errors);
  EXPECT_EQ(WEXITSTATUS(status), 2) << message;
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
  EXPECT_TRUE(message.ends_with('\n')) << message;
  for (const std::string& word : GetParam().words)
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' is not in: " << message;
  EXPECT_EQ(test_support::read_text(output), "");
  EXPECT_TRUE(fs::is_empty(work_.path())) << "something was written";
}

INSTANTIATE_TEST_SUITE_P(, BadScenesInProgram, testing::ValuesIn(bad_scenes()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace tunica
