// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <vector>

#include "core/stability/base_state.hpp"

namespace tunica::stability {

/// A ripple of the wall and how it moves, d(t) ~ exp(s t).
struct StripMode {
  double wave_number;   ///< k, 1/cm
  int circumferential;  ///< m
  /// lambda = -s^2 in 1/s2. Real for the normal and the reference tether, whose loads are conservative
  /// about the ring; below 0 the ripple grows.
  std::complex<double> eigenvalue;
  double growth_rate;  ///< Re s, 1/s; 0 for a ripple that only oscillates
};

/// The wall of an axially periodic strip, linearised about the inflated ring, for ripples
///   d_r = f(R) cos(phase), d_theta = h(R) sin(phase), d_z = g(R) sin(phase), phase = k Z + m Theta:
/// a rotation by pi about a radius maps the wall into itself, so that these do not mix with ripples a
/// quarter of a wave further. The weak form is, for every test function v of the same kind,
///   rho int d''. v dX + int grad v : dP/dH : grad d dX
///     + int_inner v . d(p cof F N) dA + int_outer v . d(tether load) dA = 0,
/// averaged over the phase, so per radian and unit length with a factor 1/2 left out. k = m = 0 is
/// the limit of long waves: f is the inflation of the ring, h and g turn and shift it.
class Strip {
 public:
  /// At m = 0 the wall twists only on request: with fibre families of equal weight at +beta and -beta,
  /// d_theta is then on its own.
  explicit Strip(const BaseState& base, int circumferential = 0, bool twist = false);

  /// Of the unknowns: f, (h,) g of the first node, of the second, ...
  Eigen::MatrixXd stiffness(double wave_number) const;
  Eigen::MatrixXd mass(double density) const;
  /// Unloaded radii of the nodes, cm.
  const std::vector<double>& nodes() const { return nodes_; }
  /// Components of the displacement, of axes (r, theta, z), in the order of the unknowns at a node.
  const std::vector<int>& components() const { return components_; }

  /// The mode that grows fastest; when none grows, the one of least frequency. Waves shorter than what the
  /// base state resolves are not excluded.
  StripMode least_mode(double wave_number, double density) const;

  /// The stiffness of the outer surface: what is left of K when the nodes within the wall are in
  /// equilibrium, dyn/cm2 per cm of ripple. Empty when the wall ripples even with its outer surface
  /// held. Costs a few per cent of least_mode.
  Eigen::MatrixXd surface_stiffness(double wave_number) const;
  /// True when no ripple of this wave number grows monotonically out of the base state: K is positive
  /// definite, or, where the tether makes it unsymmetric, the surface stiffness has no eigenvalue below 0.
  bool is_stable(double wave_number) const;

 private:
  /// K = K0 + k K1 + k^2 K2 of a cell or a surface.
  struct Polynomial {
    std::array<Eigen::MatrixXd, 3> terms;
    Eigen::MatrixXd at(double k) const { return terms[0] + k * (terms[1] + k * terms[2]); }
  };
  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(components_.size()); }
  void add_cell(const BaseState& base, std::size_t cell);
  Polynomial surface(const SurfaceState& state) const;

  int circumferential_;
  std::vector<int> components_;
  std::vector<Polynomial> cells_;
  std::vector<Eigen::MatrixXd> masses_;  ///< of the cells, for one component at density 1
  Polynomial inner_, outer_;
  std::vector<double> nodes_;
};

}  // namespace tunica::stability
