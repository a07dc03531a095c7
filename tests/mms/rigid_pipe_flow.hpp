// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "core/coupled/conditions.hpp"
#include "tests/mms/harmonics.hpp"
#include "tests/support/march.hpp"
#include "tests/support/round_place.hpp"
#include "tests/support/womersley.hpp"

namespace tunica::test_support {

/// Oscillating flow in a piece of a rigid pipe, driven in one of the ways there are: Womersley's.
class RigidPipeFlow {
 public:
  static constexpr RigidPipe pipe{0.25, 1.06, 0.035};
  static constexpr double length = 0.2;

  RigidPipeFlow(coupled::InletKind drive, double number)
      : drive_(drive),
        w_(std::pow(number / pipe.radius, 2) * pipe.viscosity / pipe.density),
        // Of Reynolds number 4. The solution holds for any, but blood that comes back through the outlet
        // brings in no velocity of its own, so that it is stable at low ones only.
        exact_(Womersley::from_flow(pipe, w_, std::polar(0.03, 0.6))) {}

  template <int dimension>
  void set_conditions(coupled::Conditions<dimension>& conditions) const {
    using coupled::Boundary;
    conditions.blood = {pipe.density, pipe.viscosity};
    conditions.velocity = [this](const auto& x, double t) {
      return Vector<double>{0, 0, exact_.velocity(std::min(round_place(x).radius, pipe.radius), t)};
    };
    // Sections slide along nothing: no velocity in the ends' planes. The surface, the ends and with them the
    // mesh stay.
    for (const auto boundary : {Boundary::inlet, Boundary::outlet, Boundary::interface})
      conditions.on(boundary).displacement.fill(true);
    conditions.on(Boundary::inlet).velocity.fill(true);
    conditions.on(Boundary::inlet).velocity.back() = drive_ == coupled::InletKind::prescribed;
    conditions.on(Boundary::outlet).velocity.fill(true);
    conditions.on(Boundary::outlet).velocity.back() = false;
    conditions.inlet.kind = drive_;
    if (drive_ == coupled::InletKind::flow)
      conditions.inlet.value = [this](double t) { return exact_.flow(t); };
    if (drive_ == coupled::InletKind::pressure)
      conditions.inlet.value = [this](double t) { return exact_.gradient(t) * length; };
    conditions.outlet.kind = coupled::OutletKind::resistance;
  }

  /// Of complex amplitudes: of the velocity at every node relative to that at its radius, of the pressure
  /// relative to its drop along the pipe.
  struct Errors {
    double velocity = 0, pressure = 0;
  };
  template <std::size_t dimension>
  Errors errors(const coupled::Equations& equations, const std::vector<std::array<double, dimension>>& points,
                int steps_in_period) const {
    constexpr int axial = static_cast<int>(dimension) - 1;
    const coupled::Layout& layout = equations.layout();
    std::vector<double> state(layout.size()), rates(layout.size());
    std::map<std::size_t, Harmonic> harmonics;  // by entry
    const auto set = [&](std::size_t entry, Complex amplitude) {
      state[entry] = amplitude.real();
      rates[entry] = (Complex(0, -w_) * amplitude).real();
      harmonics.emplace(entry, w_);
    };
    const auto pressure = [&](int node) { return exact_.gradient() * (length - points[node][axial]); };
    const auto velocity = [&](int node) {
      return exact_.velocity(std::min(round_place(points[node]).radius, pipe.radius));
    };
    for (int node = 0; node < layout.nodes(); ++node) {
      for (int c = 0; c <= axial; ++c)
        set(layout.velocity(node, c), c == axial ? velocity(node) : Complex(0));
      if (layout.has_pressure(node)) set(layout.pressure(node), pressure(node));
    }
    if (layout.inlet_pressure) set(*layout.inlet_pressure, exact_.gradient() * length);
    time::Scheme scheme(time::Method::bdf2);
    scheme.start(0, state, rates);
    // What the start excites, which is small, decays by exp(-5.78 nu t / R^2).
    const std::vector<double> steps(3 * steps_in_period, 2 * std::numbers::pi / w_ / steps_in_period);
    int done = 0;
    march(equations, scheme, steps, 1e-9, [&] {
      if (++done <= 2 * steps_in_period) return;
      for (auto& [entry, harmonic] : harmonics) harmonic.add(scheme.time(), scheme.value()[entry]);
    });
    const auto amplitude = [&](std::size_t entry) { return harmonics.at(entry).amplitude(); };
    Errors greatest;
    for (int node = 0; node < layout.nodes(); ++node) {
      if (layout.has_pressure(node))
        greatest.pressure =
            std::max(greatest.pressure, std::abs(amplitude(layout.pressure(node)) - pressure(node)) /
                                            std::abs(exact_.gradient() * length));
      if (layout.on_wall(node)) continue;
      for (int c = 0; c <= axial; ++c) {
        const Complex expected = c == axial ? velocity(node) : 0;
        greatest.velocity =
            std::max(greatest.velocity,
                     std::abs(amplitude(layout.velocity(node, c)) - expected) / std::abs(velocity(node)));
      }
    }
    testing::Test::RecordProperty("velocity", testing::PrintToString(greatest.velocity));
    testing::Test::RecordProperty("pressure", testing::PrintToString(greatest.pressure));
    return greatest;
  }

  /// Of a case.
  static std::string name(coupled::InletKind drive, double number) {
    constexpr std::array<const char*, 3> names{"velocity", "flow", "pressure"};
    return std::string("driven_by_") + names[static_cast<std::size_t>(drive)] + "_at_number_" +
           (number < 1 ? "half" : std::to_string(static_cast<int>(number)));
  }

 private:
  coupled::InletKind drive_;
  double w_;
  Womersley exact_;
};

}  // namespace tunica::test_support
