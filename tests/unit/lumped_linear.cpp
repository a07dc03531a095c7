// SPDX-License-Identifier: GPL-3.0-or-later
// The 0D tier where its answer is known: a wall that is linear over what the run sees of it.
#include <fmt/format.h>

#include <complex>
#include <fstream>

#include "core/radial/wall_curve.hpp"
#include "tests/support/lumped_runs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tunica {
namespace {

using test_support::column;
using test_support::joined;
using test_support::run_lumped;
using test_support::TemporaryFolder;

constexpr double pi = 3.14159265358979323846;
constexpr double inner = 0.033, outer = 0.043, length = 0.66;

/// Exactly incompressible tissue of next to no stiffness in a stiff bed: K u_o = p and, the area
/// between the surfaces being constant, dA = 2 pi R_o du_o, so that C = L 2 pi R_o/K. Strains are
/// 1e-5, and what is nonlinear is smaller by as much.
const std::vector<std::string> linear_wall{"wall.law=neo-Hookean", "wall.shear_modulus=1",
                                           "wall.incompressible=true", "tether.stiffness=1e11"};
constexpr double linear_compliance = length * 2 * pi * outer / 1e11;

// Step response: p = R q (1 - exp(-t/RC)). Flow and resistance are such that RC is 0.1 s.
TEST(LumpedLinear, ConstantInflowChargesTheCompliance) {
  const double resistance = 0.1 / linear_compliance, flow = 1e5 / resistance;
  const Result result =
      run_lumped(joined(linear_wall, {"inlet.waveform=constant", fmt::format("inlet.flow={}", flow),
                                      fmt::format("outlet.resistance={}", resistance), "blood.viscosity=0",
                                      "time.ramp=0", "time.beats=1", "accuracy.tolerance=1e-9"}));
  const auto& time = column(result.observables, "time");
  const auto& pressure = column(result.observables, "pressure");
  const auto& outflow = column(result.observables, "outflow");
  double worst = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double share = 1 - std::exp(-time[k] / 0.1);
    worst = std::max(worst, std::abs(pressure[k] / 1e5 - share));
    EXPECT_NEAR(outflow[k] / flow, pressure[k] / 1e5, 1e-9);
    EXPECT_NEAR(column(result.observables, "outlet_pressure")[k], pressure[k], 1e-6)
        << "no viscosity, no drop";
  }
  // The area, of order 1, is known to 1e-11; pressure is 1e10 times its change by 1: some dyn/cm2.
  EXPECT_LT(worst, 1e-4);
}

/// One period of mean + amplitude cos(2 pi t/T).
void write_cosine(const TemporaryFolder& folder, double mean, double amplitude, double period) {
  std::ofstream file(folder.path() / "cosine.csv");
  file << "time[s],flow[cm3/s]\n";
  constexpr int samples = 400;
  for (int k = 0; k <= samples; ++k)
    file << fmt::format("{:.17g},{:.17g}\n", period * k / samples,
                        mean + amplitude * std::cos(2 * pi * k / samples));
}

// About a mean pressure every wall is linear for small oscillations: p = R q/(1 + i w R C) with
// C = L dA/dp. Terms of second order change the first harmonic by the square of the relative
// amplitude, 1e-6; the waveform's spline by (2 pi/400)^4/384; errors of 1e-11 per step are 1e-8 of
// the oscillation, times some hundred steps.
TEST(LumpedLinear, SmallOscillationsHaveAmplitudeAndPhaseOfTheirCompliance) {
  const double resistance = 1.032e6, mean = 0.1, amplitude = 1e-4, period = 0.2;
  const TemporaryFolder folder;
  write_cosine(folder, mean, amplitude, period);
  for (const char* law : test_support::paper_laws) {
    SCOPED_TRACE(law);
    const std::vector<std::string> wall{std::string("wall.law=") + law};
    const Result result = run_lumped(
        joined(wall, {"inlet.waveform=cosine.csv", "blood.viscosity=0", "time.start=periodic", "time.beats=1",
                      "accuracy.tolerance=1e-9", "output.interval=5e-4", "output.profile_times=[]"}),
        folder.path());
    // The wall's own slope from a second difference of direct equilibria, not from the tier's table.
    const auto model = test_support::model_with(wall);
    const double target = resistance * mean;
    double lower = 1.0, upper = 2.5;
    for (int k = 0; k < 80; ++k) {
      const double middle = 0.5 * (lower + upper);
      (model->respond(middle, {}, false).pressure < target ? lower : upper) = middle;
    }
    const double s = lower, h = 1e-5;
    const double slope =
        (model->respond(s + h, {}, false).pressure - model->respond(s - h, {}, false).pressure) / (2 * h);
    const double compliance = length * 2 * pi * inner * inner * s / slope;
    const double w = 2 * pi / period * resistance * compliance;

    const auto p = test_support::harmonic(column(result.observables, "pressure"), 0);
    EXPECT_NEAR(p.amplitude() / (resistance * amplitude / std::sqrt(1 + w * w)), 1, 2e-5);
    EXPECT_NEAR(p.phase(), std::atan(w), 2e-5);
    const auto q = test_support::harmonic(column(result.observables, "outflow"), 0);
    EXPECT_NEAR(q.amplitude() / (amplitude / std::sqrt(1 + w * w)), 1, 2e-5);
  }
}

