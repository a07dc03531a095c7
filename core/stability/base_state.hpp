// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/element/line.hpp"
#include "core/radial/fronts.hpp"
#include "core/radial/ring.hpp"

/// Linear stability of the inflated wall against ripples.
namespace tunica::stability {

/// dP_k/dH_l, entries of both tensors row-major, axes (radial, circumferential, axial).
using Tangent = std::array<std::array<double, 9>, 9>;

/// How finely ripples are resolved through the wall. Elements halve towards both surfaces until they are as
/// narrow as the shortest wave is long, since a ripple of wave length l dies out within a depth of about l.
struct Resolution {
  int degree = 8;               ///< of the displacement in each element
  double shortest_wave = 0.05;  ///< wave length, as a share of the wall's thickness
};

/// A quadrature point of the strip.
struct MaterialPoint {
  double radius;    ///< R, cm
  double weight;    ///< of the volume integral per radian and unit length, cm2
  Tangent tangent;  ///< dyn/cm2
};

/// What the weak form has on a surface of the wall, int t . v dA with the load t of the displacement d and
/// its gradient H, linearised at the base state, and the tissue below.
struct SurfaceState {
  double radius;                                         ///< unloaded, cm
  double normal;                                         ///< radial component of the outward normal, -1 or 1
  std::array<std::array<double, 3>, 3> by_displacement;  ///< dt_i/dd_j, dyn/cm3
  std::array<std::array<double, 9>, 3> by_gradient;      ///< dt_i/dH_l, dyn/cm2
  Tangent tangent;                                       ///< of the tissue at the surface, dyn/cm2
};

/// The thick ring in equilibrium with a lumen pressure, linearised at the points of a radial mesh that ends
/// at the boundaries of layers and at the recruitment fronts.
struct BaseState {
  double lumen_stretch;
  double pressure;   ///< in the lumen, dyn/cm2
  double thickness;  ///< unloaded, cm
  element::Line line;
  std::vector<radial::Interval> cells;
  std::vector<double> half_widths;    ///< of the cells, cm
  std::vector<MaterialPoint> points;  ///< those of the first cell first
  SurfaceState inner;                 ///< under the lumen pressure, which follows the surface
  SurfaceState outer;                 ///< under the tether
};

/// Linearisation of the wall at a lumen stretch. Exactly incompressible tissue gets a bulk stiffness 1e5
/// times its largest other one: moduli of ripples are off by some 1e-5. Throws SolverFailure when the ring
/// has no equilibrium there.
BaseState base_state(const radial::RingModel& model, double lumen_stretch, const Resolution& resolution = {});

/// The lumen stretch in equilibrium with a pressure, the nearest to rest on the side that the pressure pushes
/// to. Throws SolverFailure when there is none.
double lumen_stretch_at(const radial::RingModel& model, double pressure);

}  // namespace tunica::stability
