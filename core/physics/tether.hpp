// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/physics/surface.hpp"
#include "core/radial/ring.hpp"

namespace tunica::physics {

/// Surrounding tissue as a Robin condition of stiffness K on the outer surface (paper eq. 19).
struct Tether {
  double stiffness;  ///< K, dyn/cm3
  radial::TetherTraction traction = radial::TetherTraction::normal;
};

/// The tether's term in the weak form, int t . phi dA over the reference surface with outward normal N:
///   normal     t = K (d.N) n da/dA + K (I - N x N) d, a pressure outside and springs along the surface;
///   reference  t = K d, as printed;     current  t = K d da/dA.
template <class S>
Vector<S> tether_load(const Tether& tether, const Vector<S>& displacement, const Tensor<S>& gradient,
                      const Vector<double>& normal) {
  using std::sqrt;
  Vector<S> load;
  if (tether.traction == radial::TetherTraction::reference) {
    for (int i = 0; i < 3; ++i) load[i] = tether.stiffness * displacement[i];
    return load;
  }
  const Vector<S> area = oriented_area(gradient, normal);
  if (tether.traction == radial::TetherTraction::current) {
    const S size = sqrt(dot(area, area));
    for (int i = 0; i < 3; ++i) load[i] = tether.stiffness * size * displacement[i];
    return load;
  }
  const S outward = displacement[0] * normal[0] + displacement[1] * normal[1] + displacement[2] * normal[2];
  for (int i = 0; i < 3; ++i)
    load[i] = tether.stiffness * (outward * area[i] + (displacement[i] - outward * normal[i]));
  return load;
}

/// Compressive normal Cauchy traction of the tether, dyn/cm2: the external pressure.
template <class S>
S external_pressure(const Tether& tether, const Vector<S>& displacement, const Tensor<S>& gradient,
                    const Vector<double>& normal) {
  const Vector<S> area = oriented_area(gradient, normal);
  return dot(tether_load(tether, displacement, gradient, normal), area) / dot(area, area);
}

}  // namespace tunica::physics