// rcr beyond a linear compliance: 2 equations with constant coefficients, whose response to a cosine is
// p = q/(i w C + 1/Z), Z = R_p + R/(1 + i w R C_w).
TEST(LumpedLinear, RcrImpedance) {
  const double period = 0.2, w = 2 * pi / period, amplitude = 1e-4;
  const double proximal = 2e5, distal = 8e5, windkessel = 5e-8;
  const TemporaryFolder folder;
  write_cosine(folder, 0.1, amplitude, period);
  const Result result = run_lumped(
      {"outlet.kind=rcr", "outlet.proximal_resistance=2e5", "outlet.resistance=8e5", "outlet.compliance=5e-8",
       "inlet.waveform=cosine.csv", "blood.viscosity=0", "time.start=periodic", "time.beats=1",
       "accuracy.tolerance=1e-9", "output.interval=5e-4", "output.profile_times=[]", "wall.law=EXP1"},
      folder.path());
  const radial::WallCurve curve(test_support::model_with({"wall.law=EXP1"}), {});
  const double s = curve.stretch_at(0.1 * (proximal + distal));
  const double compliance = length * 2 * pi * inner * inner * s / curve.pressure_slope(s);
  using Complex = std::complex<double>;
  const Complex outlet = proximal + distal / (1.0 + Complex(0, w * distal * windkessel));
  const Complex pressure = amplitude / (Complex(0, w * compliance) + 1.0 / outlet);
  const auto p = test_support::harmonic(column(result.observables, "pressure"), 0);
  EXPECT_NEAR(p.amplitude() / std::abs(pressure), 1, 2e-5);
  EXPECT_NEAR(p.phase(), -std::arg(pressure), 2e-5);
  const auto q = test_support::harmonic(column(result.observables, "outflow"), 0);
  EXPECT_NEAR(q.amplitude() / std::abs(pressure / outlet), 1, 2e-5);
}

// Poiseuille's law end to end, whatever the number of compartments. The bed widens the lumen by 4e-4 of
// its radius, linearly along the artery, so that the radius in the middle stands for its mean.
TEST(LumpedLinear, SteadyPressureDropIsPoiseuilles) {
  for (const int compartments : {1, 2, 5, 9}) {
    for (const char* inertance : {"false", "true"}) {
      SCOPED_TRACE(testing::Message() << compartments << " compartments, inertance " << inertance);
      const Result result =
          run_lumped({"wall.law=neo-Hookean", "wall.shear_modulus=1", "wall.incompressible=true",
                      "tether.stiffness=1e10", "inlet.waveform=pressure", "inlet.pressure=1e5",
                      "blood.viscosity=0.35", "time.beats=1", "outlet.resistance=1e6",
                      "accuracy.tolerance=1e-6", fmt::format("lumped.compartments={}", compartments),
                      fmt::format("lumped.inertance={}", inertance)});
      const double flow = column(result.observables, "outflow").back();
      const double drop = 1e5 - column(result.observables, "outlet_pressure").back();
      const double radius = inner + column(result.observables, "radial_displacement.P1").back();
      const double poiseuille = 8 * 0.35 * length / (pi * std::pow(radius, 4));
      EXPECT_NEAR(drop / flow / poiseuille, 1, 5e-5);
      EXPECT_NEAR(column(result.observables, "inflow").back() / flow, 1, 1e-5);
      EXPECT_NEAR(column(result.observables, "outlet_pressure").back() / (1e6 * flow), 1, 1e-9);
      // Mid-length is half-way.
      EXPECT_NEAR(1e5 - column(result.observables, "pressure").back(), 0.5 * drop, 1e-4 * drop);
    }
  }
}

}  // namespace
}  // namespace tunica
