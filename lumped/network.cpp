// SPDX-License-Identifier: GPL-3.0-or-later
#include "lumped/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/observables/result.hpp"
#include "core/radial/from_scene.hpp"

namespace tunica::lumped {

using D = Dual<double, 1>;
using std::numbers::pi;

namespace {

/// Stretch - 1 of a length whose square has grown by a share.
template <class P>
P strain_of(const P& growth) {
  using std::sqrt;
  return growth / (1.0 + sqrt(1.0 + growth));
}

}  // namespace

template <class P>
NetworkNumbers<P> Network::numbers(const SeededScene<P>& scene) const {
  NetworkNumbers<P> n{scene.number("geometry.radius"),
                      scene.number("geometry.length"),
                      scene.number("blood.viscosity"),
                      inertance_ ? scene.number("blood.density") : P(0.0),
                      P(1.0),
                      scene.number("outlet.resistance"),
                      scene.number("outlet.pressure"),
                      P(0.0),
                      P(0.0)};
  if (windkessel_) {
    n.proximal_resistance = scene.number("outlet.proximal_resistance");
    n.compliance = scene.number("outlet.compliance");
  }
  if (!inlet_.scale_key.empty()) n.inlet_scale = scene.number(inlet_.scale_key);
  // A flow that is not given follows the lumen's area, so it moves with the radius.
  if constexpr (!std::same_as<P, double>)
    if (inlet_.scale_key == "inlet.flow" && !scene.scene().was_set("inlet.flow"))
      n.inlet_scale.derivative[0] += 2 * n.inlet_scale.value / n.radius.value * n.radius.derivative[0];
  return n;
}

Network::Network(const Scene& scene, const std::vector<std::string>& parameters)
    : compartments_(static_cast<int>(scene.integer("lumped.compartments"))),
      inertance_(scene.flag("lumped.inertance")),
      windkessel_(scene.text("outlet.kind") == "rcr"),
      inlet_(inlet_from_scene(scene)) {
  numbers_ = numbers(SeededScene<double>(scene));
  for (const std::string& parameter : parameters) {
    const SeededScene<D> seeded(scene, parameter);
    seeded_.push_back(numbers(seeded));
    radial::ring_from_scene(seeded);
    if (!seeded.seed_was_read())
      throw InvalidInput(fmt::format(
          "sensitivity.parameters: the 0D model of this scene does not depend on {}; leave it out",
          parameter));
  }
  unknowns_ = compartments_ + (inertance_ ? compartments_ : 0) + (inertance_ && inlet_.is_pressure ? 1 : 0) +
              (windkessel_ ? 1 : 0);

  const auto& n = numbers_;
  const bool resistive = n.viscosity > 0;
  const double outlet = windkessel_ ? n.proximal_resistance : n.resistance;
  if (!inertance_ && !resistive && (outlet == 0 || compartments_ > 1 || inlet_.is_pressure))
    throw InvalidInput(
        "blood.viscosity = 0 leaves no resistance between pressures that differ; set it above 0 or "
        "lumped.inertance = true");
  if (windkessel_ && n.resistance == 0)
    throw InvalidInput(
        "outlet.resistance = 0 with outlet.kind = \"rcr\" shorts its compliance; set it above 0");

  wall_ = wall_table(scene, parameters);
  scales_ = typical_sizes();
}

int Network::flow_index(int link) const {
  const int with_inlet = inlet_.is_pressure ? 1 : 0;
  return link == 0 ? 0 : with_inlet + 2 * link - 1;
}

int Network::area_index(int compartment) const {
  if (!inertance_) return compartment;
  return (inlet_.is_pressure ? 1 : 0) + 2 * compartment;
}

std::vector<double> Network::rest() const {
  std::vector<double> y(unknowns_, 0.0);
  if (windkessel_) y.back() = inlet_.growth_at(0) * numbers_.outlet_pressure;
  return y;
}

std::vector<double> Network::rest_derivative(int k) const {
  std::vector<double> dy(unknowns_, 0.0);
  if (windkessel_) dy.back() = inlet_.growth_at(0) * seeded_[k].outlet_pressure.derivative[0];
  return dy;
}

std::vector<double> Network::typical_sizes() {
  const auto& n = numbers_;
  const double inlet = std::abs(n.inlet_scale) * inlet_.greatest_shape();
  const double area = pi * n.radius * n.radius, outlet = n.resistance + n.proximal_resistance;
  // The pressure that goes with the inlet's greatest value, as far as an artery can live with it.
  constexpr double least = 1, greatest = 1e6;
  const double inertance = 4.0 / 3 * n.density * n.length / area * (2 * pi / inlet_.period);
  const double along = 8 * pi * n.viscosity * n.length / (area * area) + inertance;
  working_pressure_ = std::clamp(
      std::abs(n.outlet_pressure) + (inlet_.is_pressure ? inlet : (outlet + along) * inlet), least, greatest);
  const double flow = inlet_.is_pressure ? std::max(1.0, inlet) / std::max(outlet, 1.0) : inlet;
  // dp/de, with s^2 = 1 + e.
  const double slope = 0.5 * std::abs(curve().pressure_slope(1.0));
  const double growth = working_pressure_ < slope ? working_pressure_ / slope : 1;
  std::vector<double> scale(unknowns_, std::max(flow, 1e-12));
  for (int i = 0; i < compartments_; ++i) scale[area_index(i)] = growth;
  if (windkessel_) scale.back() = working_pressure_;
  return scale;
}

void Network::magnitudes(const double* y, double* result) const {
  constexpr double absolute_share = 1e-2;
  for (int i = 0; i < unknowns_; ++i) result[i] = std::abs(y[i]) + absolute_share * scales_[i];
  for (int i = 0; i < compartments_; ++i) {
    const double area_ratio = 1 + y[area_index(i)];
    const auto stretch = radial::LumenStretch::of_strain(strain_of(y[area_index(i)]));
    const double slope = std::abs(curve().pressure_slope(stretch)) / (2 * stretch.value());
    const double size = std::max(working_pressure_, std::abs(curve().pressure(stretch)));
    result[area_index(i)] = size < slope * area_ratio ? size / slope : area_ratio;
  }
}

template <class P>
P Network::curve_pressure(const P& strain, int k) const {
  const auto s = radial::LumenStretch::of_strain(plain(strain));
  if constexpr (std::same_as<P, double>) {
    return curve().pressure(s);
  } else {
    double derivative = curve().pressure_slope(s) * strain.derivative[0];
    if (k >= 0) derivative += curve().pressure_derivative(s, k);
    return P(curve().pressure(s), {derivative});
  }
}

template <class P>
const Network::Flows<P>& Network::flows(const NetworkNumbers<P>& n, double time, const P* y, int k) const {
  const int last = compartments_;
  auto& f = std::get<Flows<P>>(flows_);
  f.pressure.resize(last);
  f.resistance.resize(last);
  f.inertance.resize(last);
  f.flow.resize(last + 1);
  const P length = n.length / static_cast<double>(compartments_);
  for (int i = 0; i < last; ++i) {
    const P growth = y[area_index(i)];
    const P area_ratio = 1.0 + growth;
    if (!(plain(area_ratio) > 0)) throw SolverFailure("the lumen has closed");
    f.pressure[i] = curve_pressure(P(strain_of(growth)), k);
    const P square = n.radius * n.radius * area_ratio;
    f.resistance[i] = 8.0 * n.viscosity * length / (pi * square * square);
    if (inertance_) f.inertance[i] = (4.0 / 3.0) * n.density * length / (pi * square);
  }
  const P inlet = n.inlet_scale * inlet_.shape_at(time);
  f.inlet_pressure = inlet;
  if (!inlet_.is_pressure)
    f.flow[0] = inlet;
  else
    f.flow[0] = inertance_ ? y[flow_index(0)] : (inlet - f.pressure[0]) / (0.5 * f.resistance[0]);
  for (int i = 1; i < last; ++i)
    f.flow[i] = inertance_
                    ? y[flow_index(i)]
                    : (f.pressure[i - 1] - f.pressure[i]) / (0.5 * (f.resistance[i - 1] + f.resistance[i]));
  const P beyond = windkessel_ ? y[unknowns_ - 1] : inlet_.growth_at(time) * n.outlet_pressure;
  const P outlet_resistance = windkessel_ ? n.proximal_resistance : n.resistance;
  f.flow[last] = inertance_
                     ? y[flow_index(last)]
                     : (f.pressure[last - 1] - beyond) / (0.5 * f.resistance[last - 1] + outlet_resistance);
  f.outlet_pressure = beyond + outlet_resistance * f.flow[last];
  return f;
}

template <class P>
void Network::rate_of(const NetworkNumbers<P>& n, double time, const P* y, int k, P* result) const {
  const Flows<P>& f = flows(n, time, y, k);
  const int last = compartments_;
  const P volume = pi * n.radius * n.radius * n.length / static_cast<double>(compartments_);
  for (int i = 0; i < last; ++i) result[area_index(i)] = (f.flow[i] - f.flow[i + 1]) / volume;
  if (inertance_) {
    if (inlet_.is_pressure)
      result[flow_index(0)] =
          (f.inlet_pressure - f.pressure[0] - 0.5 * f.resistance[0] * f.flow[0]) / (0.5 * f.inertance[0]);
    for (int i = 1; i < last; ++i)
      result[flow_index(i)] =
          (f.pressure[i - 1] - f.pressure[i] - 0.5 * (f.resistance[i - 1] + f.resistance[i]) * f.flow[i]) /
          (0.5 * (f.inertance[i - 1] + f.inertance[i]));
    result[flow_index(last)] =
        (f.pressure[last - 1] - f.outlet_pressure - 0.5 * f.resistance[last - 1] * f.flow[last]) /
        (0.5 * f.inertance[last - 1]);
  }
  if (windkessel_)
    result[unknowns_ - 1] =
        (f.flow[last] - (y[unknowns_ - 1] - inlet_.growth_at(time) * n.outlet_pressure) / n.resistance) /
        n.compliance;
}

template <class P>
P Network::mid_strain_of(const P* y) const {
  // An even number of compartments has its middle between two of them.
  const int lower = (compartments_ - 1) / 2, upper = compartments_ / 2;
  return strain_of(P(0.5 * (y[area_index(lower)] + y[area_index(upper)])));
}

template <class P>
Outside<P> Network::outside_of(const NetworkNumbers<P>& n, double time, const P* y, int k) const {
  const Flows<P>& f = flows(n, time, y, k);
  const P strain = mid_strain_of(y);
  return {f.flow.front(), f.flow.back(), f.outlet_pressure, strain, curve_pressure(strain, k)};
}

namespace {

std::vector<D> along(const double* y, const double* dy, int size) {
  std::vector<D> dual(size);
  for (int i = 0; i < size; ++i) dual[i] = D(y[i], {dy[i]});
  return dual;
}

template <class To, class From>
NetworkNumbers<To> lift(const NetworkNumbers<From>& n) {
  return {n.radius,     n.length,          n.viscosity,           n.density,   n.inlet_scale,
          n.resistance, n.outlet_pressure, n.proximal_resistance, n.compliance};
}

}  // namespace

void Network::rate(double time, const double* y, double* dydt) const {
  rate_of(numbers_, time, y, -1, dydt);
}

void Network::rate_derivative(double time, const double* y, const double* dy, int k, double* result) const {
  const std::vector<D> dual = along(y, dy, unknowns_);
  std::vector<D> rates(unknowns_);
  rate_of(k >= 0 ? seeded_[k] : lift<D>(numbers_), time, dual.data(), k, rates.data());
  for (int i = 0; i < unknowns_; ++i) result[i] = rates[i].derivative[0];
}

Outside<double> Network::outside(double time, const double* y) const {
  return outside_of(numbers_, time, y, -1);
}

Outside<D> Network::outside_derivative(double time, const double* y, const double* dy, int k) const {
  const std::vector<D> dual = along(y, dy, unknowns_);
  return outside_of(k >= 0 ? seeded_[k] : lift<D>(numbers_), time, dual.data(), k);
}

std::vector<Compartment> Network::inside(double time, const double* y) const {
  const Flows<double>& f = flows(numbers_, time, y, -1);
  std::vector<Compartment> all;
  for (int i = 0; i < compartments_; ++i)
    all.push_back({f.pressure[i], numbers_.radius * std::sqrt(1 + y[area_index(i)]), f.flow[i + 1]});
  return all;
}

radial::LumenStretch Network::mid_stretch(const double* y) const {
  return radial::LumenStretch::of_strain(mid_strain_of(y));
}

double Network::greatest_stretch(const double* y) const {
  double greatest = 0;
  for (int i = 0; i < compartments_; ++i) greatest = std::max(greatest, 1 + y[area_index(i)]);
  return std::sqrt(greatest);
}

}  // namespace tunica::lumped
