// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stability/base_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/frame.hpp"
#include "core/physics/tether.hpp"
#include "core/physics/wall_momentum.hpp"
#include "core/radial/wall_curve.hpp"
#include "core/root.hpp"

namespace tunica::stability {

using frame::Radial;
using radial::Interval;
using radial::Ring;
using radial::WallState;

namespace {

/// Displacement and slope between places where they are known: cubic in each interval, so that a kink of the
/// slope's derivative costs nothing once its place is among them.
class Interpolant {
 public:
  Interpolant(std::vector<double> places, std::vector<WallState<double>> states, double thickness)
      : places_(std::move(places)), states_(std::move(states)), thickness_(thickness) {}

  std::pair<double, double> operator()(double xi) const {
    const auto above = std::upper_bound(places_.begin() + 1, places_.end() - 1, xi);
    const std::size_t k = above - places_.begin() - 1;
    const double width = places_[k + 1] - places_[k], t = (xi - places_[k]) / width;
    const auto &a = states_[k], &b = states_[k + 1];
    const double rise = b.displacement - a.displacement;
    // Hermite: a straight line and a cubic that has the rest of the end slopes.
    const double length = width * thickness_;
    const double start = a.radial_slope * length - rise, end = b.radial_slope * length - rise;
    return {a.displacement + rise * t + t * (1 - t) * (start * (1 - t) - end * t),
            (rise + (1 - t) * (1 - 3 * t) * start + t * (3 * t - 2) * end) / length};
  }

