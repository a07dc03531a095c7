// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tunica::test_support {

/// Elastin by EXP1 (alpha, gamma) and two mirrored collagen families, written out in principal
/// stretches by hand: nothing of core/wall is used.
struct FiberTissue {
  double kappa = 9e6;
  double alpha = 3.5270e4, gamma = 0.3424;
  double fiber_alpha = 1.3370e5, fiber_gamma = 0.2141;
  double angle = 42.82;                ///< deg
  double activation_stretch = 1.5009;  ///< lambda_A
  int exponent = 2;
  double sharpness = 5e5;
  bool sharp = false;
};

struct ShotRing {
  double lumen_stretch;
  double pressure;            ///< in the lumen
  double inner_displacement;  ///< cm
  double excess_inner;        ///< I4bar - a^2 at the inner and outer surface: the front is inside
  double excess_outer;        ///< the wall when their signs differ
};

/// Solves d(R P_RR)/dR = P_TT, lambda_T = r/R, from the outer surface inwards by an adaptive
/// Runge-Kutta method of order 8 (GSL), with lambda_R = dr/dR from P_RR at every stage. The outer
/// displacement is given, so that nothing has to be shot at.
/// `outer_arm`: "normal", "current" (K u per current area) or "reference" (per reference area).
ShotRing shoot(const FiberTissue& tissue, double inner_radius, double thickness, double tether_stiffness,
               const std::string& reading, double outer_displacement);

}  // namespace tunica::test_support
