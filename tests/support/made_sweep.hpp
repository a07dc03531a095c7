// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace tunica::test_support {

/// A sweep's folder made of formulas, as `tunica sweep` would leave it: a grid of outlet.resistance (`many`
/// values in equal ratios from 5e5 dyn s/cm5), wall.law (EXP1, EXP2) and tether.stiffness (1e7, 2e7, 3e7
/// dyn/cm3), the last fastest. With the levels i, j, k of the three
///   pressure.max = 60 + 10 i + k mmHg,   radial_displacement.P1.change = 1e-3 (1 + k) cm,
/// fiber_angle.P1.change has no point. The last point has given up with `reason`.
struct MadeSweep {
  int many = 5;
  std::string reason = "at 0.1 s: the wall tears";
  bool with_indices = false;
};
void make_sweep(const std::filesystem::path& folder, const MadeSweep& made);

}  // namespace tunica::test_support
