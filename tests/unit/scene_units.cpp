// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <utility>

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

TEST(Units, KnowWhatClinicsAndLaboratoriesWrite) {
  constexpr double water = 98.0665;  // dyn/cm2 of a millimetre: 1 g/cm3 times standard gravity
  EXPECT_NEAR(converted("1 mmH2O", "dyn/cm2"), water, 1e-9);
  EXPECT_NEAR(converted("1 cmH2O", "dyn/cm2"), 10 * water, 1e-9);
  EXPECT_NEAR(converted("1 inH2O", "dyn/cm2"), 25.4 * water, 1e-9);
  EXPECT_NEAR(converted("1 torr", "dyn/cm2"), 1333.22, 0.01);
  EXPECT_NEAR(converted("75 mm Hg", "dyn/cm2"), 75 * 1333.22387, 0.01);
  EXPECT_DOUBLE_EQ(converted("1 bar", "dyn/cm2"), 1e6);
  EXPECT_DOUBLE_EQ(converted("2 Ba", "dyn/cm2"), 2);
  for (const char* viscosity :
       {"3.5 mPa s", "3.5 mPa.s", "3.5 mPa*s", "3.5 mPas", "0.0035 Pa.s", "0.0035 Pa s", "0.035 P",
        "0.0035 kg/(m s)", "0.0035 kg m-1 s^-1", "0.0035 kg m**-1 s**-1", "0.0035 kg·m⁻¹·s⁻¹"})
    EXPECT_NEAR(converted(viscosity, "g/cm/s"), 0.035, 1e-15) << viscosity;
  for (const char* flow : {"0.6 l/min", "0.6 L/min", "600 mL/min", "10 ml per s", "10 cc/s", "10 cm^3 s-1"})
    EXPECT_NEAR(converted(flow, "cm3/s"), 10, 1e-13) << flow;
  for (const char* resistance : {"1e6 dyn s/cm5", "1e6 dyn.s.cm-5", "1e6 dyn*s/cm^5", "1e6 dyn·s/cm⁵",
                                 "1e6 dyn s cm⁻⁵", "1e6 g/(cm4 s)", "1e11 Pa s/m3"})
    EXPECT_NEAR(converted(resistance, "dyn s/cm5"), 1e6, 1e-7) << resistance;
  EXPECT_DOUBLE_EQ(converted("1 PRU", "dyn s/cm5"), 1333.22387);
  EXPECT_NEAR(converted("1 WU", "dyn s/cm5"), 0.06 * 1333.22387, 1e-11);
}

// UDUNITS takes a number behind a unit for a factor: "100 mmHg -10" would be -1000 mmHg.
TEST(Units, HoldNoNumbers) {
  const std::pair<const char*, const char*> quantities[] = {{"100 mmHg -10", "dyn/cm2"},
                                                            {"1e7 dyn/cm3.5", "dyn/cm3"},
                                                            {"100 mmHg 3", "dyn/cm2"},
                                                            {"100 mmHg3.", "dyn/cm2"},
                                                            {"1 cm3/s.5", "cm3/s"},
                                                            {"1 cm3/s 60", "cm3/s"},
                                                            {"1 cm3/60 s", "cm3/s"},
                                                            {"100 mmHg/10", "dyn/cm2"},
                                                            {"100 mmHg*10", "dyn/cm2"},
                                                            {"100 mmHg (10)", "dyn/cm2"},
                                                            {"3 s 2", "s"},
                                                            {"3 s - 2", "s"},
                                                            {"3 s.1e3", "s"},
                                                            {"100 mmHg @ 0", "dyn/cm2"},
                                                            {"2 (3 s)", "s"},
                                                            {"1 (cm s) 2/cm s", "s"},
                                                            {"100 mmHg²3", "dyn/cm2"},
                                                            {"1 cm³.5", "cm3"}};
  for (const auto& [text, unit] : quantities) EXPECT_THROW(converted(text, unit), InvalidInput) << text;
  // Nor by name, nor by an angle.
  for (const char* text :
       {"100 ppm mmHg", "100 count mmHg", "100 mmHg.percent", "100 % mmHg", "100 mmHg rad", "100 deg mmHg"})
    EXPECT_THROW(converted(text, "dyn/cm2"), InvalidInput) << text;
  try {
    convert_quantity("100 mmHg -10", "dyn/cm2", "outlet.pressure");
    FAIL() << "a unit with a number was taken";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(
        error.what(),
        "outlet.pressure = \"100 mmHg -10\": \"mmHg -10\" is not a unit alone: it holds a number, "
        "which would multiply; write the number alone (in dyn/cm2) or with a unit of that dimension");
  }
}

TEST(Units, SuggestTheUnitMeant) {
  const auto message = [](const char* text, const char* unit) -> std::string {
    try {
      converted(text, unit);
      return {};
    } catch (const InvalidInput& error) {
      return error.what();
    }
  };
  EXPECT_NE(message("100 mmHG", "dyn/cm2").find("did you mean \"mmHg\"?"), std::string::npos);
  EXPECT_NE(message("13 KPA", "dyn/cm2").find("did you mean \"kPa\"?"), std::string::npos);
  EXPECT_NE(message("1 CM", "cm").find("did you mean \"cm\"?"), std::string::npos);
  EXPECT_EQ(message("3 furlongz", "cm").find("did you mean"), std::string::npos);
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
