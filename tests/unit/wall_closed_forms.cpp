// SPDX-License-Identifier: GPL-3.0-or-later
// Textbook deformations, with the stresses worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "core/frame.hpp"
#include "tests/support/law_cases.hpp"

namespace tunica::test_support {
namespace {

const auto axes = frame::Radial::axes();
using Diagonal = Tensor<double>;

Tensor<double> diagonal_gradient(double a, double b, double c) {
  return Tensor<double>::diagonal(a - 1, b - 1, c - 1);
}

/// F = I + k e1 x e2
Tensor<double> shear(double k) {
  Tensor<double> H;
  H(0, 1) = k;
  return H;
}

/// 2 W'(I1bar) of the isotropic split laws, x = I1bar - 3, with Table 1's parameters.
struct Isotropic {
  const char* name;
  double (*twice_slope)(double);
};
const Isotropic isotropic[] = {
    // W = alpha/2gamma (e^(gamma x) - 1)
    {"EXP1", [](double x) { return 7.6350e4 * std::exp(0.7410 * x); }},
    // W = alpha/2gamma (e^(gamma x^2) - 1)
    {"EXP2", [](double x) { return 2 * 6.8220e4 * x * std::exp(0.0609 * x * x); }},
    // W = mu/2 x
    {"neo-Hookean", [](double) { return 7.6350e4; }}};

// J = 1 by construction, to within rounding that the bulk modulus makes 1e-9 dyn/cm2: differences of the
// principal Kirchhoff stresses are then 2 W1 (l_i^2 - l_j^2).
constexpr double tolerance = 1e-12;

TEST(WallClosedForms, UniaxialStretchAtConstantVolume) {
  for (const auto& [name, twice_slope] : isotropic)
    for (const double l : {0.7, 0.95, 1.1, 1.9}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(l));
      const auto H = diagonal_gradient(l, 1 / std::sqrt(l), 1 / std::sqrt(l));
      const auto tau = wall::piola(law_case(name).law, H, axes) * (Tensor<double>::identity() + H);
      // I1 = l^2 + 2/l
      const double expected = twice_slope(l * l + 2 / l - 3) * (l * l - 1 / l);
      EXPECT_NEAR(tau(0, 0) - tau(1, 1), expected, tolerance * (std::abs(expected) + 1e5));
      EXPECT_NEAR(tau(2, 2), tau(1, 1), tolerance * (std::abs(expected) + 1e5));
      // tau has no trace at J = 1, so that all of the deviator is 2/3, -1/3, -1/3.
      EXPECT_NEAR(tau(0, 0), 2.0 / 3 * expected, 1e-9 * 1e5);
    }
}

TEST(WallClosedForms, EquibiaxialStretchAtConstantVolume) {
  for (const auto& [name, twice_slope] : isotropic)
    for (const double l : {0.8, 1.05, 1.4}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(l));
      const auto H = diagonal_gradient(l, l, 1 / (l * l));
      const auto tau = wall::piola(law_case(name).law, H, axes) * (Tensor<double>::identity() + H);
      // I1 = 2 l^2 + l^-4
      const double expected = twice_slope(2 * l * l + std::pow(l, -4) - 3) * (l * l - std::pow(l, -4));
      EXPECT_NEAR(tau(0, 0) - tau(2, 2), expected, tolerance * (std::abs(expected) + 1e5));
      EXPECT_NEAR(tau(0, 0), tau(1, 1), tolerance * (std::abs(expected) + 1e5));
    }
}

TEST(WallClosedForms, SimpleShear) {
  for (const auto& [name, twice_slope] : isotropic)
    for (const double k : {-0.5, 0.1, 1.2}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(k));
      const auto H = shear(k);
      const auto tau = wall::piola(law_case(name).law, H, axes) * transpose(Tensor<double>::identity() + H);
      // b = I + k (e1 x e2 + e2 x e1) + k^2 e1 x e1, I1 - 3 = k^2, J = 1.
      const double mu = twice_slope(k * k), scale = tolerance * (mu + 1e5);
      EXPECT_NEAR(tau(0, 1), mu * k, scale);
      EXPECT_NEAR(tau(1, 0), mu * k, scale);
      EXPECT_NEAR(tau(0, 0), mu * k * k * 2 / 3, scale);
      EXPECT_NEAR(tau(1, 1), -mu * k * k / 3, scale);
      EXPECT_NEAR(tau(2, 2), -mu * k * k / 3, scale);
    }
}

