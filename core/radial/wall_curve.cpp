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

constexpr int terms = 12;
constexpr double cell_width = 0.1;
/// Pieces are not split below this: a kink that the thresholds do not know (exponent 1 lingers at its
/// threshold) is then met to within the square of it.
constexpr double least_piece = 1e-3;

/// Chebyshev nodes of the first kind on [-1, 1]; no piece is evaluated at its very ends.
double node(int k) {
  return std::cos(std::numbers::pi * (k + 0.5) / terms);
}

/// cos(pi j (k+1/2) / terms), the matrix of the discrete cosine transform.
const std::array<std::array<double, terms>, terms>& cosines() {
  static const auto table = [] {
    std::array<std::array<double, terms>, terms> t{};
    for (int j = 0; j < terms; ++j)
      for (int k = 0; k < terms; ++k) t[j][k] = std::cos(std::numbers::pi * j * (k + 0.5) / terms);
    return t;
  }();
  return table;
}

}  // namespace

WallCurve::WallCurve(std::unique_ptr<const RingModel> model, std::vector<double> places, double tolerance)
    : model_(std::move(model)), places_(std::move(places)), tolerance_(tolerance) {
  cells_.resize(static_cast<std::size_t>(std::ceil((greatest_stretch - least_stretch) / cell_width)));
  find_thresholds();
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

void WallCurve::find_thresholds() {
  const Ring<double>& ring = model_->ring();
  const auto boundaries = layer_boundaries(ring);
  // Layer boundaries break the curve too, seen from either side.
  struct Candidate {
    double xi;
    std::size_t layer;
    int place;
  };
  std::vector<Candidate> candidates;
  for (std::size_t k = 0; k < places_.size(); ++k)
    candidates.push_back({places_[k], layer_at(boundaries, places_[k]), static_cast<int>(k)});
  for (std::size_t layer = 0; layer + 1 < boundaries.size(); ++layer) {
    for (const double xi : {boundaries[layer], boundaries[layer + 1]}) {
      const bool is_place = std::any_of(
          candidates.begin(), candidates.end(),
          [&](const Candidate& candidate) { return candidate.layer == layer && candidate.xi == xi; });
      if (!is_place) candidates.push_back({xi, layer, -1});
    }
  }

  for (const Candidate& candidate : candidates) {
    const auto& families = wall::families(ring.layers[candidate.layer].law);
    for (std::size_t f = 0; f < families.size(); ++f) {
      const auto& family = families[f];
      const bool mirrored = std::any_of(families.begin(), families.begin() + f, [&](const auto& earlier) {
        return std::abs(earlier.angle) == std::abs(family.angle) &&
               earlier.activation_squared == family.activation_squared;
      });
      if (mirrored) continue;
      const double cosine = std::cos(family.angle), sine = std::sin(family.angle);
      // Where incompressible tissue would be recruited: hoop stretch^2 cos^2 + sin^2 = a^2.
      const double hoop_squared = (family.activation_squared - sine * sine) / (cosine * cosine);
      const double radius = ring.radius(candidate.xi);
      const double squared =
          1 + (hoop_squared - 1) * radius * radius / (ring.inner_radius * ring.inner_radius);
      if (!(cosine > 1e-6) || !(squared > least_stretch * least_stretch)) continue;
      const double guess = std::sqrt(squared);
      // A place just inside the layer reads the slope of the layer that is meant.
      const double inside =
          std::clamp(candidate.xi, boundaries[candidate.layer] + 1e-12, boundaries[candidate.layer + 1]);
      const std::array place{inside};
      const auto excess = [&](double stretch) {
        const auto response = respond(stretch, place, false);
        return fiber_excess(family, ring, inside, response.states[0].displacement,
                            response.states[0].radial_slope);
      };
      double threshold;
      if (family.activation_squared == 1.0) {
        threshold = 1.0;  // the unloaded state
      } else {
        const double margin = 0.03 * guess;
        const double lower = std::max(least_stretch, guess - margin),
                     upper = std::min(greatest_stretch, guess + margin);
        if (lower >= upper) continue;
        try {
          threshold = find_root(excess, lower, upper, 1e-13);
        } catch (const std::exception&) {
          // No equilibrium there, or tissue too compressible for the estimate: the curve is then
          // split where its coefficients ask for it.
          continue;
        }
      }
      breaks_.push_back(threshold);
      if (candidate.place < 0) continue;

      Threshold found{candidate.place, candidate.layer, f, threshold, {}};
      if (!model_->seeded().empty()) {
        const auto response = respond(threshold, place, true);
        constexpr double step = 1e-6;
        const double slope = (excess(threshold + step) - excess(threshold - step)) / (2 * step);
        for (std::size_t p = 0; p < model_->seeded().size(); ++p) {
          using D = Dual<double, 1>;
          const auto& seeded = model_->seeded()[p];
          const auto& state = response.states[0];
          const auto& change = response.state_derivatives[p][0];
          const Kinematics<D> k(frame::Radial::gradient(D(state.displacement, {change.displacement}),
                                                        D(state.radial_slope, {change.radial_slope}),
                                                        seeded.radius(inside)));
          const D x = wall::families(seeded.layers[candidate.layer].law)[f].excess(k, frame::Radial::axes());
          found.derivatives.push_back(-x.derivative[0] / slope);
        }
      }
      thresholds_.push_back(std::move(found));
    }
  }
  std::sort(breaks_.begin(), breaks_.end());
}

void WallCurve::build(double lower, double upper, Cell& cell) const {
  const int count = channels();
  const int places = static_cast<int>(places_.size());
  const bool derivatives = !model_->seeded().empty();
  std::vector<double> values(static_cast<std::size_t>(count) * terms);
  for (int k = 0; k < terms; ++k) {
    const double stretch = 0.5 * (lower + upper) + 0.5 * (upper - lower) * node(k);
    const RingResponse response = respond(stretch, places_, derivatives);
    const auto set = [&](int channel, double value) { values[channel * terms + k] = value; };
    set(0, response.pressure);
    set(1, response.pressure_slope);
    for (int p = 0; p < places; ++p) {
      set(2 + 2 * p, response.states[p].displacement);
      set(3 + 2 * p, response.states[p].radial_slope);
    }
    for (std::size_t q = 0; q < response.pressure_derivatives.size(); ++q) {
      const int first = parameter_channel(static_cast<int>(q));
      set(first, response.pressure_derivatives[q]);
      for (int p = 0; p < places; ++p) {
        set(first + 1 + 2 * p, response.state_derivatives[q][p].displacement);
        set(first + 2 + 2 * p, response.state_derivatives[q][p].radial_slope);
      }
    }
  }
  Piece piece{lower, upper, std::vector<double>(values.size())};
  for (int c = 0; c < count; ++c) {
    for (int j = 0; j < terms; ++j) {
      double sum = 0;
      for (int k = 0; k < terms; ++k) sum += cosines()[j][k] * values[c * terms + k];
      piece.coefficients[c * terms + j] = sum * (j == 0 ? 1.0 : 2.0) / terms;
    }
  }

  // Pressure, displacements and slopes decide; derivatives with respect to parameters are as smooth.
  const double width = upper - lower;
  double tail = 0;
  for (int c = 0; c < 2 + 2 * places; ++c) {
    double scale = c == 0       ? 0.0
                   : c == 1     ? 1e3 * std::abs(piece.coefficients[terms])
                   : c % 2 == 0 ? model_->ring().inner_radius
                                : 10.0;
    if (c == 0) scale = std::abs(piece.coefficients[0]) + width * std::abs(piece.coefficients[terms]);
    const double* series = &piece.coefficients[c * terms];
    tail = std::max(tail, (std::abs(series[terms - 1]) + std::abs(series[terms - 2])) / scale);
  }
  if (tail > tolerance_ && width > least_piece) {
    const double middle = 0.5 * (lower + upper);
    build(lower, middle, cell);
    build(middle, upper, cell);
  } else {
    cell.push_back(std::move(piece));
  }
}

const WallCurve::Piece& WallCurve::piece_at(double stretch) const {
  if (last_ && last_->lower <= stretch && stretch <= last_->upper) return *last_;
  if (!(stretch >= least_stretch && stretch < greatest_stretch))
    throw SolverFailure(
        fmt::format("the lumen stretch {:.6g} left the range {} to {} that the wall is computed for", stretch,
                    least_stretch, greatest_stretch));
  const auto index =
      std::min(cells_.size() - 1, static_cast<std::size_t>((stretch - least_stretch) / cell_width));
  Cell& cell = cells_[index];
  if (cell.empty()) {
    const double lower = least_stretch + static_cast<double>(index) * cell_width;
    std::vector<double> ends{lower};
    for (const double b : breaks_)
      if (b > ends.back() + 1e-12 && b < lower + cell_width - 1e-12) ends.push_back(b);
    ends.push_back(lower + cell_width);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) build(ends[k], ends[k + 1], cell);
  }
  const auto it = std::lower_bound(cell.begin(), cell.end(), stretch,
                                   [](const Piece& piece, double s) { return piece.upper < s; });
  last_ = it == cell.end() ? &cell.back() : &*it;
  return *last_;
}

