// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tunica::living {

/// What living arteries have, from small ones of the brain to the aorta, in people's units, both ends
/// included.
struct Interval {
  double lowest, highest;
  constexpr bool contains(double value) const { return value >= lowest && value <= highest; }
};

inline constexpr Interval mean_pressure{30, 200};  ///< mmHg
inline constexpr Interval pressure{-10, 300};      ///< mmHg, at any moment
inline constexpr Interval mean_velocity{2, 150};   ///< cm/s

}  // namespace tunica::living
