// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/scene.hpp"

namespace tunica {
namespace {

double converted(const char* text, const char* unit) {
  return convert_quantity(text, unit, "some.key");
}

TEST(Units, ConvertToCgs) {
  EXPECT_DOUBLE_EQ(converted("75 mmHg", "dyn/cm2"), 75 * 1333.22387);
  EXPECT_DOUBLE_EQ(converted("1 kPa", "dyn/cm2"), 1e4);
  EXPECT_DOUBLE_EQ(converted("1.032e6 dyn s/cm5", "dyn s/cm5"), 1.032e6);
  EXPECT_DOUBLE_EQ(converted("1.032e11 Pa s/m3", "dyn s/cm5"), 1.032e6);
  EXPECT_DOUBLE_EQ(converted("3.5 cP", "g/cm/s"), 0.035);
  EXPECT_DOUBLE_EQ(converted("255 ml/min", "cm3/s"), 4.25);
  EXPECT_DOUBLE_EQ(converted("1060 kg/m3", "g/cm3"), 1.06);
  EXPECT_DOUBLE_EQ(converted("100um", "cm"), 0.01);
  EXPECT_DOUBLE_EQ(converted("100 µm", "cm"), 0.01);
  EXPECT_DOUBLE_EQ(converted("4.25 cm³/s", "cm3/s"), 4.25);
  EXPECT_DOUBLE_EQ(converted(" +2 cm^3/s ", "cm3/s"), 2);
  EXPECT_DOUBLE_EQ(converted("1 MPa", "dyn/cm2"), 1e7);
}

TEST(Units, KnowAnglesFromRatios) {
  EXPECT_NEAR(converted("0.7 rad", "deg"), 40.10704565915762, 1e-12);
  EXPECT_DOUBLE_EQ(converted("42.82 deg", "deg"), 42.82);
  EXPECT_DOUBLE_EQ(converted("90 °", "deg"), 90);
  EXPECT_DOUBLE_EQ(converted("1%", "1"), 0.01);
  EXPECT_DOUBLE_EQ(converted("1 percent", "1"), 0.01);
  EXPECT_DOUBLE_EQ(converted("0.5", "1"), 0.5);
  EXPECT_THROW(converted("40 %", "deg"), InvalidInput);
  EXPECT_THROW(converted("40 1", "deg"), InvalidInput);
  EXPECT_THROW(converted("1 rad", "1"), InvalidInput);
  EXPECT_THROW(converted("1 sr", "deg"), InvalidInput);
}

TEST(Units, RefuseWhatIsNoLinearConversion) {
  EXPECT_THROW(converted("1 Hz", "s"), InvalidInput);
  EXPECT_THROW(converted("1 cm from 3", "cm"), InvalidInput);
  EXPECT_THROW(converted("1 seconds since 2000-01-01", "s"), InvalidInput);
  EXPECT_THROW(converted("1 lg(re 1 Pa)", "dyn/cm2"), InvalidInput);
}

TEST(Units, NameTheKeyTheTextAndTheUnitWanted) {
  try {
    convert_quantity("3 s", "cm", "geometry.radius");
    FAIL() << "a time was taken for a length";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(
        error.what(),
        "geometry.radius = \"3 s\": \"s\" has another dimension than cm; write the number alone (in cm) "
        "or with a unit of that dimension");
  }
}

TEST(Messages, StayOnOneLine) {
  EXPECT_EQ(scene::one_line("a\nb\x7f\xff"), "a\\x0ab\\x7f\\xff");
  EXPECT_EQ(scene::one_line("\u2028\u0085"), "\\xe2\\x80\\xa8\\xc2\\x85");
  EXPECT_EQ(scene::one_line("β = 42°"), "β = 42°");
  EXPECT_EQ(scene::one_line("ββββ", 3), "βββ...");
  EXPECT_EQ(scene::one_line("\xe2\x80"), "\\xe2\\x80");
}

TEST(Messages, CountSlipsOfTheFinger) {
  EXPECT_EQ(scene::edit_distance("", "abc"), 3U);
  EXPECT_EQ(scene::edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(scene::edit_distance("raduis", "radius"), 1U);
  EXPECT_EQ(scene::edit_distance("EXP1", "exp1"), 0U);
}

}  // namespace
}  // namespace tunica
