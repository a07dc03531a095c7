// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/tier.hpp"

namespace tunica {

/// The 3D tier by name, for what does not hold its libraries: what it is for and what it cannot do.
/// tunica-full3d computes it.
std::unique_ptr<Tier> full3d_by_name();

}  // namespace tunica
