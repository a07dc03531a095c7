// SPDX-License-Identifier: GPL-3.0-or-later
// The stress of every law against the derivative of its energy, by three ways that share no code: duals
// through the law's energy, the closed form derived by hand, and differences of the printed energy.
#include <gtest/gtest.h>

#include "tests/support/law_cases.hpp"

namespace tunica::test_support {
namespace {

class WallEnergy : public testing::TestWithParam<LawCase> {};

Tensor<Dual<double, 9>> seeded(const Tensor<double>& gradient) {
  Tensor<Dual<double, 9>> t;
  for (int k = 0; k < 9; ++k) t.entries[k] = Dual<double, 9>::variable(gradient.entries[k], k);
  return t;
}

Tensor<double> derivative(const Dual<double, 9>& energy) {
  Tensor<double> t;
  t.entries = energy.derivative;
  return t;
}

/// dW/dH by duals with each family's part multiplied by its recruited share.
Tensor<double> stress_from_energy(const wall::Law<double>& law, const Tensor<double>& gradient,
                                  const wall::MaterialAxes& axes) {
  const auto H = seeded(gradient);
  Tensor<double> stress =
      std::visit([&](const auto& l) { return derivative(l.energy(H, axes)); }, without_fibers(law));
  const Kinematics<Dual<double, 9>> k(H);
  for (const auto& family : wall::families(law)) {
    const auto excess = family.excess(k, axes);
    stress = stress + family.recruitment.share(excess.value) * derivative(family.energy(excess));
  }
  return stress;
}

double energy(const wall::Law<double>& law, const Tensor<double>& gradient, const wall::MaterialAxes& axes) {
  return std::visit([&](const auto& l) { return l.energy(gradient, axes); }, law);
}

// Rounding: some hundred operations on numbers as large as the tangent's entries.
constexpr double rounding = 2e-14;

TEST_P(WallEnergy, StressIsTheDualDerivativeOfTheEnergyTimesTheRecruitedShare) {
  const wall::Law<double>& law = GetParam().law;
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 40; ++sample) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes);
    expect_near(wall::piola(law, H, axes), stress_from_energy(law, H, axes),
                rounding * stress_scale(law, H, axes));
  }
}

TEST_P(WallEnergy, StressIsTheClosedForm) {
  const auto& [name, entry, exponent, law, reference] = GetParam();
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  int recruited = 0;
  for (int sample = 0; sample < 40; ++sample) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes);
    expect_near(wall::piola(law, H, axes), rounded(reference.piola(deformation_gradient(H), axes)),
                rounding * stress_scale(law, H, axes));
    recruited += fully_recruited(GetParam(), H, axes);
  }
  // The samples say something about fibres only when they carry load in some.
  EXPECT_GE(recruited, 3);
}

TEST_P(WallEnergy, ClosedFormIsTheDifferenceQuotientOfThePrintedEnergy) {
  const auto& law = GetParam().law;
  const ReferenceLaw& reference = GetParam().reference;
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 10; ++sample) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes);
    const Matrix3 F = deformation_gradient(H);
    // Truncation of 1e-12 times the energy's third derivative, which is at most 1e3 tangents here.
    const double tolerance = 1e-9 * stress_scale(law, H, axes);
    expect_near(rounded(reference.matrix_piola(F)),
                rounded(by_differences([&](const Matrix3& G) { return reference.matrix_energy(G); }, F)),
                tolerance);
    for (std::size_t k = 0; k < reference.families.size(); ++k)
      expect_near(
          rounded(reference.fiber_piola(k, F, axes)),
          rounded(by_differences([&](const Matrix3& G) { return reference.fiber_energy(k, G, axes); }, F)),
          tolerance);
  }
}

TEST_P(WallEnergy, EnergyIsThePrintedOneWithFibresAsIfRecruited) {
  const auto& [name, entry, exponent, law, reference] = GetParam();
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 40; ++sample) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes);
    const Matrix3 F = deformation_gradient(H);
    Real expected = reference.matrix_energy(F);
    for (std::size_t k = 0; k < reference.families.size(); ++k)
      expected += reference.fiber_energy(k, F, axes);
    EXPECT_NEAR(energy(law, H, axes), static_cast<double>(expected), rounding * stress_scale(law, H, axes));
  }
}

TEST_P(WallEnergy, NothingIsStoredAtRestBesideWhatRecruitmentWillTake) {
  const auto& [name, entry, exponent, law, reference] = GetParam();
  RandomDeformation random;
  const auto axes = random.axes();
  const Tensor<double> rest{};
  EXPECT_EQ(energy(without_fibers(law), rest, axes), 0.0);
  const Matrix3 identity = deformation_gradient(rest);
  double unrecruited = 0;
  for (std::size_t k = 0; k < reference.families.size(); ++k)
    unrecruited += static_cast<double>(reference.fiber_energy(k, identity, axes));
  EXPECT_NEAR(energy(law, rest, axes), unrecruited, 1e-15 * stress_scale(law, rest, axes));
  if (!entry->has_activation) {
    EXPECT_NEAR(unrecruited, 0.0, 1e-9);
  }
}

TEST_P(WallEnergy, NoStressAtRest) {
  const auto& [name, entry, exponent, law, reference] = GetParam();
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  const auto axes = random.axes();
  const Tensor<double> rest{};
  const Matrix3 identity = deformation_gradient(rest);
  for (const double entry_of_stress : wall::piola(without_fibers(law), rest, axes).entries)
    EXPECT_EQ(entry_of_stress, 0.0);
  if (!entry->has_fibers) return;

  if (entry->has_activation) {
    // Sharp recruitment leaves nothing; smooth the tail of the arctangent, at most 1/(pi epsilon |x|).
    for (const double entry_of_stress :
         wall::piola(with_recruitment(GetParam(), "sharp").law, rest, axes).entries)
      EXPECT_EQ(entry_of_stress, 0.0);
    double bound = 0;
    for (std::size_t k = 0; k < reference.families.size(); ++k) {
      const auto x = static_cast<double>(std::abs(reference.excess(k, identity, axes)));
      bound += largest(rounded(reference.fiber_piola(k, identity, axes))) / (std::numbers::pi * 5e5 * x);
    }
    EXPECT_LE(largest(wall::piola(law, rest, axes)), bound * (1 + 1e-9));
    EXPECT_LE(bound, 1.0);  // dyn/cm2, of laws whose stiffness is 1e4 and more
  } else if (exponent == 2) {
    EXPECT_LE(largest(wall::piola(law, rest, axes)), 1e-15 * stress_scale(law, rest, axes));
  } else {
    // As printed (exponent 1), fibres that are recruited at rest pull at rest, each with half of
    // 2 W'(0) = alpha: the unloaded artery is not free of stress.
    Tensor<double> expected;
    for (const auto& family : wall::families(law)) {
      const auto a0 = family.direction(axes);
      expected = expected + 0.5 * family.stiffness * deviator(outer(a0, a0));
    }
    // x = 0 to some 1e-16, which the sharpness 5e5 makes 1e-10 of the share.
    expect_near(wall::piola(law, rest, axes), expected, 1e-9 * largest(expected));
    EXPECT_GT(largest(expected), 1e4);
  }
}

INSTANTIATE_TEST_SUITE_P(Catalog, WallEnergy, testing::ValuesIn(law_cases()), case_name);

}  // namespace
}  // namespace tunica::test_support
