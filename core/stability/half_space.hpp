// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/stability/base_state.hpp"

namespace tunica::stability {

/// A surface of the wall under ripples that are short against its thickness, so that the wall is a half-space
/// of the tissue at the surface: phase kappa (Z cos a + R Theta sin a), dying out with the depth. The springs
/// of the tether are then negligible against what grows with kappa, and a ripple d of the surface takes the
/// traction kappa S(a) d. Where S has an eigenvalue below 0 every short wave grows, the shorter the
/// faster: the boundary condition fails to complement the equations (Agmon, Douglis and Nirenberg, Comm. Pure
/// Appl. Math. 17:35, 1964), and the problem is ill-posed whatever the mesh.
class HalfSpace {
 public:
  explicit HalfSpace(const SurfaceState& surface);

  /// S(a), dyn/cm2, of ripples that move as exp(c kappa t), `inertia` = rho c^2 (dyn/cm2). None when the
  /// tissue is not elliptic, so that it ripples within.
  std::optional<Eigen::Matrix3d> stiffness(double angle, double inertia = 0) const;
  /// Least real part of an eigenvalue of S(a), dyn/cm2; -infinity for tissue that is not elliptic.
  double least_stiffness(double angle, double inertia = 0) const;
  /// c of ripples that grow without oscillating, cm/s: those of wave length l at the rate 2 pi c / l. 0 when
  /// S(a) is positive, infinity for tissue that is not elliptic.
  double growth_speed(double angle, double density) const;

 private:
  SurfaceState surface_;
};

}  // namespace tunica::stability
