// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.hpp"
#include "core/scene/scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

Scene parsed(std::string_view text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "test.toml", ".", overrides);
}

bool remarks_on(const Scene& scene, std::string_view start) {
  return std::any_of(scene.remarks().begin(), scene.remarks().end(),
                     [&](const std::string& remark) { return remark.starts_with(start); });
}

std::string refusal(std::string_view text, const std::vector<std::string>& overrides = {}) {
  try {
    parsed(text, overrides);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SceneDefaults, AreThePapersCylinder) {
  const Scene scene = parsed("[geometry]\n");
  EXPECT_EQ(scene.name(), "test");
  EXPECT_EQ(scene.number("geometry.radius"), 0.033);
  EXPECT_EQ(scene.number("geometry.thickness"), 0.01);
  EXPECT_EQ(scene.number("geometry.length"), 0.66);
  EXPECT_EQ(scene.text("wall.law"), "EXP1+EXP2-FS");
  EXPECT_EQ(scene.number("wall.stiffness"), 3.5270e4);
  EXPECT_EQ(scene.number("wall.stiffening"), 0.3424);
  EXPECT_EQ(scene.number("wall.fiber_stiffness"), 1.3370e5);
  EXPECT_EQ(scene.number("wall.fiber_stiffening"), 0.2141);
  EXPECT_EQ(scene.number("wall.fiber_angle"), 42.82);
  EXPECT_EQ(scene.number("wall.activation_stretch"), 1.5009);
  EXPECT_EQ(scene.number("wall.bulk_modulus"), 9e6);
  EXPECT_EQ(scene.number("wall.density"), 1.2);
  EXPECT_EQ(scene.integer("wall.exponent"), 2);
  EXPECT_EQ(scene.number("wall.sharpness"), 5e5);
  EXPECT_EQ(scene.number("tether.stiffness"), 1e7);
  EXPECT_EQ(scene.text("tether.traction"), "normal");
  EXPECT_EQ(scene.number("outlet.resistance"), 1.032e6);
  EXPECT_EQ(scene.integer("time.beats"), 2);
  EXPECT_NEAR(scene.number("inlet.flow"), 0.1217, 5e-5);
  EXPECT_EQ(scene.numbers("output.profile_times"), (std::vector<double>{0.2112, 0.6}));
  EXPECT_EQ(scene.count("wall.families"), 0U);
  EXPECT_EQ(scene.count("wall.layers"), 0U);
  EXPECT_TRUE(scene.remarks().empty());
  EXPECT_FALSE(scene.was_set("geometry.radius"));
}

TEST(SceneDefaults, FollowOtherKeys) {
  EXPECT_DOUBLE_EQ(parsed("[geometry]\nradius = 0.195\n").number("inlet.flow"), 4.25);
  EXPECT_EQ(parsed("[inlet]\nflow = 1\n").number("inlet.flow"), 1);
  const Scene fast = parsed("[inlet]\nperiod = 0.4\n");
  EXPECT_DOUBLE_EQ(fast.numbers("output.profile_times").front(), 0.1056);
  EXPECT_DOUBLE_EQ(fast.numbers("output.profile_times").back(), 0.3);
}

TEST(SceneDefaults, AreTheChosenLaws) {
  const Scene exp2 = parsed("[wall]\nlaw = \"EXP2\"\n");
  EXPECT_EQ(exp2.number("wall.stiffness"), 6.8220e4);
  EXPECT_FALSE(exp2.has("wall.fiber_angle"));
  EXPECT_FALSE(exp2.has("wall.exponent"));
  const Scene zs = parsed("[wall]\nlaw = \"EXP1+EXP2-ZS\"\n");
  EXPECT_EQ(zs.number("wall.fiber_angle"), 56.52);
  EXPECT_FALSE(zs.has("wall.activation_stretch"));
  EXPECT_FALSE(zs.has("wall.activation_squared"));
  const Scene linear = parsed("[wall]\nlaw = \"linear-elastic\"\n");
  EXPECT_EQ(linear.number("wall.young_modulus"), 3e6);
  EXPECT_FALSE(linear.has("wall.bulk_modulus"));
}

TEST(SceneValues, TakeUnitsIntegersAndWholeFloats) {
  const Scene scene = parsed(R"([geometry]
radius = "330 um"
length = 1
[outlet]
pressure = "75 mmHg"
[wall]
fiber_angle = "0.7 rad"
[time]
beats = 3.0
[accuracy]
tolerance = "1%"
[output]
profile_times = [0.1, "200 ms", 0]
)");
  EXPECT_DOUBLE_EQ(scene.number("geometry.radius"), 0.033);
  EXPECT_EQ(scene.number("geometry.length"), 1.0);
  EXPECT_DOUBLE_EQ(scene.number("outlet.pressure"), 75 * 1333.22387);
  EXPECT_NEAR(scene.number("wall.fiber_angle"), 40.10704565915762, 1e-12);
  EXPECT_EQ(scene.integer("time.beats"), 3);
  EXPECT_EQ(scene.number("accuracy.tolerance"), 0.01);
  EXPECT_EQ(scene.numbers("output.profile_times"), (std::vector<double>{0.1, 0.2, 0.0}));
  EXPECT_TRUE(scene.was_set("geometry.radius"));
  EXPECT_FALSE(scene.was_set("geometry.thickness"));
}

TEST(SceneAccess, RefusesProgrammingErrors) {
  const Scene scene = parsed("[geometry]\n");
  EXPECT_THROW(scene.number("geometry.radus"), std::logic_error);
  EXPECT_THROW(scene.number("geometry.kind"), std::logic_error);
  EXPECT_THROW(scene.number("geometry.bend_angle"), std::logic_error);
  EXPECT_THROW(scene.integer("geometry.radius"), std::logic_error);
  EXPECT_THROW(scene.count("geometry"), std::logic_error);
}

TEST(SceneOverrides, ReplaceAndAdd) {
  const Scene scene = parsed(
      "[wall]\nlaw = \"EXP2\"\n[outlet]\nresistance = 5\n",
      {"wall.law=EXP1", "outlet.resistance = 1e6", "tether.stiffness=2e7 dyn/cm3", "blood.viscosity=\"4 cP\"",
       "time.beats=1", "time.beats=4", "lumped.inertance=true",
       "sensitivity.parameters=outlet.resistance, tether.stiffness", "output.profile_times=0.1,300 ms"});
  EXPECT_EQ(scene.text("wall.law"), "EXP1");
  EXPECT_EQ(scene.number("wall.stiffness"), 7.6350e4);
  EXPECT_EQ(scene.number("outlet.resistance"), 1e6);
  EXPECT_EQ(scene.number("tether.stiffness"), 2e7);
  EXPECT_DOUBLE_EQ(scene.number("blood.viscosity"), 0.04);
  EXPECT_EQ(scene.integer("time.beats"), 4);
  EXPECT_TRUE(scene.flag("lumped.inertance"));
  EXPECT_EQ(scene.texts("sensitivity.parameters"),
            (std::vector<std::string>{"outlet.resistance", "tether.stiffness"}));
  EXPECT_EQ(scene.numbers("output.profile_times"), (std::vector<double>{0.1, 0.3}));
  EXPECT_TRUE(scene.was_set("tether.stiffness"));
  EXPECT_EQ(
      parsed("[wall]\n", {"sensitivity.parameters=[\"wall.bulk_modulus\"]"}).texts("sensitivity.parameters"),
      std::vector<std::string>{"wall.bulk_modulus"});
}

TEST(SceneOverrides, ReachIntoLayersAndMakeThem) {
  const std::string layer = "[[wall.layers]]\nfraction = 1\n";
  EXPECT_EQ(parsed(layer, {"wall.layers[0].stiffness=2e4"}).number("wall.layers[0].stiffness"), 2e4);
  const Scene made = parsed("[geometry]\n", {"wall.families=[{angle=30},{angle=-30, weight=2}]"});
  EXPECT_EQ(made.count("wall.families"), 2U);
  EXPECT_EQ(made.number("wall.families[1].weight"), 2);
}

TEST(SceneRemarks, LeaveOutWhatTheChoicesDoNotUse) {
  const Scene scene = parsed(R"([geometry]
bend_angle = 90
[wall]
law = "EXP1"
activation_stretch = 1.4
incompressible = true
bulk_modulus = 1e7
[inlet]
pressure = 1e5
[outlet]
compliance = 1e-8
[time]
start = "periodic"
ramp = 0.1
[[wall.families]]
angle = 30
)");
  for (const char* key : {"geometry.bend_angle", "wall.activation_stretch", "wall.bulk_modulus",
                          "inlet.pressure", "outlet.compliance", "time.ramp"}) {
    EXPECT_FALSE(scene.has(key)) << key;
    EXPECT_TRUE(remarks_on(scene, key)) << key;
  }
  EXPECT_TRUE(remarks_on(scene, "wall.families are not used"));
  EXPECT_EQ(scene.count("wall.families"), 0U);
  EXPECT_EQ(scene.remarks().size(), 7U);
}

TEST(SceneRemarks, AreCheckedAllTheSame) {
  EXPECT_NE(refusal("[wall]\nlaw = \"EXP1\"\nactivation_stretch = -1\n").find("out of range"),
            std::string::npos);
}

TEST(SceneActivation, IsTakenFromTheNearestSource) {
  const Scene squared = parsed("[wall]\nactivation_squared = 1.52\nactivation_stretch = 1.4\n");
  EXPECT_EQ(squared.number("wall.activation_squared"), 1.52);
  EXPECT_FALSE(squared.has("wall.activation_stretch"));
  EXPECT_TRUE(remarks_on(squared, "wall.activation_stretch is not used"));

  const Scene families = parsed(R"([wall]
activation_squared = 1.52
[[wall.families]]
angle = 40
[[wall.families]]
angle = -40
activation_stretch = 1.3
)");
  EXPECT_EQ(families.number("wall.families[0].activation_squared"), 1.52);
  EXPECT_FALSE(families.has("wall.families[0].activation_stretch"));
  EXPECT_EQ(families.number("wall.families[1].activation_stretch"), 1.3);
  EXPECT_FALSE(families.has("wall.families[1].activation_squared"));
}

TEST(SceneFamilies, InheritFromTheirTissue) {
  const Scene scene = parsed(R"([wall]
fiber_stiffness = 2e5
fiber_angle = 10
[[wall.families]]
angle = 40
[[wall.families]]
angle = -35
weight = 0.5
stiffness = 1e5
)");
  ASSERT_EQ(scene.count("wall.families"), 2U);
  EXPECT_EQ(scene.number("wall.families[0].angle"), 40);
  EXPECT_EQ(scene.number("wall.families[0].weight"), 1);
  EXPECT_EQ(scene.number("wall.families[0].stiffness"), 2e5);
  EXPECT_EQ(scene.number("wall.families[0].stiffening"), 0.2141);
  EXPECT_EQ(scene.number("wall.families[0].activation_stretch"), 1.5009);
  EXPECT_EQ(scene.number("wall.families[1].weight"), 0.5);
  EXPECT_EQ(scene.number("wall.families[1].stiffness"), 1e5);
  EXPECT_FALSE(scene.has("wall.fiber_angle"));
  EXPECT_TRUE(remarks_on(scene, "wall.fiber_angle is not used"));
  EXPECT_TRUE(scene.was_set("wall.families[1].stiffness"));
  EXPECT_FALSE(scene.was_set("wall.families[0].stiffness"));
}

TEST(SceneLayers, InheritFromTheWallOnlyWhatIsMeantForTheirLaw) {
  const Scene scene = parsed(R"([wall]
law = "EXP1+EXP2-FS"
stiffness = 4e4
bulk_modulus = 5e6
sharpness = 1e3
[[wall.layers]]
fraction = 0.25
law = "EXP1"
[[wall.layers]]
fraction = 0.25
[[wall.layers]]
fraction = 0.5
stiffness = 1e4
bulk_modulus = 7e6
)");
  ASSERT_EQ(scene.count("wall.layers"), 3U);
  // Another law: its own default, not the wall's value.
  EXPECT_EQ(scene.number("wall.layers[0].stiffness"), 7.6350e4);
  EXPECT_EQ(scene.number("wall.layers[0].bulk_modulus"), 5e6);
  EXPECT_FALSE(scene.has("wall.layers[0].sharpness"));
  EXPECT_EQ(scene.text("wall.layers[1].law"), "EXP1+EXP2-FS");
  EXPECT_EQ(scene.number("wall.layers[1].stiffness"), 4e4);
  EXPECT_EQ(scene.number("wall.layers[1].fiber_stiffness"), 1.3370e5);
  EXPECT_EQ(scene.number("wall.layers[1].sharpness"), 1e3);
  EXPECT_EQ(scene.text("wall.layers[1].name"), "layer");
  EXPECT_EQ(scene.number("wall.layers[2].stiffness"), 1e4);
  EXPECT_EQ(scene.number("wall.layers[2].bulk_modulus"), 7e6);
  EXPECT_EQ(scene.number("wall.stiffness"), 4e4);
  EXPECT_TRUE(scene.remarks().empty());
}

TEST(SceneLayers, RemarkOnWallValuesThatNoLayerTakesOver) {
  const Scene scene = parsed(
      "[wall]\nstiffness = 4e4\n[[wall.layers]]\nfraction = 1\nlaw = \"EXP1\"\n[[wall.families]]\nangle = "
      "1\n");
  EXPECT_TRUE(remarks_on(scene, "wall.stiffness is not used"));
  EXPECT_TRUE(remarks_on(scene, "wall.families are not used"));
}

TEST(SceneLayers, TakeOverTheWallsFamiliesUnlessTheyHaveTheirOwn) {
  const Scene scene = parsed(R"([[wall.families]]
angle = 25
[[wall.layers]]
fraction = 0.2
fiber_stiffness = 9e4
[[wall.layers]]
fraction = 0.2
fiber_angle = 60
[[wall.layers]]
fraction = 0.2
law = "EXP1+EXP2-ZS"
[[wall.layers]]
fraction = 0.4
[[wall.layers.families]]
angle = 70
[[wall.layers.families]]
angle = 80
)");
  EXPECT_EQ(scene.count("wall.layers[0].families"), 1U);
  EXPECT_EQ(scene.number("wall.layers[0].families[0].angle"), 25);
  EXPECT_EQ(scene.number("wall.layers[0].families[0].stiffness"), 9e4);
  EXPECT_EQ(scene.count("wall.layers[1].families"), 0U);
  EXPECT_EQ(scene.number("wall.layers[1].fiber_angle"), 60);
  EXPECT_EQ(scene.count("wall.layers[2].families"), 0U);
  EXPECT_EQ(scene.number("wall.layers[2].fiber_angle"), 56.52);
  EXPECT_EQ(scene.count("wall.layers[3].families"), 2U);
  EXPECT_FALSE(scene.has("wall.layers[3].families[0].activation_squared"));
  EXPECT_EQ(scene.number("wall.layers[3].families[0].activation_stretch"), 1.5009);
}

TEST(SceneLayers, FractionsAddUpWithinRounding) {
  const std::string third = "[[wall.layers]]\nfraction = 0.3333333\n";
  EXPECT_EQ(parsed(third + third + third).count("wall.layers"), 3U);
  EXPECT_NE(refusal("[[wall.layers]]\nfraction = 0.99999\n").find("add up to 1"), std::string::npos);
}

TEST(SceneSensitivities, NameNumbersThatAct) {
  const std::string layer = "[[wall.layers]]\nfraction = 1\n";
  const auto asks = [](const std::string& text, const char* key) {
    return refusal(text, {std::string("sensitivity.parameters=") + key});
  };
  for (const char* key : {"outlet.resistance", "tether.stiffness", "wall.activation_stretch",
                          "wall.bulk_modulus", "geometry.thickness", "inlet.flow"})
    EXPECT_EQ(asks("[geometry]\n", key), "accepted") << key;
  // Times of the method and of the output move the rows themselves.
  for (const char* key : {"inlet.period", "time.ramp", "output.interval", "accuracy.tolerance"})
    EXPECT_NE(asks("[geometry]\n", key).find("sensitivities are offered for"), std::string::npos) << key;
  EXPECT_EQ(asks(layer, "wall.layers[0].stiffness"), "accepted");
  EXPECT_EQ(asks(layer, "wall.density"), "accepted");
  EXPECT_NE(asks(layer, "wall.stiffness").find("did you mean \"wall.layers[0].stiffness\"?"),
            std::string::npos);
  EXPECT_EQ(asks(layer, "wall.layers[0].fraction"), "accepted");
  EXPECT_EQ(asks("[wall]\n", "wall.sharpness"), "accepted");
  EXPECT_NE(asks("[wall]\nrecruitment = \"sharp\"\n", "wall.sharpness"), "accepted");
  const std::string family = "[[wall.families]]\nangle = 30\n";
  EXPECT_EQ(asks(family, "wall.families[0].angle"), "accepted");
  EXPECT_EQ(asks(family, "wall.stiffness"), "accepted");
  EXPECT_NE(asks(family, "wall.fiber_stiffness"), "accepted");
}

TEST(SceneFile, GivesNameAndFolderAndNamesItselfInMessages) {
  const test_support::TemporaryFolder folder;
  const auto file = folder.path() / "artery.v2.toml";
  std::ofstream(file) << "[geometry]\nradius = 0.05\n";
  const Scene scene = read_scene(file);
  EXPECT_EQ(scene.name(), "artery.v2");
  EXPECT_EQ(scene.folder(), folder.path());
  EXPECT_EQ(scene.number("geometry.radius"), 0.05);
}

TEST(SceneFile, WithoutPermissionIsRefused) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const test_support::TemporaryFolder folder;
  const auto file = folder.path() / "secret.toml";
  std::ofstream(file) << "[geometry]\n";
  std::filesystem::permissions(file, std::filesystem::perms::none);
  EXPECT_THROW(read_scene(file), InvalidInput);
}

}  // namespace
}  // namespace tunica
