// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/tier.hpp"

namespace tunica::run {

/// The tier of that name or, for "auto", the cheapest one that suits the scene.
/// Throws InvalidInput naming the tiers that there are, or why the tier cannot compute the scene.
const Tier& choose_tier(const TierList& tiers, const std::string& name, const Scene& scene);

}  // namespace tunica::run
