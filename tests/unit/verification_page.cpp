// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "core/observables/result.hpp"
#include "tests/support/temporary_folder.hpp"
#include "verification/page.hpp"

namespace tunica::verification {
namespace {

TEST(Page, KeepsWhatPeopleWroteAndReplacesItsPart) {
  const test_support::TemporaryFolder folder;
  const auto file = folder.path() / "page.md";
  const std::string first = "# Title\n<!-- runs: written by me, do not edit -->\n";
  const std::string last = "<!-- end of runs -->\nMore.\n";
  write_whole(file, first + "old\n" + last);
  Page(file, "runs", "me").write(markdown_table({"a", "b"}, {{"1", "2"}, {"3", "4"}}));
  const std::string text = test_support::read_text(file);
  EXPECT_EQ(text, first + "\n| a | b |\n|---|---|\n| 1 | 2 |\n| 3 | 4 |\n\n" + last);
}

TEST(Page, RefusesAFileThatIsNotItsOwn) {
  const test_support::TemporaryFolder folder;
  const auto file = folder.path() / "page.md";
  EXPECT_THROW(Page(file, "runs", "me"), std::runtime_error);
  write_whole(file, "<!-- end of runs -->\n<!-- runs: written by me, do not edit -->\n");
  EXPECT_THROW(Page(file, "runs", "me"), std::runtime_error);
}

}  // namespace
}  // namespace tunica::verification
