// SPDX-License-Identifier: GPL-3.0-or-later
// Pulse waves of small amplitude in a thick elastic tube full of blood, ends moved as the exact waves say.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "tests/mms/harmonics.hpp"
#include "tests/support/march.hpp"
#include "tests/support/tube_waves.hpp"

namespace tunica::axisym {
namespace {

using test_support::Complex;
using test_support::ElasticTube;
using test_support::ElasticWomersley;
using test_support::Harmonic;
using test_support::TubeWaves;

struct Case {
  const char* name;
  ElasticTube tube;
  double length, frequency;
  int blood_cells, axial_cells;
  double interface_grading;
};
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

class ElasticTubeWaves : public testing::TestWithParam<Case> {};

/// Vectors by component: at the ends, where what is prescribed meets what time steps make of it, the smaller
/// component is that of the layer between them, and only the vector is compared.
enum Field { radial_displacement, axial_displacement, radial_velocity, axial_velocity, pressure, fields };
constexpr std::array<const char*, fields> names{"radial displacement", "axial displacement",
                                                "radial velocity", "axial velocity", "pressure"};

TEST_P(ElasticTubeWaves, AreTheExactOnes) {
  const Case& c = GetParam();
  const double w = 2 * std::numbers::pi * c.frequency;
  const TubeWaves waves(ElasticWomersley(c.tube, w), c.length, Complex(1, 0.3), Complex(-0.4, 0.5));

  Problem problem;
  TubeSpec spec;
  spec.radius = c.tube.radius;
  spec.layers = {c.tube.thickness};
  spec.length = c.length;
  spec.blood_cells = c.blood_cells;
  spec.wall_cells = 2;
  spec.axial_cells = c.axial_cells;
  spec.interface_grading = c.interface_grading;
  problem.mesh = structured_tube(spec);
  problem.blood = {c.tube.blood_density, c.tube.viscosity};
  problem.laws = {wall::EnergyLaw<wall::LinearElastic<double>>{{c.tube.young_modulus, c.tube.poisson_ratio}}};
  problem.wall_density = c.tube.wall_density;
  problem.tether = {c.tube.tether, radial::TetherTraction::reference};
  problem.outlet.kind = OutletKind::prescribed;

  // Wave pressures are of order 1 dyn/cm2, strains of order 1e-6: what is not linear is as small.
  const auto exact_displacement = [&](const Point& x) -> Vector<Complex> {
    const auto [r, z] = x;
    if (r >= c.tube.radius) return waves.wall(std::min(r, c.tube.outer_radius()), z).displacement;
    // Of the mesh, any continuation of the interface's will do.
    const auto at_wall = waves.wall(c.tube.radius, z).displacement;
    const double share = r / c.tube.radius;
    return {share * at_wall[0], 0, share * share * at_wall[2]};
  };
  const auto exact_velocity = [&](const Point& x) -> Vector<Complex> {
    if (x[0] < c.tube.radius) return waves.blood(x[0], x[1]).velocity;
    Vector<Complex> rate = exact_displacement(x);
    for (Complex& component : rate) component *= Complex(0, -w);
    return rate;
  };
  const auto phase = [&](double t) { return std::polar(1.0, -w * t); };
  problem.displacement = [&](const Point& x, double t) {
    return test_support::at_phase(exact_displacement(x), phase(t));
  };
  problem.velocity = [&](const Point& x, double t) {
    return test_support::at_phase(exact_velocity(x), phase(t));
  };
  for (const auto boundary : {Boundary::inlet, Boundary::outlet, Boundary::wall_inlet, Boundary::wall_outlet})
    problem.on(boundary).displacement = {true, true};
  for (const auto boundary : {Boundary::inlet, Boundary::outlet})
    problem.on(boundary).velocity = {true, true};

  const Assembler assembler(problem);
  const Layout& layout = assembler.layout();
  std::vector<Complex> exact(layout.size());
  for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
    const int node = static_cast<int>(n);
    const Point& x = problem.mesh.points[n];
    const auto d = exact_displacement(x), v = exact_velocity(x);
    for (int i = 0; i < 2; ++i) {
      exact[layout.displacement(node, i)] = d[2 * i];
      exact[layout.velocity(node, i)] = v[2 * i];
    }
    if (layout.has_pressure(node))
      exact[layout.pressure(node)] = waves.blood(std::min(x[0], c.tube.radius), x[1]).pressure;
  }
  std::vector<double> state(exact.size()), rates(exact.size());
  for (std::size_t e = 0; e < exact.size(); ++e) {
    state[e] = exact[e].real();
    rates[e] = (Complex(0, -w) * exact[e]).real();
  }
  time::Scheme scheme(time::Method::bdf2);
  scheme.start(0, state, rates);
  constexpr int period = 256;
  const std::vector<double> steps(2 * period, 1 / c.frequency / period);
  std::vector<Harmonic> computed(exact.size(), Harmonic(w));
  std::size_t done = 0;
  ASSERT_TRUE(test_support::march(assembler, scheme, steps, 1e-9, [&] {
    if (++done <= period) return;
    for (std::size_t e = 0; e < exact.size(); ++e) computed[e].add(scheme.time(), scheme.value()[e]);
  }));

  std::array<double, fields> error{}, size{}, error_amid{};
  for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
    const int node = static_cast<int>(n);
    const bool is_amid = std::abs(problem.mesh.points[n][1] / c.length - 0.5) < 0.2;
    const auto compare = [&](Field field, std::size_t entry) {
      const double distance = std::abs(computed[entry].amplitude() - exact[entry]);
      size[field] = std::max(size[field], std::abs(exact[entry]));
      error[field] = std::max(error[field], distance);
      if (is_amid) error_amid[field] = std::max(error_amid[field], distance);
    };
    if (layout.on_wall(node)) {
      compare(radial_displacement, layout.displacement(node, 0));
      compare(axial_displacement, layout.displacement(node, 1));
    }
    compare(radial_velocity, layout.velocity(node, 0));
    compare(axial_velocity, layout.velocity(node, 1));
    if (layout.has_pressure(node)) compare(pressure, layout.pressure(node));
  }
  for (int f = 0; f < fields; ++f) {
    RecordProperty(names[f], std::to_string(error_amid[f] / size[f]));
    EXPECT_LT(error_amid[f] / size[f], 1e-3) << names[f];
  }
  const auto expect_vector = [&](Field radial, Field axial) {
    const double relative = std::hypot(error[radial], error[axial]) / std::hypot(size[radial], size[axial]);
    RecordProperty(std::string("all of ") + names[axial], std::to_string(relative));
    EXPECT_LT(relative, 1e-3) << names[axial];
  };
  expect_vector(radial_displacement, axial_displacement);
  expect_vector(radial_velocity, axial_velocity);
  EXPECT_LT(error[pressure] / size[pressure], 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Tubes, ElasticTubeWaves,
    testing::Values(Case{"artery_5_Hz", {0.033, 0.01, 4e5, 0.45, 1.2, 1.0, 0.035, 1e7}, 0.3, 5, 4, 6, 2},
                    Case{"artery_100_Hz", {0.033, 0.01, 4e5, 0.45, 1.2, 1.0, 0.035, 1e7}, 0.3, 100, 7, 12, 2},
                    Case{"benchmark_2_Hz", {0.5, 0.1, 3e6, 0.3, 1.2, 1.0, 0.03, 0}, 3, 2, 12, 6, 3}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace tunica::axisym
