// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tunica {

/// The unit in which people read pressures, in dyn/cm2. The unit's name in scenes has the same value.
inline constexpr double mmhg = 1333.22387;

}  // namespace tunica