double WallCurve::evaluate(double stretch, int channel) const {
  const Piece& piece = piece_at(stretch);
  const double x = (2 * stretch - piece.lower - piece.upper) / (piece.upper - piece.lower);
  const double* series = &piece.coefficients[static_cast<std::size_t>(channel) * terms];
  double b1 = 0, b2 = 0;
  for (int j = terms - 1; j > 0; --j) {
    const double b = 2 * x * b1 - b2 + series[j];
    b2 = b1;
    b1 = b;
  }
  return x * b1 - b2 + series[0];
}

double WallCurve::differentiate(double stretch, int channel) const {
  const Piece& piece = piece_at(stretch);
  const double scale = 2 / (piece.upper - piece.lower);
  const double x = 0.5 * scale * (2 * stretch - piece.lower - piece.upper);
  const double* series = &piece.coefficients[static_cast<std::size_t>(channel) * terms];
  // T_j' = j U_(j-1), summed by Clenshaw's recurrence of the second kind.
  double b1 = 0, b2 = 0;
  for (int j = terms - 1; j > 0; --j) {
    const double b = 2 * x * b1 - b2 + j * series[j];
    b2 = b1;
    b1 = b;
  }
  return b1 * scale;
}

void WallCurve::prepare(double from, double to) const {
  const double end = std::min(to, greatest_stretch - 1e-9);
  for (double stretch = std::max(from, least_stretch); stretch < end; stretch += cell_width)
    piece_at(stretch);
  piece_at(end);
}

double WallCurve::stretch_at(double target) const {
  const auto gap = [&](double stretch) { return pressure(stretch) - target; };
  // The nearest equilibrium to rest on the side that the pressure pushes to.
  const double step = target >= pressure(1.0) ? 0.02 : -0.02;
  double here = 1.0, highest = 1.0;
  while (true) {
    const double next = here + step;
    if (next < least_stretch || next >= greatest_stretch)
      throw SolverFailure(
          fmt::format("the wall has no equilibrium at a pressure of {:.6g} dyn/cm2: it carries at most "
                      "{:.6g} dyn/cm2, at lumen stretch {:.4g}",
                      target, pressure(highest), highest));
    if ((gap(next) > 0) != (gap(here) > 0) || gap(next) == 0)
      return find_root(gap, std::min(here, next), std::max(here, next), 1e-14);
    if (step * (pressure(next) - pressure(highest)) > 0) highest = next;
    here = next;
  }
}

}  // namespace tunica::radial
