// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "core/inlet.hpp"
#include "core/scene/seeded.hpp"
#include "lumped/wall_tables.hpp"

namespace tunica::lumped {

/// The numbers of the network that sensitivities may be asked for. P is double or a dual.
template <class P>
struct NetworkNumbers {
  P radius, length, viscosity, density;
  P inlet_scale;
  P resistance, outlet_pressure, proximal_resistance, compliance;
};

/// What can be seen from outside of the network at one moment.
template <class P>
struct Outside {
  P inflow, outflow;  ///< cm3/s
  P outlet_pressure;  ///< dyn/cm2
  P lumen_strain;     ///< of the section at mid-length: its lumen stretch - 1
  P pressure;         ///< there, dyn/cm2
};

/// State of one compartment.
struct Compartment {
  double pressure;      ///< dyn/cm2
  double lumen_radius;  ///< cm
  double outflow;       ///< cm3/s, to the next compartment or through the outlet
};

/// The artery as N compartments of nonlinear compliance in series, each the thick ring of the scene,
/// joined by the Poiseuille resistance of the deformed lumen and, as an option, by the inertance of
/// its blood. Unknowns, in this order along the artery:
///   e_i  growth of the lumen area of compartment i over its unloaded area (the squared lumen stretch - 1),
///   Q_i  flow from compartment i to the next, with inertance only,
///   p_c  pressure in the compliance of an rcr outlet.
/// Balance of mass (l = L/N):       pi R0^2 l de_i/dt = Q_(i-1) - Q_i
/// Balance of momentum:             I dQ_i/dt = p_i - p_(i+1) - R_p Q_i, or p_i - p_(i+1) = R_p Q_i
/// with R_p = 8 mu l/(pi r^4) and I = 4/3 rho l/(pi r^2) (parabolic profile), half of each neighbour's.
/// Outlet: p_out = p_v + R Q_N, or p_out = p_c + R_prox Q_N, C dp_c/dt = Q_N - (p_c - p_v)/R. Both implicit.
class Network {
 public:
  /// `parameters`: scene keys that derivatives are wanted for. Throws InvalidInput for one that this
  /// model does not depend on, and for a network that has no resistance where one is needed.
  Network(const Scene& scene, const std::vector<std::string>& parameters);

  int unknowns() const { return unknowns_; }
  int compartments() const { return compartments_; }
  int parameters() const { return static_cast<int>(seeded_.size()); }
  /// Half-width of the band of the Jacobian.
  int bandwidth() const { return std::min(2, unknowns_ - 1); }

  /// State at rest: no load, no flow.
  std::vector<double> rest() const;
  /// d(rest)/d(parameter k).
  std::vector<double> rest_derivative(int k) const;
  /// Typical magnitude of each unknown.
  const std::vector<double>& scales() const { return scales_; }
  /// What errors of each unknown are measured by at y: for an area what moves it, or the pressure that it
  /// takes, by as much as themselves, whichever is less. So a tolerance holds in pressure for walls of any
  /// stiffness.
  void magnitudes(const double* y, double* result) const;

  /// dy/dt. Throws SolverFailure when the wall has no equilibrium at y.
  void rate(double time, const double* y, double* dydt) const;
  /// Directional derivative of the rate along dy, plus d(rate)/d(parameter k) when k >= 0.
  void rate_derivative(double time, const double* y, const double* dy, int k, double* result) const;

  Outside<double> outside(double time, const double* y) const;
  /// Derivatives along dy and, when k >= 0, parameter k.
  Outside<Dual<double, 1>> outside_derivative(double time, const double* y, const double* dy, int k) const;
  /// The compartments from the inlet to the outlet.
  std::vector<Compartment> inside(double time, const double* y) const;
  /// Of the section at mid-length.
  radial::LumenStretch mid_stretch(const double* y) const;
  /// Of the compartment that is opened most.
  double greatest_stretch(const double* y) const;

  const Inlet& inlet() const { return inlet_; }
  /// Factor on the inlet's shape: mean flow (cm3/s) or pressure (dyn/cm2).
  double inlet_scale() const { return numbers_.inlet_scale; }
  const radial::WallCurve& curve() const { return wall_->curve; }
  const PlaceTable& places() const { return wall_->places; }
  /// The ring with parameter k seeded.
  const radial::Ring<Dual<double, 1>>& seeded_ring(int k) const { return wall_->curve.model().seeded()[k]; }

 private:
  template <class P>
  NetworkNumbers<P> numbers(const SeededScene<P>& scene) const;
  /// Sets the working pressure, too.
  std::vector<double> typical_sizes();
  template <class P>
  P curve_pressure(const P& strain, int k) const;
  /// Everything between the unknowns and their rates.
  template <class P>
  struct Flows {
    std::vector<P> pressure, resistance, inertance;  ///< of each compartment
    std::vector<P> flow;                             ///< 0: inlet, i: out of compartment i, N: outlet
    P inlet_pressure, outlet_pressure;
  };
  /// In the network's own room, until they are next asked for.
  template <class P>
  const Flows<P>& flows(const NetworkNumbers<P>& n, double time, const P* y, int k) const;
  template <class P>
  void rate_of(const NetworkNumbers<P>& n, double time, const P* y, int k, P* result) const;
  template <class P>
  Outside<P> outside_of(const NetworkNumbers<P>& n, double time, const P* y, int k) const;
  template <class P>
  P mid_strain_of(const P* y) const;

  int area_index(int compartment) const;
  /// Flow out of compartment i (0: the inlet's, with a pressure there); with inertance only.
  int flow_index(int link) const;

  int compartments_;
  bool inertance_, windkessel_;
  int unknowns_;
  Inlet inlet_;
  NetworkNumbers<double> numbers_;
  std::vector<NetworkNumbers<Dual<double, 1>>> seeded_;
  std::shared_ptr<const WallTable> wall_;  ///< of this thread's networks with the same wall
  double working_pressure_ = 0;            ///< dyn/cm2, of the size that the artery sees
  std::vector<double> scales_;
  mutable std::tuple<Flows<double>, Flows<Dual<double, 1>>> flows_;  ///< a network belongs to one thread
};

}  // namespace tunica::lumped