 private:
  std::vector<double> places_;
  std::vector<WallState<double>> states_;
  double thickness_;
};

/// The recruitment fronts of the ring at a lumen stretch.
std::vector<radial::Front> fronts_at(const radial::RingModel& model, double lumen_stretch,
                                     const std::vector<double>& boundaries) {
  const Ring<double>& ring = model.ring();
  const bool has_fibers = std::any_of(ring.layers.begin(), ring.layers.end(),
                                      [](const auto& layer) { return !families(layer.law).empty(); });
  if (!has_fibers) return {};
  std::vector<double> places;
  for (std::size_t layer = 0; layer + 1 < boundaries.size(); ++layer) {
    constexpr int samples = 16;
    // A boundary's own place belongs to the layer inside of it.
    const double lower = boundaries[layer] + 1e-13, width = boundaries[layer + 1] - lower;
    for (int k = 0; k <= samples; ++k) places.push_back(lower + width * k / samples);
  }
  std::vector<radial::Front> fronts;
  // Each round adds the fronts that it finds to the places, which brings their error down to its square.
  constexpr int most_rounds = 8;
  for (int round = 0; round < most_rounds; ++round) {
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    const Interpolant field(places, model.respond(lumen_stretch, places, false).states, ring.thickness);
    const auto found = find_fronts(ring, boundaries, field);
    const bool settled = std::equal(found.begin(), found.end(), fronts.begin(), fronts.end(),
                                    [](const auto& a, const auto& b) {
                                      const double change = a.xi - b.xi;
                                      return change * change <= a.tolerance;
                                    });
    fronts = found;
    if (settled) break;
    for (const auto& front : fronts) places.push_back(front.xi);
  }
  return fronts;
}

/// Cells of the radial mesh, cut where they have to narrow towards the surfaces.
std::vector<Interval> graded(const std::vector<Interval>& mesh, double shortest_wave) {
  std::vector<double> cuts;
  double distance = 0.5;
  cuts.push_back(distance);
  while (distance > shortest_wave) {
    distance *= 0.5;
    cuts.push_back(distance);
    cuts.push_back(1 - distance);
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<Interval> cells;
  for (const Interval& cell : mesh) {
    double lower = cell.lower;
    for (const double cut : cuts) {
      // A sliver beside a front or a boundary resolves nothing.
      const double margin = 0.1 * std::min(cut, 1 - cut);
      if (cut < lower + margin || cut > cell.upper - margin) continue;
      cells.push_back({lower, cut, cell.layer});
      lower = cut;
    }
    cells.push_back({lower, cell.upper, cell.layer});
  }
  return cells;
}

/// Tangents of the tissue of a ring at its states.
class Tissue {
 public:
  explicit Tissue(const Ring<double>& ring) : ring_(ring) {}

  Tangent tangent(std::size_t layer, double radius, const WallState<double>& state) const {
    const wall::Law<double>& law = ring_.layers[layer].law;
    const auto gradient = Radial::gradient(state.displacement, state.radial_slope, radius);
    if (!ring_.incompressible) return wall::stress_and_tangent(law, gradient, Radial::axes()).tangent;
    // The pressure of incompressible tissue is what its radial stress lacks.
    const double isochoric = isochoric_kirchhoff(law, gradient, Radial::axes())(0, 0);
    const double pressure = isochoric - state.radial_stress;
    using Strain = Dual<double, 9>;
    Tensor<Strain> seeded;
    for (int k = 0; k < 9; ++k) seeded.entries[k] = Strain::variable(gradient.entries[k], k);
    const auto stress = wall::piola_with(law, seeded, Radial::axes(), Strain(-pressure));
    Tangent tangent;
    for (int k = 0; k < 9; ++k) tangent[k] = stress.entries[k].derivative;
    return tangent;
  }

  /// Adds the stiffness against changes of volume, dJ = cof F : dH.
  void stiffen(Tangent& tangent, double bulk_stiffness, double radius, const WallState<double>& state) const {
    const Kinematics<double> k(Radial::gradient(state.displacement, state.radial_slope, radius));
    const auto& change = k.deformation_cofactor.entries;
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j < 9; ++j) tangent[i][j] += bulk_stiffness * change[i] * change[j];
  }

 private:
  const Ring<double>& ring_;
};

/// Linearises a load t(d, H) on a surface whose outward normal is along the radius.
template <class Load>
SurfaceState linearised(const Load& load, double radius, double normal, const WallState<double>& state) {
  using Strain = Dual<double, 12>;
  const auto gradient = Radial::gradient(state.displacement, state.radial_slope, radius);
  Vector<Strain> displacement{Strain(state.displacement), Strain(0.0), Strain(0.0)};
  for (int i = 0; i < 3; ++i) displacement[i].derivative[i] = 1;
  Tensor<Strain> seeded;
  for (int k = 0; k < 9; ++k) seeded.entries[k] = Strain::variable(gradient.entries[k], 3 + k);
  const Vector<Strain> t = load(displacement, seeded, Vector<double>{normal, 0, 0});
  SurfaceState surface{radius, normal, {}, {}, {}};
  for (int i = 0; i < 3; ++i) {
    std::copy_n(t[i].derivative.begin(), 3, surface.by_displacement[i].begin());
    std::copy_n(t[i].derivative.begin() + 3, 9, surface.by_gradient[i].begin());
  }
  return surface;
}

}  // namespace

BaseState base_state(const radial::RingModel& model, double lumen_stretch, const Resolution& resolution) {
  const Ring<double>& ring = model.ring();
  const std::vector<double> boundaries = layer_boundaries(ring);
  const element::Line line(resolution.degree, resolution.degree + 2);
  BaseState base{lumen_stretch, 0, ring.thickness, line, {}, {}, {}, {}, {}};
  base.cells =
      graded(radial_mesh(boundaries, fronts_at(model, lumen_stretch, boundaries)), resolution.shortest_wave);

  std::vector<double> places;
  std::vector<std::size_t> layers;
  for (const Interval& cell : base.cells) {
    const double half = 0.5 * (cell.upper - cell.lower);
    base.half_widths.push_back(half * ring.thickness);
    for (const auto& point : line.rule()) {
      places.push_back(cell.lower + half * (1 + point.position));
      layers.push_back(cell.layer);
      const double radius = ring.radius(places.back());
      base.points.push_back({radius, point.weight * base.half_widths.back() * Radial::measure(radius), {}});
    }
  }
  places.insert(places.end(), {0.0, 1.0});
  const auto response = model.respond(lumen_stretch, places, false);
  base.pressure = response.pressure;
  const auto &inner = response.states[places.size() - 2], &outer = response.states.back();

  const physics::Tether tether{ring.tether_stiffness, ring.traction};
  base.inner = linearised(
      [&](const auto&, const auto& gradient, const Vector<double>& normal) {
        using S = std::decay_t<decltype(gradient(0, 0))>;
        return physics::pressure_load(S(response.pressure), physics::oriented_area(gradient, normal));
      },
      ring.radius(0.0), -1, inner);
  base.outer = linearised(
      [&](const auto& displacement, const auto& gradient, const Vector<double>& normal) {
        return physics::tether_load(tether, displacement, gradient, normal);
      },
      ring.radius(1.0), 1, outer);

  const Tissue tissue(ring);
  for (std::size_t q = 0; q < base.points.size(); ++q)
    base.points[q].tangent = tissue.tangent(layers[q], base.points[q].radius, response.states[q]);
  base.inner.tangent = tissue.tangent(0, base.inner.radius, inner);
  base.outer.tangent = tissue.tangent(ring.layers.size() - 1, base.outer.radius, outer);
  if (ring.incompressible) {
    double stiffest = 0;
    for (const MaterialPoint& point : base.points)
      for (int k = 0; k < 9; ++k) stiffest = std::max(stiffest, std::abs(point.tangent[k][k]));
    const double bulk_stiffness = 1e5 * stiffest;
    for (std::size_t q = 0; q < base.points.size(); ++q)
      tissue.stiffen(base.points[q].tangent, bulk_stiffness, base.points[q].radius, response.states[q]);
    tissue.stiffen(base.inner.tangent, bulk_stiffness, base.inner.radius, inner);
    tissue.stiffen(base.outer.tangent, bulk_stiffness, base.outer.radius, outer);
  }
  return base;
}

double lumen_stretch_at(const radial::RingModel& model, double pressure) {
  const auto gap = [&](double stretch) { return model.respond(stretch, {}, false).pressure - pressure; };
  const double at_rest = gap(1.0);
  if (at_rest == 0) return 1.0;
  const double step = at_rest < 0 ? 0.05 : -0.05;
  double here = 1.0;
  while (true) {
    const double next = here + step;
    if (next < radial::WallCurve::least_stretch || next > radial::WallCurve::greatest_stretch)
      throw SolverFailure(fmt::format(
          "the wall has no equilibrium at a pressure of {:.6g} dyn/cm2 between lumen stretches {} "
          "and {}",
          pressure, radial::WallCurve::least_stretch, radial::WallCurve::greatest_stretch));
    if ((gap(next) > 0) != (at_rest > 0))
      return find_root(gap, std::min(here, next), std::max(here, next), 1e-12);
    here = next;
  }
}

}  // namespace tunica::stability
