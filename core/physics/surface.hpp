// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.hpp"

namespace tunica::physics {

/// Loads on a surface, as terms of the weak form tested with phi: int traction . phi dA over the reference
/// surface. `gradient` is dd/dX along the surface: what it maps the reference normal N to does not matter,
/// because the current oriented area n da = cof(F) N dA depends on the tangents alone.
template <class S>
Vector<S> oriented_area(const Tensor<S>& gradient, const Vector<double>& normal) {
  return cofactor(Tensor<S>::identity() + gradient) * normal;
}

/// A pressure p that pushes against the outward current normal: p n da, so that sigma n = -p n.
template <class S>
Vector<S> pressure_load(const S& pressure, const Vector<S>& area) {
  return {pressure * area[0], pressure * area[1], pressure * area[2]};
}

/// Flow through the current surface, (v - w) . n da.
template <class S>
S flow_density(const Vector<S>& velocity, const Vector<S>& mesh_velocity, const Vector<S>& area) {
  Vector<S> relative;
  for (int i = 0; i < 3; ++i) relative[i] = velocity[i] - mesh_velocity[i];
  return dot(relative, area);
}

/// beta of backflow_load that takes out just the energy that blood brings in.
inline constexpr double energy_of_backflow = 0.5;

/// Resistance of an open boundary against blood that flows in through it, -beta rho min((v - w).n, 0) v da:
/// takes out the energy that such blood would bring in (Bazilevs et al., Comput. Methods Appl. Mech. Eng.
/// 198:3534, 2009). beta = 1/2 takes out just that: the traction under a pressure p is then
/// -(p - rho v^2/2) n where blood comes in along n, so that p is its total pressure.
template <class S>
Vector<S> backflow_load(double beta, double density, const S& flow, const Vector<S>& velocity) {
  if (plain(flow) >= 0) return {S(0.0), S(0.0), S(0.0)};
  const S rate = (-beta * density) * flow;
  return {rate * velocity[0], rate * velocity[1], rate * velocity[2]};
}

}  // namespace tunica::physics