// St. Venant-Kirchhoff, P = F S with S = lambda tr E I + 2 mu E.
TEST(WallClosedForms, StVenantKirchhoff) {
  constexpr double E = 3e6, nu = 0.3, mu = E / 2.6, lambda = E * nu / (1.3 * 0.4);
  const auto law = law_case("St-Venant-Kirchhoff").law;
  constexpr double rounding = 1e-14 * E;
  for (const double l : {0.8, 1.3}) {
    // Uniaxial stress: S = E E11 along, and the sides' strain is -nu of E11.
    const double strain = (l * l - 1) / 2, side = std::sqrt(1 - 2 * nu * strain);
    const auto tension = wall::piola(law, diagonal_gradient(l, side, side), axes);
    expect_near(tension, Diagonal::diagonal(l * E * strain, 0, 0), rounding);
    // Uniaxial strain.
    expect_near(wall::piola(law, diagonal_gradient(1, l, 1), axes),
                Diagonal::diagonal(lambda * strain, l * (lambda + 2 * mu) * strain, lambda * strain),
                rounding);
    // Equibiaxial: E = diag(e, e, 0).
    expect_near(wall::piola(law, diagonal_gradient(l, l, 1), axes),
                Diagonal::diagonal(l * (2 * lambda + 2 * mu) * strain, l * (2 * lambda + 2 * mu) * strain,
                                   2 * lambda * strain),
                rounding);
  }
  // Simple shear: E12 = k/2, E22 = k^2/2.
  const double k = 0.4, k2 = k * k;
  Tensor<double> expected;
  expected.entries = {lambda * k2 / 2 + mu * k2,
                      mu * k + k * (lambda / 2 + mu) * k2,
                      0,  //
                      mu * k,
                      (lambda / 2 + mu) * k2,
                      0,  //
                      0,
                      0,
                      lambda * k2 / 2};
  expect_near(wall::piola(law, shear(k), axes), expected, rounding);
}

// P = mu (F - F^-T) + lambda ln J F^-T.
TEST(WallClosedForms, CompressibleNeoHookean) {
  constexpr double mu = 7.6350e4, kappa = 9e6, lambda = kappa - 2 * mu / 3;
  const auto law = law_case("neo-Hookean-compressible").law;
  const double a = 1.2, b = 0.9, c = 1.05, log_j = std::log(a * b * c);
  expect_near(wall::piola(law, diagonal_gradient(a, b, c), axes),
              Diagonal::diagonal(mu * (a - 1 / a) + lambda * log_j / a, mu * (b - 1 / b) + lambda * log_j / b,
                                 mu * (c - 1 / c) + lambda * log_j / c),
              1e-14 * kappa);
  // Simple shear: F^-T = I - k e2 x e1, so that P = mu k (e1 x e2 + e2 x e1).
  Tensor<double> expected;
  expected(0, 1) = expected(1, 0) = mu * 0.7;
  expect_near(wall::piola(law, shear(0.7), axes), expected, 1e-14 * kappa);
}

TEST(WallClosedForms, LinearElasticTensionContractsByPoissonsRatio) {
  constexpr double E = 3e6, nu = 0.3, e = 0.01;
  expect_near(wall::piola(law_case("linear-elastic").law, Diagonal::diagonal(e, -nu * e, -nu * e), axes),
              Diagonal::diagonal(E * e, 0, 0), 1e-15 * E);
  expect_near(wall::piola(law_case("linear-elastic").law, shear(0.2), axes),
              E / 2.6 * 0.2 * (outer<double>({1, 0, 0}, {0, 1, 0}) + outer<double>({0, 1, 0}, {1, 0, 0})),
              1e-15 * E);
}

// F = l I: pressure alone, whatever the isotropic term; fibres keep I4bar = 1.
TEST(WallClosedForms, EqualStretchesMakeAPressureWithoutDeviator) {
  for (const char* name : {"EXP1", "EXP2", "neo-Hookean", "EXP1+EXP2-ZS"})
    for (const double l : {0.95, 1.02}) {
      const double J = l * l * l, pressure = 9e6 / 2 * (J * (J - 1) + std::log(J));
      const auto P = wall::piola(law_case(name).law, diagonal_gradient(l, l, l), axes);
      expect_near(P, Diagonal::diagonal(pressure / l, pressure / l, pressure / l), 1e-14 * 9e6);
    }
}

