// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/tier.hpp"

namespace tunica {

/// The tiers that need no MPI, the cheapest first.
TierList light_tiers();

/// The tier of that name or, for "auto", the cheapest one that suits the scene.
/// Throws InvalidInput naming the tiers that there are.
const Tier& choose_tier(const TierList& tiers, const std::string& name, const Scene& scene);

}  // namespace tunica
