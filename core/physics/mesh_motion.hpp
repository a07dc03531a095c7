// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.hpp"

namespace tunica::physics {

/// Motion of the mesh in the blood (paper eq. 1): the displacement of the interface is continued by
///   int s dd/dX : dphi/dX dX = 0.
/// `stiffness` s is 1 for the harmonic continuation; larger in small cells, it moves deformation to the
/// large ones.
template <class S>
Tensor<S> mesh_motion_flux(double stiffness, const Tensor<S>& displacement_gradient) {
  return stiffness * displacement_gradient;
}

}  // namespace tunica::physics
