// SPDX-License-Identifier: GPL-3.0-or-later
// Strains of 1e-12: nothing may be lost by subtracting 1 from 1, and every law is linear elasticity.
#include <gtest/gtest.h>

#include "tests/support/law_cases.hpp"

namespace tunica::test_support {
namespace {

class WallSmallStrain : public testing::TestWithParam<LawCase> {};

Tensor<double> strain_of(const Tensor<double>& H) {
  return 0.5 * (H + transpose(H));
}

/// Hooke's law of the unloaded tissue, from its parameters alone.
Tensor<double> linear_stress(const LawCase& law, const Tensor<double>& H, const wall::MaterialAxes& axes) {
  const ReferenceLaw& r = law.reference;
  double kappa = static_cast<double>(r.bulk_modulus), mu = 0;
  switch (r.matrix) {
    case wall::Matrix::exp1:
      mu = static_cast<double>(r.stiffness);  // 2 W1 = alpha
      break;
    case wall::Matrix::exp2:
      mu = 0;  // W1 = 0: no shear stiffness at rest
      break;
    case wall::Matrix::neo_hookean:
      mu = static_cast<double>(r.shear_modulus);
      break;
    default:
      mu = static_cast<double>(r.mu);
      kappa = static_cast<double>(r.lambda + 2 * r.mu / 3);
  }
  const auto e = strain_of(H), dev = deviator(e);
  Tensor<double> stress = 2 * mu * dev + kappa * trace(e) * Tensor<double>::identity();
  for (const auto& family : wall::families(law.law)) {
    // 2 W4 = 2 alpha x with x = 2 a0 . dev e a0; recruited where it is stretched.
    const auto a0 = family.direction(axes);
    const double x = 2 * dot(a0, dev * a0);
    if (!law.entry->has_activation && x > 0)
      stress = stress + 2 * family.stiffness * x * deviator(outer(a0, a0));
  }
  return stress;
}

TEST_P(WallSmallStrain, StressIsThatOfLinearElasticityWithTheLawsModuli) {
  // Smooth recruitment leaves the arctangent's tail at rest, far above stresses of 1e-7 dyn/cm2.
  const LawCase law = GetParam().entry->has_fibers ? with_recruitment(GetParam(), "sharp") : GetParam();
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 30; ++sample) {
    const auto H = random.tensor(1e-12);
    const auto axes = random.axes();
    const auto expected = linear_stress(law, H, axes);
    const auto actual = wall::piola(law.law, H, axes);
    // Of the next order in strain there are some ten terms, each at most 1e-24 tangents: 1e-9 of the
    // deviator. Deriving by duals from an energy of ln J leaves the difference of mu I and mu F^-T, each
    // rounded to 1e-16.
    double rounding = 2e-23 * stress_scale(law.law, H, axes);
    if (law.reference.matrix == wall::Matrix::neo_hookean_compressible)
      rounding += 5e-16 * static_cast<double>(law.reference.mu);
    EXPECT_NEAR(trace(actual), trace(expected), 3 * rounding);
    expect_near(deviator(actual), deviator(expected), rounding);
  }
}

// ZS with the smooth share: within 1e-12 of the threshold half of the fibres are recruited.
TEST(WallSmallStrain, HalfOfTheFibresCarryAtTheThresholdOfSmoothRecruitment) {
  const LawCase law = law_case("EXP1+EXP2-ZS");
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 20; ++sample) {
    const auto H = random.tensor(1e-12);
    const auto axes = random.axes();
    const auto dev = deviator(strain_of(H));
    Tensor<double> expected = (2 * 1.7471e4) * dev;
    for (const auto& family : wall::families(law.law)) {
      const auto a0 = family.direction(axes);
      expected = expected + (2 * 1.4979e5 * dot(a0, dev * a0)) * deviator(outer(a0, a0));
    }
    // The share is 1/2 +- 5e5 x/pi, with x at most 1e-11.
    expect_near(deviator(wall::piola(law.law, H, axes)), expected, 2e-6 * largest(expected));
  }
}

// U(J) = kappa/4 [(J-1)^2 + ln^2 J]: J U' = kappa (e + e^2/4 + O(e^3)) with e = J - 1.
TEST(WallVolumetric, PressureIsAccurateFromTinyToLargeVolumeChange) {
  const wall::Volumetric<double> volumetric{9e6};
  for (const double stretch_change : {1e-15, 1e-12, -1e-12, 3e-9, -1e-6}) {
    const auto H = Tensor<double>::diagonal(stretch_change, stretch_change, stretch_change);
    const Real e = 3 * Real(stretch_change) + 3 * Real(stretch_change) * stretch_change +
                   Real(stretch_change) * stretch_change * stretch_change;
    // The series to the third order: J (J-1) + ln J = 2 e + e^2/2 + e^3/3 + O(e^4).
    const auto expected = static_cast<double>(Real(9e6) / 2 * e * (2 + e / 2 + e * e / 3));
    EXPECT_NEAR(volumetric.kirchhoff(Kinematics<double>(H)), expected, 1e-15 * std::abs(expected));
    const auto stored = static_cast<double>(Real(9e6) / 4 * e * e * (2 - e + 11 * e * e / 12));
    EXPECT_NEAR(volumetric.energy(Kinematics<double>(H)), stored, 2e-15 * stored);
  }
  for (const double J : {0.5, 0.9, 1.3, 2.0}) {
    const auto H = Tensor<double>::diagonal(J - 1, 0.0, 0.0);
    const double expected = 9e6 / 2 * (J * (J - 1) + std::log(J));
    EXPECT_NEAR(volumetric.kirchhoff(Kinematics<double>(H)), expected, 1e-15 * 9e6);
  }
}

/// Fibres of exponent 1 that are recruited at rest are stressed at rest: no linear elasticity there.
std::vector<LawCase> cases_free_of_stress_at_rest() {
  std::vector<LawCase> cases = law_cases();
  std::erase_if(cases, [](const LawCase& law) { return law.exponent == 1 && !law.entry->has_activation; });
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Catalog, WallSmallStrain, testing::ValuesIn(cases_free_of_stress_at_rest()),
                         case_name);

}  // namespace
}  // namespace tunica::test_support
