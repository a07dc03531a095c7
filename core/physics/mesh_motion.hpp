// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.hpp"

namespace tunica::physics {

/// How the mesh in the blood moves within the sections across a vessel, at a point.
struct MotionInSections {
  Vector<double> axis{};  ///< unit vector along the vessel; zero where the mesh moves as a whole
  double fade = 0;        ///< square of the rate at which motion along the axis fades off the wall, 1/cm2
  double lean = 0;        ///< what the sections' widening moves them by along the axis, cm
};

/// What is tested with a function (force) and its gradient (stress).
struct MeshMotionTerms {
  Vector<double> force;
  Tensor<double> stress;
};

/// Motion of the mesh in the blood. As a whole (paper eq. 1) the displacement of the interface is continued
/// by
///   int s dd/dX : dphi/dX dX = 0.
/// `stiffness` s is 1 for the harmonic continuation; larger in small cells, it moves deformation to the
/// large ones. Within sections, t being the axis,
///   int s [dd/dX (I - t t) : dphi/dX + f (t.d - l tr(dd/dX (I - t t))) t.phi] dX = 0
/// continues the displacement in each section on its own: harmonically across the vessel, whose widening
/// 2 u_r/R is then the trace, and along the axis as what falls off the wall with the rate sqrt(f), to l times
/// the widening.
inline MeshMotionTerms mesh_motion(double stiffness, const MotionInSections& sections,
                                   const Vector<double>& displacement, const Tensor<double>& gradient) {
  const Vector<double>& t = sections.axis;
  const Vector<double> along = gradient * t;
  MeshMotionTerms terms;
  terms.stress = stiffness * (gradient - outer(along, t));
  const double widening = trace(gradient) - dot(t, along);
  const double force = stiffness * sections.fade * (dot(t, displacement) - sections.lean * widening);
  terms.force = {force * t[0], force * t[1], force * t[2]};
  return terms;
}

}  // namespace tunica::physics
