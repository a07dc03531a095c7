// SPDX-License-Identifier: GPL-3.0-or-later
// Keys that a scene sets although the tier, or its mode, does nothing with them.
#include <gtest/gtest.h>

#include <algorithm>

#include "axisym/axisym_tier.hpp"
#include "lumped/lumped_tier.hpp"

namespace tunica {
namespace {

using Overrides = std::vector<std::string>;

const std::string scenes = std::string(TUNICA_SOURCE_DIR) + "/scenes/";
const Overrides coarse{"mesh.wall_cells=1", "mesh.axial_cells=4"};

/// Warnings of a run, which are among the remarks in its record; those about stability left out.
template <class Tier>
Overrides remarks(const std::string& scene, Overrides overrides, bool check_record = true) {
  const Scene read = read_scene(scenes + scene, overrides);
  const auto run = Tier().prepare(read);
  const Overrides told = run->warnings();
  if (check_record) {
    const auto recorded = run->execute({}).record.remarks;
    for (const std::string& line : told)
      EXPECT_NE(std::find(recorded.begin(), recorded.end(), line), recorded.end()) << line;
  }
  return told;
}

TEST(TierRemarks, LumpedNamesWhatOnlyMeshesUse) {
  using lumped::LumpedTier;
  EXPECT_EQ(remarks<LumpedTier>("cylinder.toml", {}), Overrides{});
  EXPECT_EQ(remarks<LumpedTier>("cylinder.toml",
                                {"geometry.ends=sliding", "time.step=1e-3", "time.scheme=backward-euler",
                                 "outlet.backflow=0.3", "inlet.profile=natural", "mesh.wall_cells=3"}),
            Overrides{"geometry.ends, inlet.profile, mesh.wall_cells, outlet.backflow, time.scheme and "
                      "time.step are not used: the tier is lumped, without ends, cells and sections, and "
                      "chooses its steps"});
}

TEST(TierRemarks, AxisymNamesWhatItsModesLeaveOut) {
  using axisym::AxisymTier;
  const auto with = [](Overrides more) {
    more.insert(more.end(), coarse.begin(), coarse.end());
    return more;
  };
  EXPECT_EQ(remarks<AxisymTier>("cylinder.toml", with({}), false), Overrides{});
  EXPECT_EQ(remarks<AxisymTier>("cylinder.toml", with({"lumped.inertance=true"}), false),
            Overrides{"lumped.inertance is not used: the tier is axisym"});
  EXPECT_EQ(
      remarks<AxisymTier>("cylinder.toml", with({"mesh.element=bubble", "mesh.mixed_wall=false"}), false),
      Overrides{"mesh.mixed_wall is not used: mesh.element is \"bubble\""});
  const auto not_mixed = [&](const char* ratio) {
    return remarks<AxisymTier>("cylinder_exp1.toml",
                               with({"wall.law=linear-elastic", std::string("wall.poisson_ratio=") + ratio,
                                     "mesh.mixed_wall=false"}),
                               false);
  };
  EXPECT_EQ(not_mixed("0.3"), Overrides{"mesh.mixed_wall is not used: the wall is far from incompressible"});
  EXPECT_EQ(not_mixed("0.49"), Overrides{});
  const auto near_incompressible = [&](const char* element, const char* law, const char* stiff) {
    return remarks<AxisymTier>("cylinder_exp1.toml", with({element, law, stiff}), false);
  };
  const Overrides locks{
      "the wall is 5e+05 times as stiff against changes of volume as of shape, and linear triangles and "
      "tetrahedra lock in such tissue, so that it moves too little; write mesh.element = \"quadratic\""};
  const char* const linear = "wall.law=linear-elastic";
  const char* const stiff = "wall.poisson_ratio=0.499999";
  EXPECT_EQ(near_incompressible("mesh.element=bubble", linear, stiff), locks);
  EXPECT_EQ(near_incompressible("mesh.element=quadratic", linear, stiff), Overrides{});
  EXPECT_EQ(near_incompressible("mesh.element=linear", linear, stiff), Overrides{});
  EXPECT_EQ(near_incompressible("mesh.element=bubble", "wall.law=EXP1", "wall.bulk_modulus=3.8175e10"),
            locks);
  EXPECT_EQ(near_incompressible("mesh.element=bubble", "wall.law=EXP1", "wall.bulk_modulus=9e6"),
            Overrides{});
  EXPECT_EQ(
      remarks<AxisymTier>("cylinder.toml", with({"inlet.waveform=pressure", "inlet.profile=natural"}), false),
      Overrides{"inlet.profile is not used: a pressure drives the flow"});
  EXPECT_EQ(remarks<AxisymTier>("cylinder.toml", with({"inlet.pressure_kind=static"}), false),
            Overrides{"inlet.pressure_kind is not used: the velocity at the inlet is prescribed"});
  // The scene itself sets blood, outlet and beats.
  EXPECT_EQ(remarks<AxisymTier>("cylinder.toml", with({"time.mode=static", "time.ramp=0.1",
                                                       "inlet.waveform=pressure", "inlet.pressure=10 mmHg",
                                                       "mesh.blood_cells=2", "mesh.motion=stiffened"})),
            (Overrides{"time.beats and time.ramp are not used: time.mode is \"static\"",
                       "blood.density, blood.viscosity, mesh.blood_cells, mesh.motion, outlet.kind, "
                       "outlet.pressure and outlet.resistance are not used: a wall under a given pressure is "
                       "computed without its blood"}));
}

TEST(TierRemarks, AMeshHasItsOwnLengthAndThickness) {
  const auto told = remarks<axisym::AxisymTier>("stenosis.toml", {"geometry.length=1"}, false);
  ASSERT_FALSE(told.empty());
  EXPECT_NE(told.front().find("geometry.length"), std::string::npos) << told.front();
  EXPECT_NE(told.front().find("not used: geometry.kind is \"mesh\""), std::string::npos) << told.front();
}

}  // namespace
}  // namespace tunica
