// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.hpp"
#include "core/observables/result.hpp"
#include "core/run/scene_source.hpp"
#include "tests/support/temporary_folder.hpp"
#include "verification/studies/case_file.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

CaseFile read(const std::string& text) {
  const test_support::TemporaryFolder folder;
  write_whole(folder.path() / "cases.toml", text);
  return CaseFile(folder.path() / "cases.toml");
}

}  // namespace

TEST(CaseFile, MakesACaseOfEachCombination) {
  const CaseFile file = read(R"([[group]]
series = "{law}"
scene = "cylinder"
tier = "axisym"
with = { beats = "2" }
vary = [["law", "EXP1", "EXP2"], ["step", "1e-3", "2e-3", "4e-3"]]
set = ["wall.law={law}", "time.step={step}", "time.beats={beats}"]

[[group]]
scene = "torus"
tier = "full3d"
)");
  const auto& cases = file.group("group");
  ASSERT_EQ(cases.size(), 7U);
  EXPECT_EQ(cases[4].series, "EXP2");
  EXPECT_EQ(cases[4].overrides,
            (std::vector<std::string>{"wall.law=EXP2", "time.step=2e-3", "time.beats=2"}));
  EXPECT_EQ(cases[4].number("step"), 2e-3);
  EXPECT_EQ(cases[6].scene, "torus");
  EXPECT_TRUE(cases[6].overrides.empty());
  EXPECT_THROW(cases[6].value("law"), std::logic_error);
  EXPECT_THROW(file.group("other"), std::logic_error);
}

TEST(CaseFile, SaysWhatIsWrong) {
  const char* wrong[] = {"[[group]]\ntier = \"axisym\"\n",
                         "[[group]]\nscene = \"a\"\ntier = \"b\"\nsets = []\n",
                         "[[group]]\nscene = \"a\"\ntier = \"b\"\nset = [\"x={y}\"]\n",
                         "[[group]]\nscene = \"a\"\ntier = \"b\"\nvary = [[\"x\"]]\n",
                         "[[group]]\nscene = \"a\"\ntier = \"b\"\nset = [1]\n",
                         "group = 1\n",
                         "[[group\n"};
  for (const char* text : wrong) EXPECT_THROW(read(text), InvalidInput) << text;
}

/// Every case of every study is one that a scene can be read for.
TEST(CaseFile, StudiesNameScenesAndKeysThatThereAre) {
  const std::filesystem::path source = TUNICA_SOURCE_DIR;
  int cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source / "verification/studies")) {
    if (entry.path().extension() != ".toml") continue;
    const CaseFile file(entry.path());
    for (const std::string& group : file.groups())
      for (const StudyCase& one : file.group(group)) {
        EXPECT_NO_THROW(run::SceneSource(source / "scenes" / (one.scene + ".toml"), one.overrides))
            << entry.path() << " " << group;
        ++cases;
      }
  }
  EXPECT_GT(cases, 100);
}
