// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/quadrature.hpp"
#include "core/radial/fronts.hpp"
#include "core/radial/ring.hpp"

namespace tunica::radial {

/// Ring of exactly incompressible tissue. The motion follows from the lumen stretch s alone,
///   r^2 = R^2 + (s^2 - 1) R0^2,
/// and equilibrium gives the pressure as an integral over the wall,
///   p = p_ext + int (tau_TT - tau_RR) R / r^2 dR,
/// taken by Gauss rules between the recruitment fronts.
class IncompressibleRing final : public RingModel {
 public:
  IncompressibleRing(Ring<double> ring, std::vector<Seeded> seeded, int points = 12);

  RingResponse respond(LumenStretch lumen_stretch, std::span<const double> places,
                       bool derivatives) const override;
  const Ring<double>& ring() const override { return ring_; }
  std::span<const Seeded> seeded() const override { return seeded_; }

 private:
  /// An interval of the mesh as it moves with the lumen strain and the parameters: boundaries between
  /// layers follow their shares, and fronts their threshold where the stress jumps there (elsewhere it
  /// is continuous, and where the integral is split does not matter).
  template <class P, class S>
  MovingInterval<S> moved(const Ring<P>& ring, const S& lumen_strain, const Interval& cell) const;
  /// Integral of the deviatoric term from the lumen to xi = end.
  template <class P, class S>
  S integral(const Ring<P>& ring, const S& lumen_strain, const std::vector<Interval>& mesh, double end) const;

  Ring<double> ring_;
  std::vector<Seeded> seeded_;
  std::vector<QuadraturePoint> rule_;
  std::vector<double> boundaries_;
};

}  // namespace tunica::radial
