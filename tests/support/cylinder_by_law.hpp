// SPDX-License-Identifier: GPL-3.0-or-later
// The cylinder in space against the axisymmetric tier: pressure and displacement to 0.3 % of their range,
// angles of fibres to 0.1 degrees, times of recruitment to 2 ms.
#pragma once

#include <cctype>

#include "tests/support/full3d_runs.hpp"

namespace tunica::test_support {

struct Comparison {
  const char* law;
  std::vector<std::string> settings;
};

class CylinderByLaw : public testing::TestWithParam<Comparison> {
 protected:
  std::string law() const { return std::string("wall.law=") + GetParam().law; }
};

TEST_P(CylinderByLaw, IsThatOfTheHalfPlane) {
  // Equal cells along, through the wall and around the core, which move alike, and equal steps: errors in
  // time are common. The bars are those of the default settings.
  const auto settings = joined({law(), "time.beats=1"}, {GetParam().settings});
  const Result plane = run_axisym(artery(settings)), space = run_full3d(artery(settings));
  const auto& a = plane.observables;
  const auto& b = space.observables;
  for (const char* column : {"pressure", "outlet_pressure", "radial_displacement.P1",
                             "radial_displacement.P2", "radial_displacement.P3", "radial_displacement.P4"})
    EXPECT_LT(difference(values(a, column), values(b, column)), 3e-3 * range(values(a, column))) << column;
  if (!std::string(GetParam().law).starts_with("EXP1+")) return;  // no fibres
  ASSERT_EQ(space.events.rows(), plane.events.rows());
  for (const char* column : {"fiber_angle.P1", "fiber_angle.P4"})
    EXPECT_LT(difference(values(a, column), values(b, column)), 0.1) << column;
  EXPECT_EQ(space.events.find("point")->labels, plane.events.find("point")->labels);
  EXPECT_LT(difference(values(plane.events, "time"), values(space.events, "time")), 2e-3);
}

inline std::vector<Comparison> laws(const std::vector<std::string>& settings) {
  std::vector<Comparison> all;
  for (const char* law : {"EXP1", "EXP2", "EXP1+EXP2-ZS", "EXP1+EXP2-FS"}) all.push_back({law, settings});
  return all;
}
inline std::string name_of_law(const testing::TestParamInfo<Comparison>& instance) {
  std::string name = instance.param.law;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
  return name;
}

}  // namespace tunica::test_support
