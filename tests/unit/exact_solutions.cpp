// SPDX-License-Identifier: GPL-3.0-or-later
// Bessel functions of complex argument, oscillating flow in a rigid pipe, the linear elastic tube.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "tests/support/bessel.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/lame_tube.hpp"
#include "tests/support/womersley.hpp"

namespace tunica::test_support {
namespace {

constexpr double pi = std::numbers::pi;

/// Simpson's rule; the integrands are smooth on the scale (upper - lower)/30 or so.
template <class Function>
auto integral(const Function& f, double lower, double upper) {
  constexpr int panels = 2000;
  const double h = (upper - lower) / panels;
  auto sum = f(lower) + f(upper);
  for (int k = 1; k < panels; ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * f(lower + k * h);
  return sum * (h / 3);
}

double gap(LongComplex actual, LongComplex expected) {
  return static_cast<double>(std::abs(actual - expected) / std::abs(expected));
}

// I0(x e^{i pi/4}) = ber x + i bei x, K0(x e^{i pi/4}) = ker x + i kei x (DLMF 10.61), whose tables
// (Abramowitz and Stegun, 9.12) have ten digits; here 20, summed from the defining series in 30 digits.
TEST(ComplexBessel, KelvinFunctions) {
  struct Row {
    long double x, ber, bei, ker, kei;
  };
  const std::array rows{Row{0.125L, 0.99999618530313859486L, 0.0039062483443154860652L,
                            2.1984269208858803287L, -0.77291324800657866509L},
                        Row{1, 0.98438178121308688397L, 0.24956604003665972142L, 0.28670620872831604595L,
                            -0.49499463651871990035L},
                        Row{2, 0.75173418271380822855L, 0.9722916273066612061L, -0.041664513991509532259L,
                            -0.20240006776470428829L},
                        Row{5, -6.2300824786663577332L, 0.1160343815502003781L, -0.01151172719949066247L,
                            0.011187586509869639657L},
                        Row{10, 138.84046594163264721L, 56.370458553906638233L, 0.00012946633021480612215L,
                            -0.00030752456908814419902L},
                        Row{20, 47489.370265061760145L, 114775.19736006622162L, -7.7152331098609614611e-8L,
                            -1.8589415111194372053e-7L},
                        Row{50, -117623968512357.44233L, -50192646254462.213707L, -2.9150770893967982718e-17L,
                            7.2558132203655989599e-17L}};
  for (const Row& row : rows) {
    const LongComplex z = row.x * std::sqrt(0.5L) * LongComplex(1, 1);
    // 64-bit mantissas, lost to the exponential of an argument of size x.
    EXPECT_LT(gap(bessel_i(z).zero, {row.ber, row.bei}), 1e-17) << "x = " << row.x;
    EXPECT_LT(gap(bessel_k(z).zero, {row.ker, row.kei}), 1e-17) << "x = " << row.x;
  }
}

TEST(ComplexBessel, RealAndImaginaryAxes) {
  for (const double x : {1e-6, 0.01, 0.7, 1.999, 2.001, 5.0, 17.0, 80.0}) {
    SCOPED_TRACE(x);
    const BesselI i = bessel_i(x), j = bessel_i(LongComplex(0, x));
    const BesselK k = bessel_k(x), y = bessel_k(LongComplex(0, x));
    // The standard library's functions, which themselves err by some 1e-14 of size 1.
    for (const auto& [order, value] : {std::pair(0, i.zero), std::pair(1, i.one), std::pair(2, i.two)})
      EXPECT_LT(gap(value, std::cyl_bessel_il(order, x)), 2e-14) << order;
    for (const auto& [order, value] : {std::pair(0, k.zero), std::pair(1, k.one), std::pair(2, k.two)})
      EXPECT_LT(gap(value, std::cyl_bessel_kl(order, x)), 2e-14) << order;
    // I_n(ix) = i^n J_n(x), K0(ix) = -pi/2 (Y0 + i J0), K1(ix) = -pi/2 (J1 - i Y1)
    const long double j0 = std::cyl_bessel_jl(0, x), j1 = std::cyl_bessel_jl(1, x);
    const long double y0 = std::cyl_neumannl(0, x), y1 = std::cyl_neumannl(1, x);
    const long double half_pi = std::numbers::pi_v<long double> / 2;
    EXPECT_LT(std::abs(j.zero - j0), 2e-14);
    EXPECT_LT(std::abs(j.one - LongComplex(0, j1)), 2e-14);
    EXPECT_LT(gap(y.zero, -half_pi * LongComplex(y0, j0)), 2e-14);
    EXPECT_LT(gap(y.one, -half_pi * LongComplex(j1, -y1)), 2e-14);
  }
}

// I0 K1 + I1 K0 = 1/z and I1 K2 + I2 K1 = 1/z over the right half-plane, on both sides of every switch of
// method.
TEST(ComplexBessel, Wronskians) {
  for (const long double size : {1e-5L, 0.1L, 1.0L, 1.99L, 2.01L, 6.0L, 20.0L, 50.0L, 400.0L})
    for (int k = -8; k <= 8; ++k) {
      const LongComplex z = std::polar(size, k * std::numbers::pi_v<long double> / 16);
      if (z.real() < 0) continue;  // round-off of the angle pi/2
      SCOPED_TRACE(testing::Message() << size << " at " << k << " pi/16");
      const BesselI i = bessel_i(z);
      const BesselK kk = bessel_k(z);
      EXPECT_LT(std::abs((i.zero * kk.one + i.one * kk.zero) * z - 1.0L), 1e-16);
      EXPECT_LT(std::abs((i.one * kk.two + i.two * kk.one) * z - 1.0L), 1e-16);
    }
}

TEST(ComplexBessel, LeftHalfPlane) {
  const LongComplex z(0.7L, 2.1L);
  EXPECT_EQ(bessel_i(-z).zero, bessel_i(z).zero);
  EXPECT_EQ(bessel_i(-z).one, -bessel_i(z).one);
  EXPECT_EQ(bessel_i(0).zero, LongComplex(1));
  EXPECT_THROW(bessel_k(-z), std::domain_error);
  EXPECT_THROW(bessel_k(0), std::domain_error);
}

/// The paper's artery.
constexpr RigidPipe pipe{0.033, 1.0, 0.035};

double frequency_of(double womersley_number) {
  return std::pow(womersley_number / pipe.radius, 2) * pipe.viscosity / pipe.density;
}

class RigidPipeFlow : public testing::TestWithParam<double> {
 protected:
  double w = frequency_of(GetParam());
  Complex gradient{1.3, -0.4};
  Womersley flow = Womersley::from_gradient(pipe, w, gradient);
};

TEST_P(RigidPipeFlow, SatisfiesItsEquation) {
  EXPECT_NEAR(flow.number(), GetParam(), 1e-12 * GetParam());
  EXPECT_EQ(flow.velocity(pipe.radius), Complex(0));
  EXPECT_EQ(flow.slope(0), Complex(0));
  // Differences of order 8 by a fiftieth of the boundary layer are exact to round-off.
  const double step = 0.02 * pipe.radius / std::max(1.0, GetParam());
  for (const double share : {0.1, 0.5, 0.8, 0.9}) {
    const double r = share * pipe.radius;
    const auto velocity = [&](double place) { return flow.velocity(place); };
    const auto slope = [&](double place) { return flow.slope(place); };
    const double largest = std::abs(flow.velocity(0));
    EXPECT_LT(std::abs(finite_difference(velocity, r, step) - flow.slope(r)), 1e-12 * largest / step);
    const Complex viscous = pipe.viscosity * (finite_difference(slope, r, step) + flow.slope(r) / r);
    const Complex inertia = Complex(0, -w * pipe.density) * flow.velocity(r);
    const double size = std::abs(gradient) + std::abs(viscous) + std::abs(inertia);
    EXPECT_LT(std::abs(inertia - gradient - viscous), 1e-11 * size);
  }
}

TEST_P(RigidPipeFlow, FlowAndShearBalance) {
  const Complex sum = integral([&](double r) { return 2 * pi * r * flow.velocity(r); }, 0, pipe.radius);
  // Simpson's error is (alpha/2000)^4 at most.
  EXPECT_LT(std::abs(flow.flow() / sum - 1.0), 1e-9);
  // G pi R^2 - 2 pi R tau = -i w rho Q
  const double r = pipe.radius;
  const Complex force = gradient * pi * r * r - 2 * pi * r * flow.wall_shear();
  EXPECT_LT(std::abs(force - Complex(0, -w * pipe.density) * flow.flow()),
            1e-14 * std::abs(gradient) * r * r);
}

TEST_P(RigidPipeFlow, FollowsFromItsFlow) {
  const Womersley driven = Womersley::from_flow(pipe, w, Complex(0.1, 0.2));
  EXPECT_LT(std::abs(driven.flow() - Complex(0.1, 0.2)), 1e-16);
  const double time = 0.3 / w;
  const Complex factor(std::cos(0.3), -std::sin(0.3));
  EXPECT_NEAR(driven.flow(time), (factor * Complex(0.1, 0.2)).real(), 1e-16);
  EXPECT_NEAR(driven.velocity(0.02, time), (factor * driven.velocity(0.02)).real(), 1e-12);
  EXPECT_NEAR(driven.slope(0.02, time), (factor * driven.slope(0.02)).real(), 1e-9);
  EXPECT_NEAR(driven.gradient(time), (factor * driven.gradient()).real(),
              1e-15 * std::abs(driven.gradient()));
  EXPECT_NEAR(driven.wall_shear(time), (factor * driven.wall_shear()).real(),
              1e-15 * std::abs(driven.wall_shear()));
}

INSTANTIATE_TEST_SUITE_P(WomersleyNumbers, RigidPipeFlow, testing::Values(0.1, 0.5, 1, 2.9, 3.1, 10, 30),
                         [](const auto& instance) {
                           return "Tenths" + std::to_string(std::lround(10 * instance.param));
                         });

TEST(RigidPipeLimits, CentreLineByKelvinFunctions) {
  // v(0) = i G/(w rho) (1 - 1/(ber - i bei)(alpha)), since s R = alpha e^{-i pi/4}
  const auto expect = [](double number, double ber, double bei) {
    const double w = frequency_of(number);
    const Complex exact = Complex(0, 1 / (w * pipe.density)) * (1.0 - 1.0 / Complex(ber, -bei));
    const Complex v = Womersley::from_gradient(pipe, w, 1).velocity(0);
    EXPECT_LT(std::abs(v / exact - 1.0), 1e-14) << number;
  };
  expect(1, 0.98438178121308688397, 0.24956604003665972142);
  expect(5, -6.2300824786663577332, 0.1160343815502003781);
  expect(20, 47489.370265061760145, 114775.19736006622162);
}

TEST(RigidPipeLimits, SlowFlowIsPoiseuilles) {
  const double r = pipe.radius, mu = pipe.viscosity;
  const Womersley steady = Womersley::from_gradient(pipe, 0, 2);
  EXPECT_NEAR(steady.flow().real(), 2 * pi * std::pow(r, 4) / (8 * mu), 1e-20);
  EXPECT_NEAR(steady.velocity(0.02).real(), 2 * (r * r - 4e-4) / (4 * mu), 1e-17);
  EXPECT_NEAR(steady.wall_shear().real(), r, 1e-17);
  // I2(x)/(x^2 I0(x)) = (1 - x^2/6 + 11 x^4/384 ...)/8 with x^2 = -i alpha^2
  for (const double number : {0.03, 0.1, 0.2}) {
    const double square = number * number;
    const Womersley slow = Womersley::from_gradient(pipe, frequency_of(number), 2);
    const Complex ratio = slow.flow() / steady.flow();
    EXPECT_LT(std::abs(ratio - Complex(1 - 11 * square * square / 384, square / 6)),
              0.01 * std::pow(number, 6));
  }
}

TEST(RigidPipeLimits, FastFlowIsAPlugWithAStokesLayer) {
  const double number = 300, w = frequency_of(number);
  const Womersley fast = Womersley::from_gradient(pipe, w, 1);
  const Complex plug(0, 1 / (w * pipe.density)), s(number / pipe.radius * std::polar(1.0, -pi / 4));
  EXPECT_LT(std::abs(fast.velocity(0.5 * pipe.radius) / plug - 1.0), 1e-14);
  // 1 - e^{-s y} with corrections of relative size y/R
  const double y = 0.5 * pipe.radius / number;
  EXPECT_LT(std::abs(fast.velocity(pipe.radius - y) / (plug * (1.0 - std::exp(-s * y))) - 1.0), 1 / number);
}

/// Worst residual, over the wall, of equilibrium relative to stress over thickness, and of gradient and
/// stress against the displacement.
void expect_equilibrium(const LameTube& solution, const LinearTube& tube) {
  const double step = 0.01 * tube.radius;  // (step/r)^8 is round-off
  for (const double share : {0.25, 0.5, 0.75})
    for (const double z : {-0.4, 0.0, 1.7}) {
      const double r = tube.radius + share * tube.thickness;
      SCOPED_TRACE(testing::Message() << "r = " << r << ", z = " << z);
      const auto here = solution.at(r, z);
      const auto stress_along_r = [&](int i, int j) {
        return finite_difference([&](double p) { return solution.at(p, z).stress(i, j); }, r, step);
      };
      const auto stress_along_z = [&](int i, int j) {
        return finite_difference([&](double p) { return solution.at(r, p).stress(i, j); }, z, step);
      };
      double size = 0, strain = 0;
      for (const double entry : here.stress.entries) size = std::max(size, std::abs(entry));
      for (const double entry : here.gradient.entries) strain = std::max(strain, std::abs(entry));
      EXPECT_NEAR(stress_along_r(0, 0) + (here.stress(0, 0) - here.stress(1, 1)) / r + stress_along_z(0, 2),
                  0, 1e-10 * size / tube.thickness);
      EXPECT_NEAR(stress_along_r(2, 0) + here.stress(2, 0) / r + stress_along_z(2, 2), 0,
                  1e-10 * size / tube.thickness);
      for (const int i : {0, 2}) {
        const auto along_r = [&](double p) { return solution.at(p, z).displacement[i]; };
        const auto along_z = [&](double p) { return solution.at(r, p).displacement[i]; };
        EXPECT_NEAR(finite_difference(along_r, r, step), here.gradient(i, 0), 1e-10 * strain);
        EXPECT_NEAR(finite_difference(along_z, z, step), here.gradient(i, 2), 1e-10 * strain);
      }
      EXPECT_NEAR(here.displacement[0] / r, here.gradient(1, 1), 1e-14 * strain);
      // e = ((1 + nu) sigma - nu tr(sigma) I)/E
      const double young = tube.young_modulus, nu = tube.poisson_ratio;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const double law = ((1 + nu) * here.stress(i, j) - (i == j ? nu * trace(here.stress) : 0)) / young;
          EXPECT_NEAR((here.gradient(i, j) + here.gradient(j, i)) / 2, law, 1e-13 * size / young);
        }
    }
}

void expect_surface_tractions(const LameTube& solution, const LinearTube& tube) {
  for (const double z : {-0.4, 0.0, 1.7}) {
    const auto inner = solution.at(tube.radius, z), outer = solution.at(tube.outer_radius(), z);
    const double size = std::abs(solution.pressure(0)) + std::abs(solution.wall_shear());
    EXPECT_NEAR(inner.stress(0, 0), -solution.pressure(z), 1e-12 * size);
    EXPECT_NEAR(inner.stress(2, 0), -solution.wall_shear(), 1e-12 * size);
    EXPECT_NEAR(outer.stress(0, 0), -tube.radial_spring * outer.displacement[0], 1e-12 * size);
    EXPECT_NEAR(outer.stress(2, 0), -tube.axial_spring * outer.displacement[2], 1e-12 * size);
  }
}

TEST(LameTube, PressureAloneIsTheTextbooks) {
  const LinearTube tube{0.033, 0.01, 4e5, 0.45};
  const double p = 1.3e5, inner = tube.radius, outer = tube.outer_radius();
  const LameTube solution(tube, p);
  // u(R_i) = p R_i (1 + nu)/E ((1 - 2 nu) R_i^2 + R_o^2)/(R_o^2 - R_i^2) in plane strain (Timoshenko and
  // Goodier)
  const double u =
      p * inner * 1.45 / 4e5 * (0.1 * inner * inner + outer * outer) / (outer * outer - inner * inner);
  EXPECT_NEAR(solution.at(inner).displacement[0], u, 1e-13 * u);
  EXPECT_EQ(solution.at(inner, 3).displacement[2], 0);
  EXPECT_NEAR(solution.at(outer).stress(1, 1), 2 * p * inner * inner / (outer * outer - inner * inner),
              1e-13 * p);
}

TEST(LameTube, SatisfiesEquilibriumAndSurfaceConditions) {
  const std::array tubes{LinearTube{0.033, 0.01, 4e5, 0.49, 1e7, 1e7},
                         LinearTube{0.033, 0.01, 4e5, 0.3, 0, 1e5}, LinearTube{0.5, 0.1, 3e6, 0.3},
                         LinearTube{0.5, 0.5, 3e6, 0, 1e4, 0}};
  for (const LinearTube& tube : tubes)
    for (const double gradient : {0.0, 5e3, -200.0}) {
      SCOPED_TRACE(testing::Message() << tube.young_modulus << ' ' << tube.poisson_ratio << ' ' << gradient);
      const LameTube solution(tube, 1.3e4, gradient, tube.axial_spring > 0 ? 0 : 0.02);
      expect_equilibrium(solution, tube);
      expect_surface_tractions(solution, tube);
    }
}

TEST(LameTube, TheSpringOrTheWallCarriesTheShear) {
  const double gradient = 5e3, pressure = 1e4;
  const auto axial_force = [](const LameTube& solution, const LinearTube& tube, double z) {
    return integral([&](double r) { return 2 * pi * r * solution.at(r, z).stress(2, 2); }, tube.radius,
                    tube.outer_radius());
  };
  for (const double spring : {0.0, 1e6}) {
    const LinearTube tube{0.5, 0.1, 3e6, 0.3, spring, spring};
    const LameTube solution(tube, pressure, gradient);
    // dN/dz + 2 pi R_i tau - 2 pi R_o K u_z(R_o) = 0
    const double outer = tube.outer_radius(), shear = 2 * pi * tube.radius * solution.wall_shear();
    const double held = 2 * pi * outer * spring * solution.at(outer).displacement[2];
    EXPECT_NEAR(axial_force(solution, tube, 1) - axial_force(solution, tube, 0) + shear - held, 0,
                1e-9 * shear);
  }
  EXPECT_THROW(LameTube(LinearTube{0.5, 0.1, 3e6, 0.3, 1e6, 1e6}, 1, 0, 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace tunica::test_support
