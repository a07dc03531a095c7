// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/place_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/frame.hpp"
#include "core/radial/fronts.hpp"

namespace tunica::lumped {

using frame::Radial;
using radial::LumenStretch;

namespace {

/// As many as resolve the curve's own pieces to the same accuracy, and two more: stress is a steeper function
/// of the stretch than displacement.
int terms_for(double accuracy) {
  return accuracy < 1e-8 ? 14 : 8;
}

}  // namespace

PlaceTable::PlaceTable(const radial::WallCurve& curve)
    : curve_(curve), basis_(terms_for(curve.model().accuracy())) {
  const auto boundaries = radial::layer_boundaries(curve.model().ring());
  for (const double xi : curve.places()) layers_.push_back(radial::layer_at(boundaries, xi));
}

const wall::Law<double>& PlaceTable::law(int place) const {
  return curve_.model().ring().layers[layers_[place]].law;
}

Tensor<double> PlaceTable::gradient(LumenStretch stretch, int place) const {
  return Radial::gradient(curve_.displacement(stretch, place), curve_.radial_slope(stretch, place),
                          curve_.model().ring().radius(curve_.places()[place]));
}

double PlaceTable::computed_von_mises(LumenStretch stretch, int place) const {
  const auto deformed = gradient(stretch, place);
  return von_mises_stress(cauchy_stress(wall::piola(law(place), deformed, Radial::axes()), deformed));
}

std::optional<PlaceTable::Fiber> PlaceTable::computed_fiber(LumenStretch stretch, int place) const {
  const auto& families = wall::families(law(place));
  if (families.empty()) return {};
  const auto fiber = wall::fiber_state(families.front(), gradient(stretch, place), Radial::axes());
  return Fiber{fiber.angle, fiber.stretch, fiber.recruitment};
}

std::array<double, 3> PlaceTable::fiber_values(const wall::CollagenFamily<double>& family,
                                               LumenStretch stretch, int place) const {
  const auto deformed = gradient(stretch, place);
  const auto fiber = wall::fiber_state(family, deformed, Radial::axes());
  return {fiber.angle, fiber.stretch, family.excess(Kinematics<double>(deformed), Radial::axes())};
}

PlaceTable::Piece& PlaceTable::piece_at(LumenStretch stretch) const {
  const double value = stretch.value();
  if (last_ && last_->lower <= value && value <= last_->upper) return *last_;
  const auto range = curve_.smooth_around(stretch);
  const std::size_t places = layers_.size();
  Piece made{range.lower, range.upper, std::vector<std::optional<Series>>(places),
             std::vector<std::optional<Series>>(places)};
  return *(last_ = &pieces_.try_emplace(range.upper, std::move(made)).first->second);
}

template <class Values>
PlaceTable::Series PlaceTable::series_of(const Piece& piece, int kinds, const Values& values) const {
  const int terms = basis_.terms();
  std::vector<double> at_nodes(static_cast<std::size_t>(kinds) * terms);
  for (int k = 0; k < terms; ++k) {
    const double middle = 0.5 * (piece.lower + piece.upper), half = 0.5 * (piece.upper - piece.lower);
    const auto here = values(LumenStretch(middle + half * basis_.node(k)));
    for (int kind = 0; kind < kinds; ++kind) at_nodes[kind * terms + k] = here[kind];
  }
  Series series(at_nodes.size());
  for (int kind = 0; kind < kinds; ++kind) {
    const auto from = std::span<const double>(at_nodes).subspan(kind * terms, terms);
    const auto to = std::span(series).subspan(kind * terms, terms);
    basis_.fit(from, to);
    const auto [least, greatest] = std::minmax_element(from.begin(), from.end());
    // What is left out is less than the last coefficients by as much again as they are than those before.
    const double tail = std::abs(to[terms - 1]) + std::abs(to[terms - 2]);
    constexpr double round_off = 1e-13;
    if (tail > curve_.model().accuracy() * (*greatest - *least) + round_off * std::abs(*greatest)) return {};
  }
  return series;
}

double PlaceTable::at(const Piece& piece, const Series& series, int kind, LumenStretch stretch) const {
  const int terms = basis_.terms();
  const double x = (2 * stretch.value() - piece.lower - piece.upper) / (piece.upper - piece.lower);
  return chebyshev_sum(std::span(series).subspan(static_cast<std::size_t>(kind) * terms, terms), x);
}

double PlaceTable::von_mises(LumenStretch stretch, int place) const {
  Piece& piece = piece_at(stretch);
  auto& series = piece.von_mises[place];
  if (!series)
    series = series_of(piece, 1, [&](LumenStretch s) { return std::array{computed_von_mises(s, place)}; });
  return series->empty() ? computed_von_mises(stretch, place) : at(piece, *series, 0, stretch);
}

std::optional<PlaceTable::Fiber> PlaceTable::fiber(LumenStretch stretch, int place) const {
  const auto& families = wall::families(law(place));
  if (families.empty()) return {};
  const auto& family = families.front();
  Piece& piece = piece_at(stretch);
  auto& series = piece.fibers[place];
  if (!series) series = series_of(piece, 3, [&](LumenStretch s) { return fiber_values(family, s, place); });
  if (series->empty()) return computed_fiber(stretch, place);
  return Fiber{at(piece, *series, 0, stretch), at(piece, *series, 1, stretch),
               family.recruitment.share(at(piece, *series, 2, stretch))};
}

}  // namespace tunica::lumped
