// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coupled/tube_state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/radial/wall_curve.hpp"

namespace tunica::coupled {

RingMeasure::RingMeasure(const Loading& loading, double pressure) : loading_(loading), pressure_(pressure) {
  if (!loading.ring || pressure == 0) return;
  try {
    double stretch = pressure > 0 ? 1.05 : 0.95;
    while (!exceeds(stretch, pressure)) {
      stretch = 1 + (stretch - 1) * 1.6;
      if (stretch > radial::WallCurve::greatest_stretch || stretch < radial::WallCurve::least_stretch) return;
    }
    most_ = stretch - 1;
  } catch (const SolverFailure&) {
    // Loads are the measure.
  }
}

double RingMeasure::at(double load) const {
  if (most_ == 0) return load;
  constexpr double precision = 1e-5;  // a load's least step changes it by more
  double low = 0, high = most_;
  try {
    while (std::abs(high - low) > precision * std::abs(high)) {
      const double middle = 0.5 * (low + high);
      (exceeds(1 + middle, load * pressure_) ? high : low) = middle;
    }
  } catch (const SolverFailure&) {
    return load * most_;
  }
  return 0.5 * (low + high);
}

bool RingMeasure::exceeds(double stretch, double pressure) const {
  const double p = loading_.ring->respond(stretch, {}, false).pressure;
  return pressure_ > 0 ? p > pressure : p < pressure;
}

namespace {

/// Share of a long tube's displacement at a distance from an end that is held.
double share_at(double distance, double decay) {
  const double s = decay * std::max(distance, 0.0);
  return 1 - std::exp(-s) * (std::cos(s) + std::sin(s));
}

}  // namespace

std::vector<double> tube_state(const Loading& loading, const Equations& equations, double time) {
  if (!loading.tube) return {};
  const double pressure = loading.steady_pressure(time);
  double opening = 0;
  if (equations.has_wall() && pressure != 0) {
    const RingMeasure measure(loading, pressure);
    if (!measure.is_displacement()) return {};
    opening = measure.at(1);
  }
  const Tube& tube = *loading.tube;
  const Layout& layout = equations.layout();
  const double flow = equations.has_blood() ? loading.steady_flow(time) : 0;
  const double lumen = tube.radius, mean = tube.radius + 0.5 * tube.thickness;
  const double decay = tube.thickness > 0 ? std::sqrt(1.5 / (mean * tube.thickness)) : 0;
  const bool held = tube.ends_are_held && decay > 0;

  std::vector<double> state(layout.size(), 0.0);
  for (int node = 0; node < layout.nodes(); ++node) {
    const Tube::Place at = tube.place(node);
    const double e =
        held ? opening * share_at(at.along, decay) * share_at(tube.length - at.along, decay) : opening;
    const double share = std::min(at.radius / lumen, 1.0);
    const double outward = at.radius <= lumen
                               ? share * e * lumen
                               : std::sqrt(at.radius * at.radius + (2 + e) * e * lumen * lumen) - at.radius;
    if (layout.has_displacement(node))
      for (int c = 0; c < layout.components(); ++c)
        state[layout.displacement(node, c)] = outward * at.outward[c];
    const double open = lumen * (1 + e), area = std::numbers::pi * open * open;
    if (layout.has_velocity(node) && !layout.on_wall(node))
      for (int c = 0; c < layout.components(); ++c)
        state[layout.velocity(node, c)] = 2 * flow / area * (1 - share * share) * at.onward[c];
    if (layout.has_pressure(node)) state[layout.pressure(node)] = pressure;
  }
  for (const auto& scalar : {layout.inlet_pressure, layout.outlet_pressure})
    if (scalar) state[*scalar] = pressure;
  if (layout.windkessel_pressure) state[*layout.windkessel_pressure] = pressure;
  return state;
}

}  // namespace tunica::coupled
