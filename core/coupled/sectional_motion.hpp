// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace tunica::coupled {

/// How the mesh in the blood of a straight or bent vessel follows the wall, section by section. With s the
/// share of the radius and d the distance from the nearer clamped end in radii, R that of the lumen,
///
///   r = s (R + u_r(Z)),  z = Z + s^k u_z(Z) + (1 - s^k) b(Z),  b = +-c u_r(Z) exp(-(d/l)^2),
///
/// has J = (R + u_r) (1 + b') + s^k [(R + u_r) (u_z' - b') - k u_r' (u_z - b)], over R: positive where it is
/// at the surface, s = 1, and on the axis. A thin wall bulges over its clamp, so that 1 + u_z' < 0 there;
/// what is inside the bulge is then meshed from sections that b has moved into the vessel, and leads
/// outwards within R/k of the surface. Larger k bears more beside an end, where u_r' (u_z - b) < 0 in an
/// outlet, and less beyond, where the wall overshoots. Found on 600 random arteries, of which 6 fold with
/// these and 82 by harmonic motion.
struct SectionalMotion {
  static constexpr double power_at_end = 50, power = 6, power_reach = 0.4;
  static constexpr double lean = 0.55, lean_reach = 1.4;
  double inlet, outlet;  ///< heights of the ends, along the centreline
  bool inlet_is_clamped, outlet_is_clamped;

  /// k at a height of a vessel of radius R there.
  double power_at(double radius, double z) const {
    const double near = std::max(closeness(inlet_is_clamped, z - inlet, power_reach * radius),
                                 closeness(outlet_is_clamped, outlet - z, power_reach * radius));
    return power + (power_at_end - power) * near;
  }
  /// b over u_r.
  double lean_at(double radius, double z) const {
    // A short vessel has less room to move sections into.
    const double reach = std::min(lean_reach * radius, (outlet - inlet) / 3);
    return lean * reach / radius *
           (closeness(inlet_is_clamped, z - inlet, reach) - closeness(outlet_is_clamped, outlet - z, reach));
  }

 private:
  static double closeness(bool is_clamped, double distance, double reach) {
    return is_clamped ? std::exp(-std::pow(distance / reach, 2)) : 0.0;
  }
};

}  // namespace tunica::coupled
