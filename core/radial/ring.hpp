// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/wall/law.hpp"

/// Static equilibrium of the thick ring: the wall of a long straight artery held at constant length.
namespace tunica::radial {

/// How the surrounding tissue pulls on the outer surface (see docs/theory/core.md, "Tether").
enum class TetherTraction { normal, reference, current };

/// The ring as a boundary-value problem on the reference radius R = inner_radius + xi thickness,
/// xi in [0, 1]: plane strain, lumen pressure on the current inner surface, tether on the outer one.
/// P is double, or a dual that carries the derivative with respect to a parameter.
template <class P>
struct Ring {
  P inner_radius;      ///< R0, cm
  P thickness;         ///< h, cm
  P tether_stiffness;  ///< K, dyn/cm3
  TetherTraction traction = TetherTraction::normal;
  bool incompressible = false;  ///< J = 1 exactly; the volumetric term of the laws is then not used
  wall::Wall<P> layers;         ///< from the lumen outwards; shares are relative to their sum

  /// xi may be a dual, for places that move with a parameter.
  template <class X>
  auto radius(const X& xi) const {
    return inner_radius + thickness * xi;
  }

  /// Tether force per radian and unit length for the displacement u of the outer surface: K u times
  /// the current radius (normal, current) or the reference radius (reference). The three readings
  /// differ in direction only where the surface turns or slides, which a ring does not.
  template <class S>
  S tether_force(const S& outer_displacement) const {
    const P outer_radius = radius(1.0);
    const S arm =
        traction == TetherTraction::reference ? S(outer_radius) : S(outer_radius + outer_displacement);
    return tether_stiffness * outer_displacement * arm;
  }

  /// Compressive normal Cauchy traction of the tether on the outer surface, dyn/cm2.
  template <class S>
  S external_pressure(const S& outer_displacement) const {
    return tether_force(outer_displacement) / (radius(1.0) + outer_displacement);
  }
};

/// How far the lumen is opened: its radius over the unloaded one. Kept as the strain, stretch - 1, which a
/// stiff wall has too little of to be told from the round-off of a number near 1.
class LumenStretch {
 public:
  LumenStretch(double stretch) : strain_(stretch - 1) {}  // NOLINT(google-explicit-constructor): a number
  static LumenStretch of_strain(double strain) {
    LumenStretch stretch(1.0);
    stretch.strain_ = strain;
    return stretch;
  }
  double strain() const { return strain_; }
  double value() const { return 1 + strain_; }

 private:
  double strain_;
};

/// State of the wall at one place, P as in Ring.
template <class P>
struct WallState {
  P displacement;   ///< u, cm
  P radial_slope;   ///< du/dR
  P radial_stress;  ///< Cauchy stress along the radius, dyn/cm2
};

/// Equilibrium at a given stretch of the lumen.
struct RingResponse {
  double pressure;                        ///< in the lumen, dyn/cm2
  double pressure_slope;                  ///< dp/ds at fixed parameters: the inverse compliance
  std::vector<WallState<double>> states;  ///< at the places asked for
  /// d/d(lumen stretch) of displacement and radial slope there (the stress rate is not computed: 0).
  std::vector<WallState<double>> state_rates;
  /// For each parameter: derivatives at fixed lumen stretch.
  std::vector<double> pressure_derivatives;
  std::vector<std::vector<WallState<double>>> state_derivatives;  ///< [parameter][place]
};

/// A thick ring that can be asked for its equilibrium. `parameters` of the constructor holds one
/// seeded copy of the ring per parameter that derivatives are wanted for.
class RingModel {
 public:
  using Seeded = Ring<Dual<double, 1>>;
  virtual ~RingModel() = default;

  /// Equilibrium with the inner surface at radius lumen_stretch * inner_radius, and the states at
  /// `places` (xi in [0, 1]). With `derivatives`, those with respect to the parameters as well.
  /// Throws SolverFailure when there is none or it is not found; the message says why.
  virtual RingResponse respond(LumenStretch lumen_stretch, std::span<const double> places,
                               bool derivatives) const = 0;

  /// Relative accuracy of the responses; finer detail in them is noise.
  virtual double accuracy() const { return 1e-10; }

  virtual const Ring<double>& ring() const = 0;
  virtual std::span<const Seeded> seeded() const = 0;
};

}  // namespace tunica::radial
