// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "core/chebyshev.hpp"
#include "core/radial/ring.hpp"

namespace tunica::radial {

/// The lumen stretch at which a collagen family reaches its threshold I4bar = a^2 at a place.
struct Threshold {
  int place;                        ///< index into the places of the curve
  std::size_t layer, family;        ///< family as it is numbered in its layer
  double stretch;                   ///< of the lumen
  std::vector<double> derivatives;  ///< of that stretch, for each parameter
};

/// Pressure and wall states as functions of the lumen stretch, tabulated once and then evaluated in
/// nanoseconds: piecewise Chebyshev series whose pieces end where a recruitment front enters or
/// leaves the wall or passes a place, since derivatives jump there. Pieces are made when first asked
/// for and are as narrow as it takes for the last coefficients to be below the accuracy of the model,
/// and for the wall to have an equilibrium throughout.
///
/// A quantity f is tabulated as (f(s) - f(1))/(s - 1), so that it keeps its relative accuracy at the
/// strains of any stiff wall.
///
/// Not safe for use by several threads at once (the table grows on reading).
class WallCurve {
 public:
  /// `places`: xi in [0, 1] where states are wanted.
  WallCurve(std::unique_ptr<const RingModel> model, std::vector<double> places);

  /// Range of lumen stretch that is tabulated; outside it every query throws SolverFailure.
  static constexpr double least_stretch = 0.3;
  static constexpr double greatest_stretch = 4.0;

  double pressure(LumenStretch stretch) const { return evaluate(stretch, 0); }
  double pressure_slope(LumenStretch stretch) const { return evaluate(stretch, 1); }
  double displacement(LumenStretch stretch, int place) const { return evaluate(stretch, 2 + 2 * place); }
  double radial_slope(LumenStretch stretch, int place) const { return evaluate(stretch, 3 + 2 * place); }
  /// d/d(stretch) of a place's displacement and radial slope.
  double displacement_rate(LumenStretch stretch, int place) const {
    return differentiate(stretch, 2 + 2 * place);
  }
  double radial_slope_rate(LumenStretch stretch, int place) const {
    return differentiate(stretch, 3 + 2 * place);
  }
  /// The same quantities' derivatives with respect to parameter number k, at fixed lumen stretch.
  double pressure_derivative(LumenStretch stretch, int k) const {
    return evaluate(stretch, parameter_channel(k));
  }
  double displacement_derivative(LumenStretch stretch, int k, int place) const {
    return evaluate(stretch, parameter_channel(k) + 1 + 2 * place);
  }
  double radial_slope_derivative(LumenStretch stretch, int k, int place) const {
    return evaluate(stretch, parameter_channel(k) + 2 + 2 * place);
  }

  /// The lumen stretch in equilibrium with a pressure. Throws SolverFailure when there is none.
  double stretch_at(double pressure) const;

  /// Makes the pieces between two stretches, so that later queries only evaluate.
  void prepare(double from, double to) const;

  /// The range around a stretch within which what is a smooth function of the wall's state is one of the
  /// stretch, too: that of one series.
  struct Smooth {
    double lower, upper;
  };
  Smooth smooth_around(LumenStretch stretch) const {
    const Piece& piece = piece_at(stretch.value());
    return {piece.lower, piece.upper};
  }

  const std::vector<Threshold>& thresholds() const { return thresholds_; }
  const RingModel& model() const { return *model_; }
  const std::vector<double>& places() const { return places_; }
  /// Number of equilibria that have been solved for.
  long solves() const { return solves_; }

 private:
  struct Piece {
    double lower;
    double upper;
    std::vector<double> coefficients;  ///< [channel][term]
  };
  struct Candidate;

  int channels() const;
  int parameter_channel(int k) const;
  const Piece& piece_at(double stretch) const;
  const Piece& build_at(double stretch) const;
  /// None when the piece is too wide for the model's accuracy. Throws SolverFailure where the wall has no
  /// equilibrium somewhere in it.
  std::optional<Piece> piece_between(double lower, double upper) const;
  /// All channels at a stretch, those that take no part being 0.
  std::vector<double> values_at(double stretch) const;
  double evaluate(LumenStretch stretch, int channel) const;
  double differentiate(LumenStretch stretch, int channel) const;
  void find_thresholds();
  std::vector<Candidate> candidates(const std::vector<double>& boundaries) const;
  /// Lumen stretch at which a family reaches its threshold at xi; none when it does not in the range.
  /// `compression`: what that of the last place came to over the one of incompressible tissue, nearly the
  /// same here.
  std::optional<double> threshold_stretch(const wall::CollagenFamily<double>& family, double xi,
                                          double& compression) const;
  std::vector<double> threshold_derivatives(std::size_t layer, std::size_t family, double xi,
                                            double stretch) const;
  RingResponse respond(double stretch, std::span<const double> places, bool derivatives) const;

  std::unique_ptr<const RingModel> model_;
  std::vector<double> places_;
  ChebyshevBasis basis_;  ///< on each piece; no piece is evaluated at its very ends
  std::vector<Threshold> thresholds_;
  std::vector<double> breaks_;
  mutable std::vector<double> at_rest_;     ///< the channels at stretch 1, once they have been asked for
  mutable std::set<double> edges_;          ///< that pieces end at
  mutable std::map<double, Piece> pieces_;  ///< by their upper end
  mutable const Piece* last_ = nullptr;
  mutable long solves_ = 0;
};

}  // namespace tunica::radial
