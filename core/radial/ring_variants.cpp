// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/radial/ring_variants.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::radial {

bool stress_jumps(const Ring<double>& ring) {
  return std::any_of(ring.layers.begin(), ring.layers.end(), [](const auto& layer) {
    const auto& families = wall::families(layer.law);
    return std::any_of(families.begin(), families.end(),
                       [](const auto& family) { return family.exponent == 1; });
  });
}

Ring<double> with_mirror_images_merged(Ring<double> ring) {
  for (auto& layer : ring.layers) {
    std::visit(
        [&](auto& law) {
          if constexpr (wall::HasFamilies<std::decay_t<decltype(law)>>) {
            std::vector<wall::CollagenFamily<double>> merged;
            for (const auto& family : law.families) {
              const auto image = std::find_if(merged.begin(), merged.end(), [&](const auto& other) {
                return std::abs(other.angle) == std::abs(family.angle) &&
                       other.stiffness == family.stiffness && other.stiffening == family.stiffening &&
                       other.activation_squared == family.activation_squared &&
                       other.exponent == family.exponent &&
                       other.recruitment.sharpness == family.recruitment.sharpness &&
                       other.recruitment.sharp == family.recruitment.sharp;
              });
              if (image == merged.end())
                merged.push_back(family);
              else
                image->weight += family.weight;
            }
            law.families = std::move(merged);
          }
        },
        layer.law);
  }
  return ring;
}

Ring<double> with_sharpness_at_most(Ring<double> ring, double sharpness) {
  for (auto& layer : ring.layers) {
    std::visit(
        [&](auto& law) {
          if constexpr (wall::HasFamilies<std::decay_t<decltype(law)>>)
            for (auto& family : law.families)
              family.recruitment.sharpness = std::min(family.recruitment.sharpness, sharpness);
        },
        layer.law);
  }
  return ring;
}

std::optional<Ring<double>> with_bulk_moduli_times(Ring<double> ring, double factor) {
  bool splits = false;
  for (auto& layer : ring.layers) {
    std::visit(
        [&](auto& law) {
          if constexpr (wall::HasFamilies<std::decay_t<decltype(law)>>) {
            law.volumetric.bulk_modulus *= factor;
            splits = true;
          }
        },
        layer.law);
  }
  return splits ? std::optional(std::move(ring)) : std::nullopt;
}

}  // namespace tunica::radial
