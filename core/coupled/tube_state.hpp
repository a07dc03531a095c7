// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/coupled/equations.hpp"
#include "core/coupled/loading.hpp"

namespace tunica::coupled {

/// Displacement of the lumen, over its radius, that a ring of the wall at mid-length has under a share of the
/// load: what states under different loads are compared by, since it grows more evenly than the load. The
/// share itself where there is no ring or it does not bear the load.
class RingMeasure {
 public:
  /// For loads from none to that of `pressure`.
  RingMeasure(const Loading& loading, double pressure);

  double at(double load) const;
  /// The ring bears the whole load: at(1) is a displacement.
  bool is_displacement() const { return most_ != 0; }

 private:
  bool exceeds(double stretch, double pressure) const;

  const Loading& loading_;
  double pressure_;
  double most_ = 0;  ///< bound of the displacements over the radius; 0 where loads are the measure
};

/// Estimate of the steady state under the loads of a time, for Newton's method to begin from: the wall of a
/// long tube of the ring at mid-length, whose tissue keeps its volume,
///   r^2 = R^2 + (2 + e) e R0^2,   e the displacement of the lumen over its radius R0,
/// which clamped ends hold as they do a thin shell,
///   e(s) = e [1 - exp(-b s) (cos b s + sin b s)],   b^4 = 9/(4 Rm^2 h^2),   Rm the mean radius of the wall.
/// All moves along the radius alone, which keeps volumes at the ends, too. In it is Poiseuille's flow. Empty
/// for vessels that are no tubes (Loading::tube), and where the ring does not bear the load.
std::vector<double> tube_state(const Loading& loading, const Equations& equations, double time);

}  // namespace tunica::coupled
