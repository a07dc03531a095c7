// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/radial/wall_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/frame.hpp"
#include "core/radial/fronts.hpp"
#include "core/root.hpp"

namespace tunica::radial {

namespace {

/// Pieces are at first not wider than this.
constexpr double greatest_piece = 0.2;
/// Pieces are not split below this: a kink that the thresholds do not know (exponent 1 lingers at its
/// threshold) is then met to within the square of it.
constexpr double least_piece = 2e-3;
/// Nor below this where the wall ceases to have an equilibrium.
constexpr double least_foothold = 1e-5;
/// Of the channels, the slope of pressure stands for itself.
constexpr int slope_channel = 1;

/// Terms of the series on each piece: where less is asked for, fewer states are solved for.
int terms_for(double accuracy) {
  return accuracy < 1e-8 ? 12 : 6;
}

/// I4bar - a^2 at a state that changes along a direction, its derivative along it included. P as in Ring.
template <class P>
Dual<double, 1> excess_along(const wall::CollagenFamily<P>& family, const Ring<P>& ring, double xi,
                             const WallState<double>& state, const WallState<double>& change) {
  using D = Dual<double, 1>;
  const auto k = frame::Radial::kinematics(D(state.displacement, {change.displacement}),
                                           D(state.radial_slope, {change.radial_slope}), D(ring.radius(xi)));
  return family.excess(k, frame::Radial::axes());
}

}  // namespace

WallCurve::WallCurve(std::unique_ptr<const RingModel> model, std::vector<double> places)
    : model_(std::move(model)), places_(std::move(places)), basis_(terms_for(model_->accuracy())) {
  find_thresholds();
  double lower = least_stretch;
  edges_.insert(lower);
  breaks_.push_back(greatest_stretch);
  for (const double end : breaks_) {
    if (!(end > lower + 1e-9)) continue;
    const int parts = static_cast<int>(std::ceil((end - lower) / greatest_piece));
    for (int k = 1; k <= parts; ++k) edges_.insert(k == parts ? end : lower + (end - lower) * k / parts);
    lower = end;
  }
}

int WallCurve::channels() const {
  return parameter_channel(static_cast<int>(model_->seeded().size()));
}

int WallCurve::parameter_channel(int k) const {
  const int places = static_cast<int>(places_.size());
  return 2 + 2 * places + k * (1 + 2 * places);
}

RingResponse WallCurve::respond(double stretch, std::span<const double> places, bool derivatives) const {
  ++solves_;
  return model_->respond(stretch, places, derivatives);
}

/// A place, and the layer whose tissue is meant where two meet.
struct WallCurve::Candidate {
  double xi;
  std::size_t layer;
  int place;  ///< -1: a boundary of layers that is no place of the curve
};

std::vector<WallCurve::Candidate> WallCurve::candidates(const std::vector<double>& boundaries) const {
  std::vector<Candidate> all;
  for (std::size_t k = 0; k < places_.size(); ++k)
    all.push_back({places_[k], layer_at(boundaries, places_[k]), static_cast<int>(k)});
  for (std::size_t layer = 0; layer + 1 < boundaries.size(); ++layer) {
    for (const double xi : {boundaries[layer], boundaries[layer + 1]}) {
      const bool is_place = std::any_of(all.begin(), all.end(), [&](const Candidate& candidate) {
        return candidate.layer == layer && candidate.xi == xi;
      });
      if (!is_place) all.push_back({xi, layer, -1});
    }
  }
  return all;
}

void WallCurve::find_thresholds() {
  const Ring<double>& ring = model_->ring();
  const auto boundaries = layer_boundaries(ring);
  double compression = 1;
  for (const Candidate& candidate : candidates(boundaries)) {
    // A place just inside its layer reads the slope of that layer.
    const double xi =
        std::clamp(candidate.xi, boundaries[candidate.layer] + 1e-12, boundaries[candidate.layer + 1]);
    const auto& families = wall::families(ring.layers[candidate.layer].law);
    for (std::size_t f = 0; f < families.size(); ++f) {
      const auto& family = families[f];
      const bool mirrored = std::any_of(families.begin(), families.begin() + f, [&](const auto& earlier) {
        return std::abs(earlier.angle) == std::abs(family.angle) &&
               earlier.activation_squared == family.activation_squared;
      });
      if (mirrored) continue;
      const auto stretch = threshold_stretch(family, xi, compression);
      if (!stretch) continue;
      breaks_.push_back(*stretch);
      if (candidate.place >= 0)
        thresholds_.push_back({candidate.place, candidate.layer, f, *stretch,
                               threshold_derivatives(candidate.layer, f, xi, *stretch)});
    }
  }
  std::sort(breaks_.begin(), breaks_.end());
}

std::optional<double> WallCurve::threshold_stretch(const wall::CollagenFamily<double>& family, double xi,
                                                   double& compression) const {
  if (family.activation_squared == 1.0) return 1.0;  // the unloaded state
  // Where incompressible tissue would be recruited: hoop stretch^2 cos^2 + sin^2 = a^2.
  const Ring<double>& ring = model_->ring();
  const double cosine = std::cos(family.angle), sine = std::sin(family.angle);
  const double hoop_squared = (family.activation_squared - sine * sine) / (cosine * cosine);
  const double ratio = ring.radius(xi) / ring.inner_radius;
  const double squared = 1 + (hoop_squared - 1) * ratio * ratio;
  if (!(cosine > 1e-6) || !(squared > least_stretch * least_stretch)) return std::nullopt;

  const double guess = std::sqrt(squared);
  if (!(guess < greatest_stretch)) return std::nullopt;
  try {
    double stretch = guess * compression;
    constexpr int most_iterations = 6;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const auto response = respond(stretch, std::array{xi}, false);
      const auto x = excess_along(family, ring, xi, response.states[0], response.state_rates[0]);
      const double update = -x.value / x.derivative[0];
      stretch += update;
      // Newton's method: the next update would be about the square of this one, below what the model
      // resolves.
      if (update * update < 1e-4 * model_->accuracy()) {
        compression = stretch / guess;
        return stretch;
      }
    }
    // Tissue whose stress jumps lingers at the threshold, which Newton's method does not foresee.
    const auto excess = [&](double s) {
      const auto state = respond(s, std::array{xi}, false).states[0];
      return fiber_excess(family, ring, xi, state.displacement, state.radial_slope);
    };
    const double margin = 0.03 * guess;
    const double lower = std::max(least_stretch, guess - margin),
                 upper = std::min(greatest_stretch, guess + margin);
    if ((excess(lower) > 0) == (excess(upper) > 0)) return std::nullopt;
    return find_root(excess, lower, upper, 1e-10);
  } catch (const SolverFailure&) {
    return std::nullopt;  // no equilibrium there, so no threshold either
  }
}

