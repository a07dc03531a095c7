// SPDX-License-Identifier: GPL-3.0-or-later
// What no choice of axes may change: the observer's (objectivity) and, of the material, its symmetry.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/law_cases.hpp"

namespace tunica::test_support {
namespace {

class WallInvariance : public testing::TestWithParam<LawCase> {};
class IsotropicSymmetry : public testing::TestWithParam<LawCase> {};
class FiberSymmetry : public testing::TestWithParam<LawCase> {};

const auto identity = Tensor<double>::identity();

double energy(const wall::Law<double>& law, const Tensor<double>& gradient, const wall::MaterialAxes& axes) {
  return std::visit([&](const auto& l) { return l.energy(gradient, axes); }, law);
}

bool is_linear(const LawCase& law) {
  return law.entry->matrix == wall::Matrix::linear_elastic;
}

/// Rounding F by 1e-16 moves the stress by as much of the largest tangent; a product with Q does it some ten
/// times over.
constexpr double rounding = 3e-14;

Vector<double> radial(const wall::MaterialAxes& axes) {
  return cross(axes.circumferential, axes.axial);
}

/// 2 n x n - I
Tensor<double> half_turn(const Vector<double>& about) {
  return 2.0 * outer(about, about) - identity;
}

/// Rotation by an angle (Rodrigues).
Tensor<double> turn(const Vector<double>& n, double angle) {
  Tensor<double> skew;
  skew.entries = {0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0};
  return identity + std::sin(angle) * skew + (1 - std::cos(angle)) * (skew * skew);
}

/// I - 2 n x n
Tensor<double> mirror(const Vector<double>& normal) {
  return identity - 2.0 * outer(normal, normal);
}

/// Largest entry of P(F Q) - P(F) Q.
double asymmetry(const wall::Law<double>& law, const Tensor<double>& H, const Tensor<double>& q,
                 const wall::MaterialAxes& axes) {
  return largest(wall::piola(law, (identity + H) * q - identity, axes) - wall::piola(law, H, axes) * q);
}

TEST_P(WallInvariance, ARotationAfterwardsTurnsTheStressAndKeepsTheEnergy) {
  const wall::Law<double>& law = GetParam().law;
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 30; ++sample) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes), q = random.rotation();
    const auto turned = q * (identity + H) - identity;
    if (is_linear(GetParam())) {
      // Small strains take a rotation for a strain: they cannot be objective.
      EXPECT_GT(largest(wall::piola(law, q - identity, axes)), 1e-3 * stress_scale(law, H, axes));
      EXPECT_GT(largest(wall::piola(law, turned, axes) - q * wall::piola(law, H, axes)),
                1e-3 * stress_scale(law, H, axes));
      continue;
    }
    const double tolerance = rounding * stress_scale(law, H, axes);
    expect_near(wall::piola(law, turned, axes), q * wall::piola(law, H, axes), tolerance);
    EXPECT_NEAR(energy(law, turned, axes), energy(law, H, axes), tolerance);
  }
}

TEST_P(IsotropicSymmetry, AnIsotropicLawDoesNotFeelARotationBefore) {
  const wall::Law<double>& law = GetParam().law;
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 30; ++sample) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes), q = random.rotation();
    const double tolerance = rounding * stress_scale(law, H, axes);
    if (!is_linear(GetParam())) {
      EXPECT_LE(asymmetry(law, H, q, axes), tolerance);
    }
    // In this form, Q H Q^T, small strains are isotropic as well.
    expect_near(wall::piola(law, q * H * transpose(q), axes), q * wall::piola(law, H, axes) * transpose(q),
                tolerance);
  }
}

TEST_P(FiberSymmetry, TwoEqualFamiliesAreOrthotropic) {
  const wall::Law<double>& law = GetParam().law;
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 30; ++sample) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes);
    // Rounding is amplified by the sharpness 5e5 at the threshold; that is another test's matter.
    if (distance_to_recruitment(GetParam(), H, axes) < 0.01) continue;
    const double tolerance = rounding * stress_scale(law, H, axes);
    for (const auto& axis : {radial(axes), axes.circumferential, axes.axial}) {
      EXPECT_LE(asymmetry(law, H, half_turn(axis), axes), tolerance);
      const auto m = mirror(axis);
      expect_near(wall::piola(law, m * H * m, axes), m * wall::piola(law, H, axes) * m, tolerance);
    }
    if (!fully_recruited(GetParam(), H, axes)) continue;
    // And no more than orthotropic: any other turn shows, seven decades above rounding at the least.
    for (const auto& axis : {radial(axes), axes.circumferential, axes.axial})
      for (const double angle : {0.5, std::numbers::pi / 2})
        EXPECT_GT(asymmetry(law, H, turn(axis, angle), axes), 1e-6 * stress_scale(law, H, axes));
  }
}

TEST_P(FiberSymmetry, HandedFamiliesAreMirroredIntoEachOther) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  const auto handed = [&](double first, double second) {
    return std::visit(
        [&](auto l) -> wall::Law<double> {
          if constexpr (wall::HasFamilies<decltype(l)>) {
            l.families[0].weight = first;
            l.families[1].weight = second;
          }
          return l;
        },
        GetParam().law);
  };
  const auto right = handed(1.0, 0.2), left = handed(0.2, 1.0);
  int recruited = 0;
  for (int sample = 0; sample < 60; ++sample) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes);
    if (!fully_recruited(GetParam(), H, axes) || distance_to_recruitment(GetParam(), H, axes) < 0.01)
      continue;
    ++recruited;
    const double scale = stress_scale(right, H, axes);
    const auto m = mirror(axes.circumferential);
    expect_near(wall::piola(left, m * H * m, axes), m * wall::piola(right, H, axes) * m, rounding * scale);
    EXPECT_GT(largest(wall::piola(right, m * H * m, axes) - m * wall::piola(right, H, axes) * m),
              1e-6 * scale);
  }
  EXPECT_GE(recruited, 3);
}

TEST_P(WallInvariance, TheKirchhoffStressIsSymmetric) {
  const wall::Law<double>& law = GetParam().law;
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 30; ++sample) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes);
    const auto P = wall::piola(law, H, axes);
    // Of small strains, whose stress is meant without the difference of F and I, it is P itself.
    const auto kirchhoff = is_linear(GetParam()) ? P : P * transpose(identity + H);
    expect_near(kirchhoff, transpose(kirchhoff), rounding * stress_scale(law, H, axes));
  }
}

TEST_P(WallInvariance, TheIsochoricStressHasNoTraceAndIsTheRestOfTheWhole) {
  const auto& [name, entry, exponent, law, reference] = GetParam();
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  const auto axes = random.axes();
  const auto H = random.displacement_gradient(axes);
  if (!entry->splits_volume) {
    EXPECT_THROW(wall::isochoric_kirchhoff(law, H, axes), std::logic_error);
    return;
  }
  const auto isochoric = wall::isochoric_kirchhoff(law, H, axes);
  const double scale = stress_scale(law, H, axes);
  EXPECT_NEAR(trace(isochoric), 0.0, rounding * scale);
  expect_near(isochoric, deviator(wall::piola(law, H, axes) * transpose(identity + H)), rounding * scale);
}

INSTANTIATE_TEST_SUITE_P(Catalog, WallInvariance, testing::ValuesIn(law_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Catalog, IsotropicSymmetry, testing::ValuesIn(isotropic_law_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Catalog, FiberSymmetry, testing::ValuesIn(fiber_law_cases()), case_name);

}  // namespace
}  // namespace tunica::test_support
