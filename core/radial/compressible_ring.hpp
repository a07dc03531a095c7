// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/element/line.hpp"
#include "core/radial/fronts.hpp"
#include "core/radial/ring.hpp"

namespace tunica::radial {

/// Ring of a law with finite compressibility, by spectral elements that end at the recruitment fronts.
///
/// The unknown is the area, per radian, that has moved past a circle of the reference,
///   v(R) = (r^2 - R^2)/2 = v_i + w(R),  w(R_i) = 0,  v_i = (s^2 - 1) R_i^2/2,
/// since then J - 1 = w'/R exactly: tissue of any bulk modulus is computed without cancellation, and w is
/// nothing but what the compression adds to the motion of incompressible tissue.
///
/// Weak form, for every test function q(R), with tau the Kirchhoff stress and p_ext the tether's pressure:
///   int [(tau_RR/J) q' + R (tau_TT - tau_RR)/r^2 q] dR + p_ext(u(R_o)) q(R_o) = p q(R_i).
/// v_i is prescribed and the pressure read off by q = 1, an integral without the hydrostatic stress, which
/// stays regular where dp/ds vanishes.
class CompressibleRing final : public RingModel {
 public:
  struct Options {
    int degree = 10;          ///< of each element
    int points = 12;          ///< of its Gauss rule
    double accuracy = 1e-10;  ///< relative, of the responses
    /// Relative error of w that Newton's method may leave for the last step, which a response makes itself.
    double left_by_newton = 1e-13;
    double kink = finest_kink;  ///< how closely elements end at fronts
  };

  CompressibleRing(Ring<double> ring, std::vector<Seeded> seeded, Options options);
  CompressibleRing(Ring<double> ring, std::vector<Seeded> seeded)
      : CompressibleRing(std::move(ring), std::move(seeded), Options{}) {}

  RingResponse respond(LumenStretch lumen_stretch, std::span<const double> places,
                       bool derivatives) const override;
  double accuracy() const override;
  const Ring<double>& ring() const override { return ring_; }
  std::span<const Seeded> seeded() const override { return seeded_; }

 private:
  struct Solution;
  struct System;

  Solution solve(LumenStretch lumen_stretch) const;
  /// The motion of incompressible tissue.
  Solution incompressible(LumenStretch lumen_stretch) const;
  /// Newton's method and refitting of the mesh to the fronts in turn, from a guess.
  Solution solve_from(const Ring<double>& ring, LumenStretch lumen_stretch, const Solution& guess) const;
  /// For stress that jumps at recruitment: from a wide step to the ring's own.
  Solution solve_by_sharpening(LumenStretch lumen_stretch) const;
  /// For laws that the incompressible guess is too far from: from a bulk modulus that keeps it close down to
  /// the ring's own.
  Solution solve_by_softening(LumenStretch lumen_stretch) const;
  /// For laws without a bulk modulus: from rest in growing steps.
  Solution solve_by_stretching(LumenStretch lumen_stretch) const;
  Solution refitted(const Solution& solution, LumenStretch lumen_stretch,
                    const std::vector<Front>& fronts) const;
  bool newton(const Ring<double>& ring, Solution& solution) const;
  void assemble(const Ring<double>& ring, const Solution& solution, System& system) const;
  template <class P>
  struct Residual {
    std::vector<P> nodal;
    P pressure;  ///< in the lumen, from the weak form tested with 1
  };
  template <class P>
  Residual<P> residual(const Ring<P>& ring, const Solution& solution, const P& inner) const;
  template <class P, class S>
  struct Place {
    std::size_t layer;
    P radius;
    S area, area_slope;  ///< v and dv/dR
  };
  /// Where v = inner + the field of the nodal values, P as in Ring, S with changes of the motion.
  template <class P, class S>
  Place<P, S> place_of(const Ring<P>& ring, const Solution& solution, const S& inner,
                       const std::vector<S>& nodal, double xi) const;
  /// The state there.
  template <class P, class S>
  WallState<S> state(const Ring<P>& ring, const Solution& solution, const S& inner,
                     const std::vector<S>& nodal, double xi) const;
  Field field(const Solution& solution) const;

  Ring<double> ring_;
  Ring<double> merged_;  ///< what is computed with: mirror images among the families taken together
  std::vector<Seeded> seeded_;
  Options options_;
  element::Line line_;
  std::vector<double> boundaries_;
};

}  // namespace tunica::radial
