// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/radial/incompressible_ring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/frame.hpp"

namespace tunica::radial {

using frame::Radial;

namespace {

/// Displacement and its slope at xi.
template <class P, class S, class X>
WallState<S> motion(const Ring<P>& ring, const S& lumen_strain, const X& xi) {
  using std::sqrt;
  const S radius(ring.radius(xi));
  const S shift = lumen_strain * (2.0 + lumen_strain) * (ring.inner_radius * ring.inner_radius);
  const S current = sqrt(radius * radius + shift);
  return {S(shift / (current + radius)), S(-shift / (current * (current + radius))), S(0.0)};
}

}  // namespace

IncompressibleRing::IncompressibleRing(Ring<double> ring, std::vector<Seeded> seeded, int points)
    : ring_(std::move(ring)),
      seeded_(std::move(seeded)),
      rule_(gauss_legendre(points)),
      boundaries_(layer_boundaries(ring_)) {}

template <class P, class S>
MovingInterval<S> IncompressibleRing::moved(const Ring<P>& ring, const S& lumen_strain,
                                            const Interval& cell) const {
  if constexpr (std::same_as<S, double>) {
    return {cell.lower, cell.upper};
  } else {
    MovingInterval<S> result{S(cell.lower), S(cell.upper)};
    if constexpr (std::same_as<P, S>) result = moved_with_layers(ring, boundaries_, cell);
    const auto& families = wall::families(ring.layers[cell.layer].law);
    const auto follow_front = [&](S& end) {
      const double xi = end.value;
      if (xi == boundaries_[cell.layer] || xi == boundaries_[cell.layer + 1]) return;
      for (const auto& family : families) {
        if (!(family.exponent == 1 && family.recruitment.sharp)) continue;
        const auto excess = [&](const S& strain, const auto& place) {
          const WallState<S> m = motion(ring, strain, place);
          return family.excess(Radial::kinematics(m.displacement, m.radial_slope, S(ring.radius(place))),
                               Radial::axes());
        };
        const S here = excess(lumen_strain, xi);
        // find_fronts knows its fronts to 1e-13 of xi.
        if (std::abs(here.value) > 1e-10) continue;
        // d(excess)/d(xi) at fixed stretch and parameters, by a difference of values: the excess is smooth.
        const double step = 1e-5;
        const double slope =
            (excess(lumen_strain, xi + step).value - excess(lumen_strain, xi - step).value) / (2 * step);
        end.derivative[0] = -here.derivative[0] / slope;
        return;
      }
    };
    follow_front(result.lower);
    follow_front(result.upper);
    return result;
  }
}

template <class P, class S>
S IncompressibleRing::integral(const Ring<P>& ring, const S& lumen_strain, const std::vector<Interval>& mesh,
                               double end) const {
  S sum(0.0);
  for (const Interval& cell : mesh) {
    if (cell.lower >= end) break;
    const MovingInterval<S> ends = moved(ring, lumen_strain, cell);
    const S half = 0.5 * ((cell.upper <= end ? ends.upper : S(end)) - ends.lower);
    for (const QuadraturePoint& point : rule_) {
      const S xi = ends.lower + half * (1 + point.position);
      const S radius(ring.radius(xi));
      const WallState<S> m = motion(ring, lumen_strain, xi);
      const Tensor<S> kirchhoff =
          wall::isochoric_kirchhoff(ring.layers[cell.layer].law,
                                    Radial::gradient(m.displacement, m.radial_slope, radius), Radial::axes());
      const S current = radius + m.displacement;
      sum += point.weight * half * ring.thickness * Radial::measure(radius) *
             (kirchhoff(1, 1) - kirchhoff(0, 0)) / (current * current);
    }
  }
  return sum;
}

RingResponse IncompressibleRing::respond(LumenStretch lumen_stretch, std::span<const double> places,
                                         bool derivatives) const {
  if (!(lumen_stretch.value() > 0))
    throw SolverFailure(fmt::format("the lumen has closed (stretch {:.6g})", lumen_stretch.value()));
  const double strain = lumen_stretch.strain();
  const auto fronts = find_fronts(ring_, boundaries_, [&](double xi) {
    const auto m = motion(ring_, strain, xi);
    return std::pair{m.displacement, m.radial_slope};
  });
  const auto mesh = radial_mesh(boundaries_, fronts);

  const auto pressure = [&]<class P, class S>(const Ring<P>& ring, const S& lumen_strain) {
    return ring.external_pressure(motion(ring, lumen_strain, 1.0).displacement) +
           integral(ring, lumen_strain, mesh, 1.0);
  };
  const auto state = [&]<class P>(const Ring<P>& ring, const P& lumen_strain, const P& lumen_pressure,
                                  double xi) {
    WallState<P> s = motion(ring, lumen_strain, xi);
    s.radial_stress = integral(ring, lumen_strain, mesh, xi) - lumen_pressure;
    return s;
  };

  RingResponse response;
  const auto by_stretch = pressure(ring_, seed(strain));
  response.pressure = by_stretch.value;
  response.pressure_slope = by_stretch.derivative[0];
  if (!std::isfinite(response.pressure) || !std::isfinite(response.pressure_slope))
    throw SolverFailure(
        fmt::format("the stress of the wall overflows at lumen stretch {:.6g}", lumen_stretch.value()));
  for (const double xi : places) response.states.push_back(state(ring_, strain, response.pressure, xi));
  for (const double xi : places) {
    const auto m = motion(ring_, seed(strain), xi);
    response.state_rates.push_back({m.displacement.derivative[0], m.radial_slope.derivative[0], 0.0});
  }
  if (!derivatives) return response;

  using D = Dual<double, 1>;
  for (const Seeded& ring : seeded_) {
    const D p = pressure(ring, D(strain));
    response.pressure_derivatives.push_back(p.derivative[0]);
    auto& states = response.state_derivatives.emplace_back();
    for (const double xi : places) {
      const WallState<D> s = state(ring, D(strain), p, xi);
      states.push_back(
          {s.displacement.derivative[0], s.radial_slope.derivative[0], s.radial_stress.derivative[0]});
    }
  }
  return response;
}

}  // namespace tunica::radial
