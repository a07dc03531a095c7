// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tier.hpp"

namespace tunica {

/// The tiers that need no MPI, the cheapest first.
TierList light_tiers();

}  // namespace tunica