std::vector<double> WallCurve::threshold_derivatives(std::size_t layer, std::size_t family, double xi,
                                                     double stretch) const {
  std::vector<double> derivatives;
  if (model_->seeded().empty()) return derivatives;
  const auto response = respond(stretch, std::array{xi}, true);
  const auto& law_family = wall::families(model_->ring().layers[layer].law)[family];
  const double by_stretch =
      excess_along(law_family, model_->ring(), xi, response.states[0], response.state_rates[0]).derivative[0];
  for (std::size_t p = 0; p < model_->seeded().size(); ++p) {
    const auto& ring = model_->seeded()[p];
    const auto& seeded_family = wall::families(ring.layers[layer].law)[family];
    const auto by_parameter =
        excess_along(seeded_family, ring, xi, response.states[0], response.state_derivatives[p][0]);
    derivatives.push_back(-by_parameter.derivative[0] / by_stretch);
  }
  return derivatives;
}

std::vector<double> WallCurve::values_at(double stretch) const {
  const RingResponse response = respond(stretch, places_, !model_->seeded().empty());
  std::vector<double> values(channels(), 0.0);
  values[0] = response.pressure;
  values[slope_channel] = response.pressure_slope;
  for (std::size_t p = 0; p < places_.size(); ++p) {
    values[2 + 2 * p] = response.states[p].displacement;
    values[3 + 2 * p] = response.states[p].radial_slope;
  }
  for (std::size_t q = 0; q < response.pressure_derivatives.size(); ++q) {
    const std::size_t first = parameter_channel(static_cast<int>(q));
    values[first] = response.pressure_derivatives[q];
    for (std::size_t p = 0; p < places_.size(); ++p) {
      values[first + 1 + 2 * p] = response.state_derivatives[q][p].displacement;
      values[first + 2 + 2 * p] = response.state_derivatives[q][p].radial_slope;
    }
  }
  return values;
}

std::optional<WallCurve::Piece> WallCurve::piece_between(double lower, double upper) const {
  if (at_rest_.empty()) at_rest_ = values_at(1.0);
  const int count = channels(), terms = basis_.terms();
  const int places = static_cast<int>(places_.size());
  std::vector<double> values(static_cast<std::size_t>(count) * terms);
  for (int k = 0; k < terms; ++k) {
    const double stretch = 0.5 * (lower + upper) + 0.5 * (upper - lower) * basis_.node(k);
    const std::vector<double> here = values_at(stretch);
    for (int c = 0; c < count; ++c)
      values[c * terms + k] = c == slope_channel ? here[c] : (here[c] - at_rest_[c]) / (stretch - 1);
  }
  Piece piece{lower, upper, std::vector<double>(values.size())};
  const auto of_channel = [&](std::vector<double>& all, int c) {
    return std::span(all).subspan(static_cast<std::size_t>(c) * terms, terms);
  };
  for (int c = 0; c < count; ++c) basis_.fit(of_channel(values, c), of_channel(piece.coefficients, c));

  // Pressure, displacements and slopes decide; derivatives with respect to parameters are as smooth.
  double least = std::abs(values[0]), greatest = least;
  for (int k = 1; k < terms; ++k) {
    least = std::min(least, std::abs(values[k]));
    greatest = std::max(greatest, std::abs(values[k]));
  }
  // Pressure is as good where it is low as where it is high, unless it changes its sign.
  const double of_pressure = std::max(least, 1e-3 * greatest);
  double tail = 0;
  for (int c = 0; c < 2 + 2 * places; ++c) {
    const double* series = &piece.coefficients[c * terms];
    const double scale = c == 0               ? of_pressure
                         : c == slope_channel ? 1e3 * std::abs(series[0])
                         : c % 2 == 0         ? model_->ring().inner_radius
                                              : 10.0;
    tail = std::max(tail, (std::abs(series[terms - 1]) + std::abs(series[terms - 2])) / scale);
  }
  if (tail > model_->accuracy() && upper - lower > least_piece) return std::nullopt;
  return piece;
}

