// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "core/coupled/conditions.hpp"
#include "tests/mms/harmonics.hpp"
#include "tests/support/march.hpp"
#include "tests/support/round_place.hpp"
#include "tests/support/tube_waves.hpp"

namespace tunica::test_support {

/// Pulse waves of small amplitude in a thick elastic tube full of blood, ends moved as the exact waves say.
class ElasticTubeWaves {
 public:
  ElasticTubeWaves(const ElasticTube& tube, double length, double frequency)
      : tube_(tube),
        length_(length),
        frequency_(frequency),
        w_(2 * std::numbers::pi * frequency),
        waves_(ElasticWomersley(tube, w_), length, Complex(1, 0.3), Complex(-0.4, 0.5)) {}

  template <int dimension>
  void set_conditions(coupled::Conditions<dimension>& conditions) const {
    using coupled::Boundary;
    conditions.blood = {tube_.blood_density, tube_.viscosity};
    conditions.laws = {
        wall::EnergyLaw<wall::LinearElastic<double>>{{tube_.young_modulus, tube_.poisson_ratio}}};
    conditions.wall_density = tube_.wall_density;
    conditions.tether = {tube_.tether, radial::TetherTraction::reference};
    conditions.outlet.kind = coupled::OutletKind::prescribed;
    const auto at_time = [this](const auto& place, const Vector<Complex>& amplitude, double t) {
      return at_phase(place.vector(amplitude), std::polar(1.0, -w_ * t));
    };
    conditions.displacement = [=, this](const auto& x, double t) {
      const auto place = round_place(x);
      return at_time(place, displacement(place.radius, place.height), t);
    };
    conditions.velocity = [=, this](const auto& x, double t) {
      const auto place = round_place(x);
      return at_time(place, velocity(place.radius, place.height), t);
    };
    for (const auto boundary :
         {Boundary::inlet, Boundary::outlet, Boundary::wall_inlet, Boundary::wall_outlet})
      conditions.on(boundary).displacement.fill(true);
    for (const auto boundary : {Boundary::inlet, Boundary::outlet})
      conditions.on(boundary).velocity.fill(true);
  }

  /// Marches for two periods and holds the complex amplitudes in the second one against the exact ones.
  /// Vectors by component: at the ends, where what is prescribed meets what time steps make of it, the
  /// smaller component is that of the layer between them, and only the vector is compared.
  template <std::size_t dimension>
  void expect_within(double tolerance, const coupled::Equations& equations,
                     const std::vector<std::array<double, dimension>>& points, int steps_in_period) const {
    constexpr int axial = static_cast<int>(dimension) - 1;
    const coupled::Layout& layout = equations.layout();
    std::vector<Complex> exact(layout.size());
    for (int node = 0; node < layout.nodes(); ++node) {
      const auto place = round_place(points[node]);
      const auto d = displacement(place.radius, place.height), v = velocity(place.radius, place.height);
      for (int c = 0; c <= axial; ++c) {
        exact[layout.displacement(node, c)] = place.component(d, c);
        exact[layout.velocity(node, c)] = place.component(v, c);
      }
      if (layout.has_pressure(node))
        exact[layout.pressure(node)] =
            waves_.blood(std::min(place.radius, tube_.radius), place.height).pressure;
    }
    const std::vector<Harmonic> computed = march_waves(equations, exact, steps_in_period);

    std::array<double, fields> error{}, size{}, error_amid{};
    for (int node = 0; node < layout.nodes(); ++node) {
      const bool is_amid = std::abs(points[node][axial] / length_ - 0.5) < 0.2;
      const auto compare = [&](Field field, std::size_t first, int count) {
        double distance = 0, exact_size = 0;
        for (std::size_t e = first; e < first + count; ++e) {
          distance = std::hypot(distance, std::abs(computed[e].amplitude() - exact[e]));
          exact_size = std::hypot(exact_size, std::abs(exact[e]));
        }
        size[field] = std::max(size[field], exact_size);
        error[field] = std::max(error[field], distance);
        if (is_amid) error_amid[field] = std::max(error_amid[field], distance);
      };
      if (layout.on_wall(node)) {
        compare(radial_displacement, layout.displacement(node, 0), axial);
        compare(axial_displacement, layout.displacement(node, axial), 1);
      }
      compare(radial_velocity, layout.velocity(node, 0), axial);
      compare(axial_velocity, layout.velocity(node, axial), 1);
      if (layout.has_pressure(node)) compare(pressure, layout.pressure(node), 1);
    }
    for (int f = 0; f < fields; ++f) {
      testing::Test::RecordProperty(names[f], std::to_string(error_amid[f] / size[f]));
      EXPECT_LT(error_amid[f] / size[f], tolerance) << names[f];
    }
    const auto expect_vector = [&](Field radial, Field along) {
      const double relative = std::hypot(error[radial], error[along]) / std::hypot(size[radial], size[along]);
      testing::Test::RecordProperty(std::string("all of ") + names[along], std::to_string(relative));
      EXPECT_LT(relative, tolerance) << names[along];
    };
    expect_vector(radial_displacement, axial_displacement);
    expect_vector(radial_velocity, axial_velocity);
    EXPECT_LT(error[pressure] / size[pressure], tolerance);
  }

 private:
  enum Field { radial_displacement, axial_displacement, radial_velocity, axial_velocity, pressure, fields };
  static constexpr std::array<const char*, fields> names{"radial displacement", "axial displacement",
                                                         "radial velocity", "axial velocity", "pressure"};

  // Wave pressures are of order 1 dyn/cm2, strains of order 1e-6: what is not linear is as small.
  Vector<Complex> displacement(double r, double z) const {
    if (r >= tube_.radius) return waves_.wall(std::min(r, tube_.outer_radius()), z).displacement;
    // Of the mesh, any continuation of the interface's will do.
    const auto at_wall = waves_.wall(tube_.radius, z).displacement;
    const double share = r / tube_.radius;
    return {share * at_wall[0], 0, share * share * at_wall[2]};
  }
  Vector<Complex> velocity(double r, double z) const {
    if (r < tube_.radius) return waves_.blood(r, z).velocity;
    Vector<Complex> rate = displacement(r, z);
    for (Complex& component : rate) component *= Complex(0, -w_);
    return rate;
  }

  std::vector<Harmonic> march_waves(const coupled::Equations& equations, const std::vector<Complex>& exact,
                                    int steps_in_period) const {
    std::vector<double> state(exact.size()), rates(exact.size());
    for (std::size_t e = 0; e < exact.size(); ++e) {
      state[e] = exact[e].real();
      rates[e] = (Complex(0, -w_) * exact[e]).real();
    }
    time::Scheme scheme(time::Method::bdf2);
    scheme.start(0, state, rates);
    const std::vector<double> steps(2 * steps_in_period, 1 / frequency_ / steps_in_period);
    std::vector<Harmonic> computed(exact.size(), Harmonic(w_));
    int done = 0;
    march(equations, scheme, steps, 1e-9, [&] {
      if (++done <= steps_in_period) return;
      for (std::size_t e = 0; e < exact.size(); ++e) computed[e].add(scheme.time(), scheme.value()[e]);
    });
    return computed;
  }

  ElasticTube tube_;
  double length_, frequency_, w_;
  TubeWaves waves_;
};

}  // namespace tunica::test_support
