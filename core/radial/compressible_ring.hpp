// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/element/line.hpp"
#include "core/radial/fronts.hpp"
#include "core/radial/ring.hpp"

namespace tunica::radial {

/// Ring of a law with finite compressibility, by spectral elements that end at the recruitment fronts.
///
/// Weak form, for every test function v(R):
///   int [P_RR v' + P_TT v/R] R dR + T(u(R_o)) v(R_o) = p r_i v(R_i),
/// with T the tether force and r_i the current inner radius. The displacement of the inner surface is
/// prescribed and the pressure read off its equation, which stays regular where dp/ds vanishes.
class CompressibleRing final : public RingModel {
 public:
  struct Options {
    int degree = 8;   ///< of each element
    int points = 10;  ///< of its Gauss rule
  };

  CompressibleRing(Ring<double> ring, std::vector<Seeded> seeded, Options options);
  CompressibleRing(Ring<double> ring, std::vector<Seeded> seeded)
      : CompressibleRing(std::move(ring), std::move(seeded), Options{}) {}

  RingResponse respond(double lumen_stretch, std::span<const double> places, bool derivatives) const override;
  double accuracy() const override;
  const Ring<double>& ring() const override { return ring_; }
  std::span<const Seeded> seeded() const override { return seeded_; }

 private:
  struct Solution;
  struct System;

  Solution solve(double lumen_stretch) const;
  /// Newton's method and refitting of the mesh to the fronts in turn, from a guess.
  Solution solve_from(const Ring<double>& ring, double lumen_stretch, const Field& guess) const;
  /// For stress that jumps at recruitment: from a wide step to the ring's own.
  Solution solve_by_sharpening(double lumen_stretch, const Field& guess) const;
  /// For laws that the incompressible guess is too far from: from rest in growing steps.
  Solution solve_by_stretching(double lumen_stretch) const;
  void interpolate(const Field& field, Solution& solution) const;
  bool newton(const Ring<double>& ring, Solution& solution) const;
  void assemble(const Ring<double>& ring, const Solution& solution, System& system) const;
  template <class P>
  struct Residual {
    std::vector<P> nodal;
    P reaction;  ///< p r_i, from the weak form tested with v = 1
  };
  template <class P>
  Residual<P> residual(const Ring<P>& ring, const Solution& solution, const P& inner_displacement) const;
  template <class P>
  WallState<P> state(const Ring<P>& ring, const Solution& solution, const std::vector<P>& displacement,
                     double xi) const;
  Field field(const Solution& solution) const;

  Ring<double> ring_;
  Ring<double> merged_;  ///< what is computed with: mirror images among the families taken together
  std::vector<Seeded> seeded_;
  Options options_;
  element::Line line_;
  std::vector<double> boundaries_;
};

}  // namespace tunica::radial
