// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Eigenvalues>
#include <numbers>
#include <string>
#include <vector>

#include "core/stability/strip.hpp"
#include "core/units.hpp"
#include "tests/support/ring_cases.hpp"

namespace tunica::test_support {

inline constexpr double wall_thickness = 0.01;  // cm, of the paper's wall
inline constexpr double wall_density = 1.2;     // g/cm3

/// k of a wave as long as `share` thicknesses of the paper's wall, 1/cm.
inline double wave_number(double share) {
  return 2 * std::numbers::pi / (share * wall_thickness);
}

inline std::vector<std::string> wall_under(const std::string& law, const std::string& tether) {
  return {"wall.law=" + law, "tether.traction=" + tether};
}

/// The paper's wall at a lumen pressure in mmHg.
inline stability::BaseState wall_at(const std::string& law, const std::string& tether, double pressure,
                                    const stability::Resolution& resolution = {}) {
  const auto model = model_with(wall_under(law, tether));
  return stability::base_state(*model, stability::lumen_stretch_at(*model, pressure * mmhg), resolution);
}

/// A wall at a lumen stretch.
inline stability::BaseState wall_stretched(const std::vector<std::string>& overrides, double stretch,
                                           const stability::Resolution& resolution = {}) {
  return stability::base_state(*model_with(overrides), stretch, resolution);
}

/// Unloaded linear elastic wall without a tether.
inline std::vector<std::string> elastic_wall(double young, double poisson) {
  return {"wall.law=linear-elastic", "wall.young_modulus=" + std::to_string(young),
          "wall.poisson_ratio=" + std::to_string(poisson), "tether.stiffness=0"};
}

}  // namespace tunica::test_support
