// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/observer.hpp"

#include <fmt/format.h>

#include <numbers>

#include "core/frame.hpp"
#include "core/radial/fronts.hpp"
#include "lumped/wall_profile.hpp"

namespace tunica::lumped {

using D = Dual<double, 1>;
using frame::Radial;

namespace {

constexpr double degrees = 180 / std::numbers::pi;
/// Points of a profile through the wall, both surfaces included.
constexpr int profile_points = 61;

}  // namespace

Observer::Observer(const Network& network) : network_(network) {
  const auto boundaries = radial::layer_boundaries(network.curve().model().ring());
  for (const double xi : network.curve().places()) place_layers_.push_back(radial::layer_at(boundaries, xi));
}

observables::Sample Observer::sample(double time, const double* y, const Looked& looked) const {
  const auto& curve = network_.curve();
  const auto& ring = curve.model().ring();
  const PlaceTable& places = network_.places();
  const Outside<double> outside = network_.outside(time, y);
  observables::Sample sample;
  sample.time = time;
  sample.inflow = outside.inflow;
  sample.outflow = outside.outflow;
  sample.pressure = outside.pressure;
  sample.outlet_pressure = outside.outlet_pressure;
  const auto s = radial::LumenStretch::of_strain(outside.lumen_strain);
  sample.transmural_pressure =
      outside.pressure - ring.external_pressure(curve.displacement(s, observables::wall_points - 1));
  for (int p = 0; p < observables::wall_points; ++p) {
    observables::WallPoint& point = sample.wall[p];
    point.radial_displacement = curve.displacement(s, p);
    if (looked.von_mises[p])
      point.von_mises = looked.in_tables ? places.von_mises(s, p) : places.computed_von_mises(s, p);
    if (!looked.fibers[p]) continue;
    const auto fiber = looked.in_tables ? places.fiber(s, p) : places.computed_fiber(s, p);
    if (!fiber) continue;
    point.fiber_angle = fiber->angle * degrees;
    point.fiber_stretch = fiber->stretch;
    point.recruitment = fiber->recruitment;
  }
  return sample;
}

void Observer::append_sensitivities(double time, const double* y,
                                    const std::vector<const double*>& sensitivities,
                                    observables::Table& table) const {
  const auto& curve = network_.curve();
  std::vector<observables::Sample> derivatives;
  for (std::size_t k = 0; k < sensitivities.size(); ++k) {
    const int parameter = static_cast<int>(k);
    const Outside<D> outside = network_.outside_derivative(time, y, sensitivities[k], parameter);
    const auto& ring = network_.seeded_ring(parameter);
    const auto s = radial::LumenStretch::of_strain(outside.lumen_strain.value);
    const double ds = outside.lumen_strain.derivative[0];
    const auto displacement = [&](int p) {
      return D(curve.displacement(s, p),
               {curve.displacement_rate(s, p) * ds + curve.displacement_derivative(s, parameter, p)});
    };
    const auto slope = [&](int p) {
      return D(curve.radial_slope(s, p),
               {curve.radial_slope_rate(s, p) * ds + curve.radial_slope_derivative(s, parameter, p)});
    };
    observables::Sample& derivative = derivatives.emplace_back();
    derivative.pressure = outside.pressure.derivative[0];
    derivative.outlet_pressure = outside.outlet_pressure.derivative[0];
    derivative.transmural_pressure =
        (outside.pressure - ring.external_pressure(displacement(observables::wall_points - 1))).derivative[0];
    derivative.inflow = outside.inflow.derivative[0];
    derivative.outflow = outside.outflow.derivative[0];
    for (int p = 0; p < observables::wall_points; ++p) {
      observables::WallPoint& point = derivative.wall[p];
      point.radial_displacement = displacement(p).derivative[0];
      const auto& law = ring.layers[place_layers_[p]].law;
      const auto gradient = Radial::gradient(displacement(p), slope(p), ring.radius(curve.places()[p]));
      point.von_mises =
          von_mises_stress(cauchy_stress(wall::piola(law, gradient, Radial::axes()), gradient)).derivative[0];
      const auto& families = wall::families(law);
      if (families.empty()) continue;
      const auto fiber = wall::fiber_state(families.front(), gradient, Radial::axes());
      point.fiber_angle = fiber.angle.derivative[0] * degrees;
      point.fiber_stretch = fiber.stretch.derivative[0];
      point.recruitment = fiber.recruitment.derivative[0];
    }
  }
  observables::append_sensitivities(table, time, derivatives);
}

void Observer::append_profile(double time, const double* y, observables::Table& table) const {
  std::vector<double> places;
  for (int k = 0; k < profile_points; ++k) places.push_back(static_cast<double>(k) / (profile_points - 1));
  for (auto& point : wall_profile(network_.curve().model(), network_.mid_stretch(y), places)) {
    point.time = time;
    observables::append(table, point);
  }
}

observables::Table Observer::compartment_table() const {
  observables::Table table;
  table.add("time", "s");
  for (int i = 1; i <= network_.compartments(); ++i) {
    table.add(fmt::format("pressure.C{}", i), "dyn/cm2");
    table.add(fmt::format("lumen_radius.C{}", i), "cm");
    table.add(fmt::format("outflow.C{}", i), "cm3/s");
  }
  return table;
}

void Observer::append_compartments(double time, const double* y, observables::Table& table) const {
  std::size_t column = 0;
  const auto put = [&](double value) { table[column++].values.push_back(value); };
  put(time);
  for (const Compartment& compartment : network_.inside(time, y)) {
    put(compartment.pressure);
    put(compartment.lumen_radius);
    put(compartment.outflow);
  }
}

}  // namespace tunica::lumped
