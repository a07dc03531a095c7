// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/observables/result.hpp"
#include "tests/support/temporary_folder.hpp"
#include "verification/sweep/points.hpp"

using namespace tunica;
using namespace tunica::sweep;
using Texts = std::vector<std::string>;

namespace {

std::string refusal(const std::string& text) {
  try {
    parse_axis(text);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

std::unique_ptr<Points> listed(const std::string& text) {
  const test_support::TemporaryFolder folder;
  write_whole(folder.path() / "points.csv", text);
  return list_points(folder.path() / "points.csv");
}

}  // namespace

TEST(Axis, GridsIncludeTheirEnds) {
  EXPECT_EQ(parse_axis("outlet.resistance=1e6:2e6:3").values, (Texts{"1000000", "1500000", "2000000"}));
  EXPECT_EQ(parse_axis("tether.stiffness = 1e5:1e7:3:log").values, (Texts{"100000", "1000000", "10000000"}));
  EXPECT_EQ(parse_axis("geometry.radius=0.3 mm:0.5 mm:2").values, (Texts{"0.03", "0.05"}));
  EXPECT_EQ(parse_axis("wall.law=EXP1, EXP2").values, (Texts{"EXP1", "EXP2"}));
  EXPECT_EQ(parse_axis("lumped.compartments=1:9:3").values, (Texts{"1", "5", "9"}));
  EXPECT_EQ(parse_axis("wall.layers[1].fraction=0.2:0.4:2").key, "wall.layers[1].fraction");
}

TEST(Axis, RangesAndDistributionsAreForSamples) {
  const Axis range = parse_axis("outlet.resistance=1e6:2e6");
  EXPECT_TRUE(range.values.empty());
  EXPECT_EQ(range.marginal->text(), "uniform(1000000, 2000000)");
  EXPECT_EQ(parse_axis("outlet.resistance=1e6:2e6:log").marginal->text(), "loguniform(1000000, 2000000)");
  EXPECT_EQ(parse_axis("outlet.resistance=normal(1e6, 1e5)").marginal->text(), "normal(1000000, 100000)");
}

TEST(Axis, SaysWhatIsWrong) {
  EXPECT_EQ(refusal("outlet.resistence=1:2:3"),
            "--vary: unknown key outlet.resistence; did you mean outlet.resistance?");
  EXPECT_NE(refusal("outlet.resistance=2:1:3").find("reversed"), std::string::npos);
  EXPECT_NE(refusal("outlet.resistance=1:1:3").find("empty"), std::string::npos);
  EXPECT_NE(refusal("outlet.resistance=1:2:1").find("at least 2"), std::string::npos);
  EXPECT_NE(refusal("outlet.resistance=1:2:x").find("no whole number"), std::string::npos);
  EXPECT_NE(refusal("outlet.resistance=0:2:3:log").find("above 0"), std::string::npos);
  EXPECT_NE(refusal("outlet.resistance=1 mmHg:2 mmHg:3").find("mmHg"), std::string::npos);
  EXPECT_NE(refusal("outlet.resistance=5").find("LO:HI:N"), std::string::npos);
  EXPECT_NE(refusal("outlet.resistance=1,2,1").find("twice"), std::string::npos);
  EXPECT_NE(refusal("wall.law=1:2:3").find("no numbers"), std::string::npos);
  EXPECT_NE(refusal("output.profile_times=1:2:3").find("list"), std::string::npos);
  EXPECT_NE(refusal("outlet.resistance").find("KEY=LO:HI:N"), std::string::npos);
}

TEST(Points, OfAGridTheLastKeyIsFastest) {
  const auto grid = grid_points({parse_axis("wall.law=EXP1,EXP2"), parse_axis("outlet.resistance=1:3:3")});
  EXPECT_EQ(grid->count(), 6U);
  EXPECT_EQ(grid->values(0), (Texts{"EXP1", "1"}));
  EXPECT_EQ(grid->values(4), (Texts{"EXP2", "2"}));
  EXPECT_EQ(overrides(*grid, grid->values(5)), (Texts{"wall.law=EXP2", "outlet.resistance=3"}));
  EXPECT_THROW(grid_points({parse_axis("outlet.resistance=1:3")}), InvalidInput);
  EXPECT_THROW(grid_points({parse_axis("outlet.resistance=1:3:3"), parse_axis("outlet.resistance=1:3:2")}),
               InvalidInput);
}

TEST(Points, OfASampleFollowTheDistributions) {
  const auto sample =
      sample_points({parse_axis("outlet.resistance=1:3"), parse_axis("tether.stiffness=1:100:log")},
                    uncertainty::Sampling::sobol, 10, 0);
  EXPECT_EQ(sample->values(0), (Texts{"2", "10"}));
  EXPECT_THROW(sample_points({parse_axis("outlet.resistance=1:3:3")}, uncertainty::Sampling::sobol, 10, 0),
               InvalidInput);
  EXPECT_THROW(parse_sample("sobol:0"), InvalidInput);
  EXPECT_THROW(parse_sample("sobol"), InvalidInput);
  EXPECT_THROW(parse_sample("sobel:3"), InvalidInput);
  EXPECT_EQ(parse_sample("lhs:30").second, 30U);
}

TEST(Points, OfAListComeWithUnits) {
  const auto list = listed(
      "geometry.radius[mm], wall.law ,wall.layers[0].fraction\r\n0.3,EXP1,0.25\n\n"
      "0.4,\"EXP2\",1\n");
  EXPECT_EQ(list->count(), 2U);
  EXPECT_EQ(list->values(0), (Texts{"0.03", "EXP1", "0.25"}));
  EXPECT_EQ(list->values(1)[1], "EXP2");
  for (const char* wrong :
       {"geometry.radius\n", "geometry.radius,geometry.length\n1\n", "geometry.raduis\n1\n",
        "geometry.radius[mmHg]\n1\n", "geometry.radius\nx\n", "geometry.radius\n\"1\n",
        "geometry.radius,geometry.radius\n1,1\n", "wall.law[cm]\nEXP1\n", "geometry.radius,wall.law\n1,\n"})
    EXPECT_THROW(listed(wrong), InvalidInput) << wrong;
}
