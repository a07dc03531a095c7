// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/wall_strain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

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

bool lacks_directions(const wall::Law<double>& law, const wall::MaterialAxes& axes) {
  return (std::isnan(axes.circumferential[0]) || std::isnan(axes.axial[0])) && !wall::families(law).empty();
}

void refuse_fibers(const std::string& cell_at, Element element) {
  throw InvalidInput(fmt::format(
      "mesh: fibres have no direction in the {}: its corners all lie on one boundary, or on two that meet; "
      "make cells there so small that one corner is inside the wall{}, or take a law without fibres",
      cell_at, element == Element::quadratic ? "" : ", write mesh.element = \"quadratic\", which suffices"));
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