// A ring in plane strain is three-dimensional: the isochoric factor is J^(-2/3), not J^(-2/dim) of a mesh.
TEST(WallClosedForms, TheRingsIsochoricFactorIsThatOfThreeDimensions) {
  constexpr double mu = 7.6350e4;
  const double radius = 0.04, displacement = 0.01, slope = -0.1;
  const auto H = frame::Radial::gradient(displacement, slope, radius);
  expect_near(H, Diagonal::diagonal(-0.1, 0.25, 0), 1e-16);
  const double lr = 0.9, lt = 1.25, J = lr * lt;
  ASSERT_GT(std::abs(J - 1), 0.1);  // or J^(-2/3) could not be told from J^-1
  const auto tau = wall::isochoric_kirchhoff(law_case("neo-Hookean").law, H, axes);
  const double factor = std::pow(J, -2.0 / 3), mean = (lr * lr + lt * lt + 1) / 3;
  expect_near(tau,
              Diagonal::diagonal(mu * factor * (lr * lr - mean), mu * factor * (lt * lt - mean),
                                 mu * factor * (1 - mean)),
              1e-14 * mu);
  // Equal stretches of the section alone are no hydrostatic state in three dimensions.
  const auto section =
      wall::isochoric_kirchhoff(law_case("neo-Hookean").law, frame::Radial::gradient(0.004, 0.1, 0.04), axes);
  EXPECT_NEAR(section(2, 2), mu * std::pow(1.21, -2.0 / 3) * (1 - 1.21) * 2 / 3, 1e-14 * mu);
}

TEST(RadialFrame, DerivativesOfTheGradientAreThoseOfTheTestFunction) {
  // contract_with_test(P, v, v') = P : grad(v e_R)
  Tensor<double> P;
  P.entries = {2, 7, 7, 7, 3, 7, 7, 7, 7};
  const double v = 0.3, slope = -0.8, radius = 0.05;
  EXPECT_DOUBLE_EQ(frame::Radial::contract_with_test(P, v, slope, radius),
                   contract(P, frame::Radial::gradient(v, slope, radius)));
  EXPECT_EQ(frame::Radial::measure(radius), radius);
  EXPECT_EQ(cross(axes.circumferential, axes.axial), (Vector<double>{1, 0, 0}));
}

TEST(Cauchy, IsTheKirchhoffStressPerCurrentVolume) {
  // Uniaxial tension of a bar of unit section to F = diag(2, 0.8, 0.8): a force of P11 on 0.64.
  const auto sigma = cauchy_stress(Diagonal::diagonal(5.0, 0, 0), diagonal_gradient(2, 0.8, 0.8));
  expect_near(sigma, Diagonal::diagonal(5.0 / 0.64, 0, 0), 1e-14);
}

TEST(VonMises, OfKnownStates) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 10; ++sample) {
    const auto q = random.rotation();
    const double s = random.uniform(-1e6, 1e6), t = random.uniform(-1e6, 1e6), p = random.uniform(-1e6, 1e6);
    const auto turned = [&](const Tensor<double>& stress) { return q * stress * transpose(q); };
    const double rounding = 1e-14 * 1e6;
    EXPECT_NEAR(von_mises_stress(turned(Diagonal::diagonal(s, 0, 0))), std::abs(s), rounding);
    EXPECT_NEAR(von_mises_stress(turned(Diagonal::diagonal(p, p, p))), 0.0, rounding);
    Tensor<double> pure_shear;
    pure_shear(0, 1) = pure_shear(1, 0) = t;
    EXPECT_NEAR(von_mises_stress(turned(pure_shear)), std::sqrt(3.0) * std::abs(t), rounding);
    // A pressure does not change it; the principal form sqrt(((s1-s2)^2 + (s2-s3)^2 + (s3-s1)^2)/2).
    EXPECT_NEAR(von_mises_stress(turned(Diagonal::diagonal(s + p, t + p, p))),
                std::sqrt(((s - t) * (s - t) + t * t + s * s) / 2), rounding);
  }
}

}  // namespace
}  // namespace tunica::test_support
