// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/radial/ring.hpp"

namespace tunica::radial {

/// The greatest pressure under which a ring has an equilibrium, and the lumen stretch there.
struct LimitLoad {
  double pressure;  ///< dyn/cm2
  double stretch;
};

/// Follows the ring's equilibria from rest to `greatest_stretch`. A limit load is that of a maximum, where
/// dp/ds changes its sign from + to - and beyond which no stretch carries more, or the pressure at the
/// greatest stretch where it has levelled off, so that it hardly grows on to three times that stretch. None
/// where pressure rises on, or where an equilibrium is not found on the way.
std::optional<LimitLoad> limit_load(const RingModel& ring, double greatest_stretch);

}  // namespace tunica::radial
