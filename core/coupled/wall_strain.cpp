// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/wall_strain.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::coupled {

void WallStrain::add(double factor, const WallStrain& other) {
  for (int i = 0; i < 3; ++i) displacement[i] += factor * other.displacement[i];
  gradient = gradient + factor * other.gradient;
  pressure += factor * other.pressure;
}

void WallStrain::take_own_pressure(const wall::Law<double>& law) {
  pressure = -wall::volumetric_stress(law, wall::volume_strain(law, gradient));
}

Tensor<double> cauchy(const wall::Law<double>& law, const WallStrain& strain,
                      const wall::MaterialAxes& axes) {
  return cauchy_stress(physics::mixed_wall_stress(law, strain.gradient, axes, strain.pressure),
                       strain.gradient);
}

bool is_far_from_incompressible(const std::vector<wall::Law<double>>& laws) {
  return std::all_of(laws.begin(), laws.end(), [](const wall::Law<double>& law) {
    return physics::pointwise_volumetric_share(law) == 1;
  });
}

std::vector<int> distinct_families(const wall::Law<double>& law) {
  const auto& families = wall::families(law);
  std::vector<int> distinct;
  for (int f = 0; f < static_cast<int>(families.size()); ++f) {
    const bool known = std::any_of(distinct.begin(), distinct.end(), [&](int earlier) {
      return std::abs(families[earlier].angle) == std::abs(families[f].angle) &&
             families[earlier].activation_squared == families[f].activation_squared;
    });
    if (!known) distinct.push_back(f);
  }
  return distinct;
}

bool is_balanced(const wall::Law<double>& law) {
  constexpr double rounding = 1e-9;
  const auto& families = wall::families(law);
  for (const auto& family : families) {
    // Along the circumference and along the axis a family is its own mirror image.
    if (std::abs(std::sin(2 * family.angle)) < rounding) continue;
    double balance = 0;
    for (const auto& other : families)
      if (std::abs(std::abs(other.angle) - std::abs(family.angle)) < rounding &&
          other.activation_squared == family.activation_squared && other.stiffness == family.stiffness &&
          other.stiffening == family.stiffening)
        balance += std::copysign(other.weight, other.angle);
    if (std::abs(balance) > rounding * family.weight) return false;
  }
  return true;
}

}  // namespace tunica::coupled
