// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "core/chebyshev.hpp"
#include "core/radial/wall_curve.hpp"

namespace tunica::lumped {

/// Fibres and stress at the places of a wall's curve as functions of the lumen stretch.
///
/// They depend on nothing else, so that runs of one wall, and the many rows of one run, share what is
/// tabulated: Chebyshev series on the pieces of the curve, made when first asked for. Where a series does not
/// resolve a piece, values are computed from the law as they are asked for.
///
/// Not safe for use by several threads at once, as the curve.
class PlaceTable {
 public:
  explicit PlaceTable(const radial::WallCurve& curve);

  struct Fiber {
    double angle;  ///< rad, see wall::FiberState
    double stretch;
    double recruitment;
  };

  /// Von Mises stress, dyn/cm2.
  double von_mises(radial::LumenStretch stretch, int place) const;
  /// Of the first family of the place's law; none where it has no fibres.
  std::optional<Fiber> fiber(radial::LumenStretch stretch, int place) const;

  /// The same from the law itself.
  double computed_von_mises(radial::LumenStretch stretch, int place) const;
  std::optional<Fiber> computed_fiber(radial::LumenStretch stretch, int place) const;

 private:
  /// Series of values of one kind at one place on a piece, one after the other; empty where they do not
  /// resolve it.
  using Series = std::vector<double>;
  struct Piece {
    double lower, upper;
    std::vector<std::optional<Series>> von_mises, fibers;  ///< by place, once they have been asked for
  };

  Piece& piece_at(radial::LumenStretch stretch) const;
  template <class Values>
  Series series_of(const Piece& piece, int kinds, const Values& values) const;
  double at(const Piece& piece, const Series& series, int kind, radial::LumenStretch stretch) const;
  Tensor<double> gradient(radial::LumenStretch stretch, int place) const;
  const wall::Law<double>& law(int place) const;
  /// Angle, stretch and I4bar - a^2, which the recruited share follows from.
  std::array<double, 3> fiber_values(const wall::CollagenFamily<double>& family, radial::LumenStretch stretch,
                                     int place) const;

  const radial::WallCurve& curve_;
  std::vector<std::size_t> layers_;  ///< of the places
  ChebyshevBasis basis_;
  mutable std::map<double, Piece> pieces_;  ///< by their upper end
  mutable Piece* last_ = nullptr;
};

}  // namespace tunica::lumped
