// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/kinematics.hpp"

/// Pointwise physics: what the weak forms integrate, on 3x3 tensors, without knowing a mesh, its dimension
/// or a time scheme. Everything is per unit reference volume or area, and gradients are by reference
/// coordinates.
namespace tunica::physics {

struct Blood {
  double density;    ///< g/cm3
  double viscosity;  ///< dynamic, g/cm/s
};

template <class S>
struct BloodState {
  Vector<S> velocity;           ///< v, cm/s
  Tensor<S> velocity_gradient;  ///< dv/dX
  Vector<S> acceleration;       ///< dv/dt at a fixed point of the moving mesh
  S pressure;                   ///< p, dyn/cm2
  Vector<S> mesh_velocity;      ///< w, the rate of the mesh displacement
  Tensor<S> mesh_gradient;      ///< H = dd/dX of the mesh displacement d
};

template <class S>
struct BloodBalance {
  Vector<S> force;   ///< tested with phi
  Tensor<S> stress;  ///< tested with dphi/dX: J sigma F^-T
  S volume_rate;     ///< tested with q: J div v
};

/// Incompressible Navier-Stokes equations in arbitrary Lagrangian-Eulerian form (paper eq. 2), pulled back
/// by the mesh motion F = I + H:
///   int [ J rho (dv/dt|_X + grad v (v - w)) . phi + J sigma F^-T : dphi/dX ] dX  and  int q J div v dX,
///   sigma = -p I + mu (grad v + grad v^T),  grad v = dv/dX F^-1.
/// A uniform velocity solves them on any moving mesh.
template <class S>
BloodBalance<S> blood_balance(const Blood& blood, const BloodState<S>& state) {
  const Tensor<S> f = Tensor<S>::identity() + state.mesh_gradient;
  const Tensor<S> cof = cofactor(f);
  const S jacobian = f(0, 0) * cof(0, 0) + f(0, 1) * cof(0, 1) + f(0, 2) * cof(0, 2);
  // J grad v = dv/dX (J F^-1)
  const Tensor<S> gradient = state.velocity_gradient * transpose(cof);
  BloodBalance<S> balance;
  Vector<S> relative;
  for (int i = 0; i < 3; ++i) relative[i] = state.velocity[i] - state.mesh_velocity[i];
  const Vector<S> convection = gradient * relative;
  for (int i = 0; i < 3; ++i)
    balance.force[i] = blood.density * (jacobian * state.acceleration[i] + convection[i]);
  Tensor<S> sigma = (blood.viscosity / jacobian) * (gradient + transpose(gradient));
  for (int i = 0; i < 3; ++i) sigma(i, i) = sigma(i, i) - state.pressure;
  balance.stress = sigma * cof;
  balance.volume_rate = trace(gradient);
  return balance;
}

/// Flux tested with dq/dX that lets velocity and pressure have the same linear basis: the strong residual
/// of momentum in the direction of grad q (pressure-stabilising Petrov-Galerkin method; Tezduyar, Adv.
/// Appl. Mech. 28:1, 1992), J tau F^-1 [ rho dv/dt + rho grad v (v - w) + grad p ]. `time` is tau/rho, which
/// the caller takes from the size of the cell, in s cm3/g. Second derivatives of v vanish for linear bases.
template <class S>
Vector<S> pressure_stabilisation(const S& time, const BloodState<S>& state, const BloodBalance<S>& balance,
                                 const Vector<S>& pressure_gradient) {
  const Tensor<S> f = Tensor<S>::identity() + state.mesh_gradient;
  const Tensor<S> cof = cofactor(f);
  const S jacobian = f(0, 0) * cof(0, 0) + f(0, 1) * cof(0, 1) + f(0, 2) * cof(0, 2);
  Vector<S> residual = cof * pressure_gradient;
  for (int i = 0; i < 3; ++i) residual[i] = residual[i] + balance.force[i];
  Vector<S> flux = transpose(cof) * residual;
  for (int i = 0; i < 3; ++i) flux[i] = (time / jacobian) * flux[i];
  return flux;
}

/// tau/rho of pressure_stabilisation, s cm3/g: 1 / sqrt((2 rho c)^2 + (2 rho |v|/h)^2 + (12 mu/h^2)^2) for
/// the rate coefficient c (1/s) of the time scheme, |v|^2 and a cell of size h (cm). 0 where nothing limits
/// it: steady blood at rest without viscosity.
template <class S>
S stabilisation_time(const Blood& blood, double rate_coefficient, const S& square_of_speed, double size) {
  using std::sqrt;
  const double inertia = 2 * blood.density * rate_coefficient;
  const double convection = 2 * blood.density / size;
  const double viscosity = 12 * blood.viscosity / (size * size);
  const S sum = inertia * inertia + viscosity * viscosity + (convection * convection) * square_of_speed;
  return plain(sum) > 0 ? S(1.0 / sqrt(sum)) : S(0.0);
}

}  // namespace tunica::physics
