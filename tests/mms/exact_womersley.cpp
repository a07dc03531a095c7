// SPDX-License-Identifier: GPL-3.0-or-later
// Oscillating flow in a rigid pipe, driven in each of the ways there are, against Womersley's solution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "axisym/assembler.hpp"
#include "axisym/structured.hpp"
#include "tests/mms/harmonics.hpp"
#include "tests/support/march.hpp"
#include "tests/support/womersley.hpp"

namespace tunica::axisym {
namespace {

using test_support::Complex;
using test_support::Harmonic;
using test_support::Womersley;

class RigidPipeFlow : public testing::TestWithParam<std::tuple<InletKind, double>> {};

// Complex amplitudes within 0.1 %, which bounds errors of amplitude and of phase: of the velocity at every
// radius, of the pressure by its drop along the pipe. BDF2 takes i w for i w (1 + (w h)^2/3), 2e-4 with 256
// steps a period where inertia rules; the mesh's errors are smaller.
TEST_P(RigidPipeFlow, IsWomersleys) {
  const auto [drive, number] = GetParam();
  const test_support::RigidPipe pipe{0.25, 1.06, 0.035};
  const double w = std::pow(number / pipe.radius, 2) * pipe.viscosity / pipe.density;
  // Of Reynolds number 4. The solution holds for any, but blood that comes back through the outlet brings
  // in no velocity of its own, so that it is stable at low ones only.
  const auto exact = Womersley::from_flow(pipe, w, std::polar(0.03, 0.6));

  Problem problem;
  TubeSpec spec;
  spec.radius = pipe.radius;
  spec.length = 0.2;
  spec.blood_cells = 8;
  spec.axial_cells = 2;
  spec.interface_grading = 3;
  spec.wall = false;
  problem.mesh = structured_tube(spec);
  problem.blood = {pipe.density, pipe.viscosity};
  problem.velocity = [&](const Point& x, double t) { return Vector<double>{0, 0, exact.velocity(x[0], t)}; };
  // Sections slide along nothing: no radial velocity at the ends. The surface, the ends and with them the
  // mesh stay.
  for (const auto boundary : {Boundary::inlet, Boundary::outlet, Boundary::interface})
    problem.on(boundary).displacement = {true, true};
  problem.on(Boundary::inlet).velocity = {true, drive == InletKind::prescribed};
  problem.on(Boundary::outlet).velocity = {true, false};
  problem.inlet.kind = drive;
  if (drive == InletKind::flow) problem.inlet.value = [&](double t) { return exact.flow(t); };
  if (drive == InletKind::pressure)
    problem.inlet.value = [&](double t) { return exact.gradient(t) * spec.length; };
  problem.outlet.kind = OutletKind::resistance;

  const Assembler assembler(problem);
  const Layout& layout = assembler.layout();
  std::vector<double> state(layout.size()), rates(layout.size());
  const auto set = [&](std::size_t entry, Complex amplitude) {
    state[entry] = amplitude.real();
    rates[entry] = (Complex(0, -w) * amplitude).real();
  };
  for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
    const int node = static_cast<int>(n);
    const auto [r, z] = problem.mesh.points[n];
    set(layout.velocity(node, 1), exact.velocity(std::min(r, pipe.radius)));
    if (layout.has_pressure(node)) set(layout.pressure(node), exact.gradient() * (spec.length - z));
  }
  if (layout.inlet_pressure) set(*layout.inlet_pressure, exact.gradient() * spec.length);
  time::Scheme scheme(time::Method::bdf2);
  scheme.start(0, state, rates);

  constexpr int period = 256;
  std::map<int, Harmonic> velocity, pressure;  // by node
  for (std::size_t n = 0; n < problem.mesh.points.size(); ++n) {
    velocity.emplace(n, w);
    if (layout.has_pressure(static_cast<int>(n))) pressure.emplace(n, w);
  }
  // What the start excites, which is small, decays by exp(-5.78 nu t / R^2).
  const std::vector<double> steps(3 * period, 2 * std::numbers::pi / w / period);
  std::size_t done = 0;
  ASSERT_TRUE(test_support::march(assembler, scheme, steps, 1e-9, [&] {
    if (++done <= 2 * period) return;
    for (auto& [node, harmonic] : velocity)
      harmonic.add(scheme.time(), scheme.value()[layout.velocity(node, 1)]);
    for (auto& [node, harmonic] : pressure)
      harmonic.add(scheme.time(), scheme.value()[layout.pressure(node)]);
  }));

  // Relative to the amplitude at each place.
  double velocity_error = 0, pressure_error = 0;
  for (const auto& [node, harmonic] : velocity) {
    const double r = problem.mesh.points[node][0];
    if (layout.on_wall(node)) continue;
    velocity_error = std::max(velocity_error, std::abs(harmonic.amplitude() / exact.velocity(r) - 1.0));
  }
  for (const auto& [node, harmonic] : pressure) {
    const Complex expected = exact.gradient() * (spec.length - problem.mesh.points[node][1]);
    pressure_error = std::max(
        pressure_error, std::abs(harmonic.amplitude() - expected) / std::abs(exact.gradient() * spec.length));
  }
  RecordProperty("velocity", std::to_string(velocity_error));
  RecordProperty("pressure", std::to_string(pressure_error));
  EXPECT_LT(velocity_error, 1e-3);
  EXPECT_LT(pressure_error, 1e-3);
}

std::string case_name(const testing::TestParamInfo<std::tuple<InletKind, double>>& test) {
  const auto [drive, number] = test.param;
  constexpr std::array<const char*, 3> names{"velocity", "flow", "pressure"};
  return std::string("driven_by_") + names[static_cast<std::size_t>(drive)] + "_at_number_" +
         (number < 1 ? "half" : std::to_string(static_cast<int>(number)));
}

INSTANTIATE_TEST_SUITE_P(Drives, RigidPipeFlow,
                         testing::Combine(testing::Values(InletKind::prescribed, InletKind::flow,
                                                          InletKind::pressure),
                                          testing::Values(0.5, 3.0, 10.0)),
                         case_name);

}  // namespace
}  // namespace tunica::axisym