const WallCurve::Piece& WallCurve::build_at(double stretch) const {
  bool has_equilibrium = false;
  while (true) {
    const auto end = std::max(edges_.lower_bound(stretch), std::next(edges_.begin()),
                              [](const auto& a, const auto& b) { return *a < *b; });
    const double lower = *std::prev(end), upper = *end;
    try {
      if (auto piece = piece_between(lower, upper))
        return pieces_.emplace(upper, std::move(*piece)).first->second;
    } catch (const SolverFailure&) {
      // Somewhere in the piece, which says nothing about the stretch that is asked for.
      if (upper - lower < least_foothold) throw;
      if (!has_equilibrium) respond(stretch, {}, false);
      has_equilibrium = true;
    }
    edges_.insert(0.5 * (lower + upper));
  }
}

const WallCurve::Piece& WallCurve::piece_at(double stretch) const {
  if (last_ && last_->lower <= stretch && stretch <= last_->upper) return *last_;
  if (!(stretch >= least_stretch && stretch < greatest_stretch))
    throw SolverFailure(
        fmt::format("the lumen stretch {:.6g} left the range {} to {} that the wall is computed for", stretch,
                    least_stretch, greatest_stretch));
  const auto found = pieces_.lower_bound(stretch);
  const bool is_there = found != pieces_.end() && found->second.lower <= stretch;
  last_ = is_there ? &found->second : &build_at(stretch);
  return *last_;
}

double WallCurve::evaluate(LumenStretch stretch, int channel) const {
  const Piece& piece = piece_at(stretch.value());
  const int terms = basis_.terms();
  const double x = (2 * stretch.value() - piece.lower - piece.upper) / (piece.upper - piece.lower);
  const std::span series(&piece.coefficients[static_cast<std::size_t>(channel) * terms], terms);
  const double value = chebyshev_sum(series, x);
  return channel == slope_channel ? value : at_rest_[channel] + stretch.strain() * value;
}

double WallCurve::differentiate(LumenStretch stretch, int channel) const {
  const Piece& piece = piece_at(stretch.value());
  const int terms = basis_.terms();
  const double scale = 2 / (piece.upper - piece.lower);
  const double x = 0.5 * scale * (2 * stretch.value() - piece.lower - piece.upper);
  const double* series = &piece.coefficients[static_cast<std::size_t>(channel) * terms];
  // T_j' = j U_(j-1), and both are summed by Clenshaw's recurrence.
  double b1 = 0, b2 = 0, c1 = 0, c2 = 0;
  for (int j = terms - 1; j > 0; --j) {
    const double b = 2 * x * b1 - b2 + j * series[j];
    const double c = 2 * x * c1 - c2 + series[j];
    b2 = b1;
    b1 = b;
    c2 = c1;
    c1 = c;
  }
  return x * c1 - c2 + series[0] + stretch.strain() * b1 * scale;
}

void WallCurve::prepare(double from, double to) const {
  for (double stretch = from; stretch < to;) stretch = std::nextafter(piece_at(stretch).upper, 5.0);
}

double WallCurve::stretch_at(double target) const {
  const auto gap = [&](double stretch) { return pressure(stretch) - target; };
  // The nearest equilibrium to rest on the side that the pressure pushes to.
  constexpr double longest_step = 0.02, shortest_step = 1e-4;
  double step = target >= pressure(1.0) ? longest_step : -longest_step;
  double here = 1.0, highest = 1.0;
  while (true) {
    const double next = here + step;
    if (next < least_stretch || next >= greatest_stretch)
      throw SolverFailure(fmt::format(
          "the wall has no equilibrium at a pressure of {:.6g} dyn/cm2 between lumen stretches {} and {}: "
          "it carries at most {:.6g} dyn/cm2, at lumen stretch {:.4g}",
          target, least_stretch, greatest_stretch, pressure(highest), highest));
    try {
      if ((gap(next) > 0) != (gap(here) > 0) || gap(next) == 0)
        return find_root(gap, std::min(here, next), std::max(here, next), 1e-14);
    } catch (const SolverFailure& failure) {
      step *= 0.5;
      if (std::abs(step) > shortest_step) continue;
      throw SolverFailure(fmt::format(
          "equilibria of the wall are found up to {:.6g} dyn/cm2, at lumen stretch {:.4g}, and not "
          "at {:.6g} dyn/cm2: {}",
          pressure(here), here, target, failure.what()));
    }
    if (step * (pressure(next) - pressure(highest)) > 0) highest = next;
    here = next;
  }
}

}  // namespace tunica::radial
