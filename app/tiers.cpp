// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/tiers.hpp"

#include "axisym/axisym_tier.hpp"
#include "lumped/lumped_tier.hpp"

namespace tunica {

TierList light_tiers() {
  TierList tiers;
  tiers.push_back(std::make_unique<lumped::LumpedTier>());
  tiers.push_back(std::make_unique<axisym::AxisymTier>());
  return tiers;
}

}  // namespace tunica
