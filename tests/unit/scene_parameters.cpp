// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include "core/scene/manual.hpp"
#include "core/scene/parameter.hpp"
#include "core/scene/scene.hpp"

namespace tunica::scene {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Bounds, KnowOpenAndClosedEnds) {
  const Bounds half_open{0, 10, true, false};
  EXPECT_FALSE(half_open.contains(0));
  EXPECT_TRUE(half_open.contains(std::numeric_limits<double>::denorm_min()));
  EXPECT_TRUE(half_open.contains(10));
  EXPECT_FALSE(half_open.contains(std::nextafter(10, 11)));
  EXPECT_FALSE((Bounds{-1, 0.5, true, true}.contains(0.5)));
  EXPECT_FALSE(Bounds{}.contains(infinity));
  EXPECT_FALSE(Bounds{}.contains(std::nan("")));
  EXPECT_TRUE(Bounds{}.contains(-1e300));
}

TEST(Bounds, SayWhatIsAllowed) {
  EXPECT_EQ((Bounds{0, infinity, true, false}.text()), "> 0");
  EXPECT_EQ((Bounds{1, infinity, false, false}.text()), "1 or more");
  EXPECT_EQ((Bounds{-infinity, 3, false, false}.text()), "3 or less");
  EXPECT_EQ((Bounds{-infinity, 3, false, true}.text()), "< 3");
  EXPECT_EQ((Bounds{0, 90, false, false}.text()), "0 to 90");
  EXPECT_EQ((Bounds{0, 10, true, false}.text()), "> 0, at most 10");
  EXPECT_EQ((Bounds{-1, 0.5, true, true}.text()), "> -1, < 0.5");
  EXPECT_EQ(Bounds{}.text(), "any finite number");
}

TEST(Parameters, AreFoundByKeyWithAnyIndex) {
  ASSERT_NE(find_parameter("geometry.radius"), nullptr);
  EXPECT_EQ(find_parameter("geometry.radius")->unit, "cm");
  ASSERT_NE(find_parameter("wall.layers[12].families[3].angle"), nullptr);
  EXPECT_EQ(find_parameter("wall.layers[12].families[3].angle")->key, "wall.layers[].families[].angle");
  EXPECT_EQ(find_parameter("wall.layers[x].fraction"), nullptr);
  EXPECT_EQ(find_parameter("wall.layers.fraction"), nullptr);
  EXPECT_EQ(find_parameter("wall.layers[1"), nullptr);
  EXPECT_EQ(find_parameter("geometry"), nullptr);
  EXPECT_EQ(find_parameter(""), nullptr);
}

TEST(Parameters, AreDeclaredOnceWithDefaultsThatTheyAllow) {
  std::set<std::string> keys;
  for (const Parameter& parameter : parameters()) {
    EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.key;
    EXPECT_TRUE(parameter.default_value || !parameter.derived_default.empty()) << parameter.key;
    if (!parameter.default_value) continue;
    if (const auto* number = std::get_if<double>(&*parameter.default_value)) {
      EXPECT_EQ(parameter.kind, Kind::number) << parameter.key;
      EXPECT_TRUE(parameter.bounds.contains(*number)) << parameter.key;
    }
    if (const auto* text = std::get_if<std::string>(&*parameter.default_value);
        text && parameter.kind == Kind::choice) {
      const std::set<std::string> choices(parameter.choices.begin(), parameter.choices.end());
      EXPECT_TRUE(choices.contains(*text)) << parameter.key;
    }
  }
}

TEST(Parameters, HaveUnitsThatUdunitsKnows) {
  for (const Parameter& parameter : parameters())
    if (parameter.kind == Kind::number && parameter.unit != "1") {
      // In brackets, so that it is parsed rather than compared with itself.
      EXPECT_DOUBLE_EQ(convert_quantity("2 (" + parameter.unit + ")", parameter.unit, parameter.key), 2)
          << parameter.key;
    }
}

TEST(NearestKey, FindsSlipsWrongTablesAndNothing) {
  EXPECT_EQ(nearest_key("geometry.radus"), "geometry.radius");
  EXPECT_EQ(nearest_key("GEOMETRY.RADIUS"), "geometry.radius");
  EXPECT_EQ(nearest_key("wall.radius"), "geometry.radius");
  EXPECT_EQ(nearest_key("viscosity"), "blood.viscosity");
  EXPECT_EQ(nearest_key("wall.fibre_stiffnes"), "wall.fiber_stiffness");
  EXPECT_EQ(nearest_key("wall.layers[2].fracton"), "wall.layers[2].fraction");
  EXPECT_EQ(nearest_key("wall.layers[2].families[1].wieght"), "wall.layers[2].families[1].weight");
  EXPECT_EQ(nearest_key("qqqqqqqqqq"), "");
  EXPECT_EQ(nearest_key(""), "");
  EXPECT_EQ(nearest_key(std::string(1'000'000, 'a')), "");
}

TEST(Manual, IsTheCommittedPage) {
  std::ifstream file(TUNICA_SOURCE_DIR "/docs/parameters.md");
  const std::string committed{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_EQ(committed, manual()) << "run: cmake --build --preset release --target tunica_manual && "
                                    "build/release/core/tunica_manual docs/parameters.md";
}

TEST(Manual, NamesEveryParameterAndLaw) {
  const std::string text = manual();
  for (const Parameter& parameter : parameters()) {
    const std::string leaf = parameter.key.substr(parameter.key.rfind('.') + 1);
    EXPECT_NE(text.find("| `" + leaf + "` |"), std::string::npos) << parameter.key;
  }
  EXPECT_NE(text.find("| `EXP1+EXP2-FS` |"), std::string::npos);
  EXPECT_NE(text.find("`activation_stretch = 1.5009`"), std::string::npos);
  EXPECT_NE(text.find("## `[[wall.layers.families]]`"), std::string::npos);
}

}  // namespace
}  // namespace tunica::scene
