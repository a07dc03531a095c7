// SPDX-License-Identifier: GPL-3.0-or-later
// The tangent of every law against differences of its stress, by the order of what a linear step leaves.
#include <gtest/gtest.h>

#include "tests/support/law_cases.hpp"

namespace tunica::test_support {
namespace {

class WallTangent : public testing::TestWithParam<LawCase> {};
class WallTangentAcrossRecruitment : public testing::TestWithParam<LawCase> {};

/// Frobenius norm of P(H + t D) - P(H) - t A : D.
double remainder(const LawCase& law, const Tensor<double>& H, const Tensor<double>& direction, double t,
                 const wall::MaterialAxes& axes) {
  const auto [stress, tangent] = wall::stress_and_tangent(law.law, H, axes);
  Tensor<double> left = wall::piola(law.law, H + t * direction, axes) - stress;
  for (int k = 0; k < 9; ++k)
    for (int l = 0; l < 9; ++l) left.entries[k] -= t * tangent[k][l] * direction.entries[l];
  return std::sqrt(contract(left, left));
}

/// The remainder is C t^2 + D t^3 + ..., so that halving t shows the order 2 + O(t D/C): within 0.1 once the
/// steps are small to the distance over which the second derivative changes, which `step` has to be.
void expect_second_order(const LawCase& law, const Tensor<double>& H, const wall::MaterialAxes& axes,
                         const Tensor<double>& direction, double step) {
  constexpr int halvings = 4;
  double before = remainder(law, H, direction, step, axes);
  for (int k = 0; k < halvings; ++k) {
    step /= 2;
    const double after = remainder(law, H, direction, step, axes);
    EXPECT_NEAR(std::log2(before / after), 2.0, 0.1) << "step " << step << ", remainder " << after;
    before = after;
  }
}

TEST_P(WallTangent, WhatALinearStepLeavesFallsWithTheSquareOfTheStep) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  int samples = 0, recruited = 0;
  while (samples < 40) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes);
    const auto direction = random.tensor(1.0);
    // Closer to recruitment than 0.1 the share bends within the steps taken here.
    if (distance_to_recruitment(GetParam(), H, axes) < 0.1) continue;
    ++samples;
    recruited += fully_recruited(GetParam(), H, axes);
    if (GetParam().entry->matrix == wall::Matrix::linear_elastic) {
      EXPECT_LE(remainder(GetParam(), H, direction, 1.0, axes),
                1e-13 * stress_scale(GetParam().law, H, axes));
      continue;
    }
    expect_second_order(GetParam(), H, axes, direction, 1e-3);
  }
  EXPECT_GE(recruited, 2);
}

TEST_P(WallTangent, IsTheDerivativeOfTheReferenceStress) {
  const auto& law = GetParam().law;
  const ReferenceLaw& reference = GetParam().reference;
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 20;) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes);
    if (distance_to_recruitment(GetParam(), H, axes) < 0.01) continue;
    ++sample;
    const auto [stress, tangent] = wall::stress_and_tangent(law, H, axes);
    expect_near(stress, wall::piola(law, H, axes), 1e-14 * stress_scale(law, H, axes));
    // Central differences in extended precision: truncation 1e-12 times the third derivative of the stress,
    // which recruitment at a distance of 0.01 makes some thousand tangents.
    for (int k = 0; k < 9; ++k) {
      const auto component = [&](const Matrix3& F) { return reference.piola(F, axes)[k / 3][k % 3]; };
      Tensor<double> row;
      row.entries = tangent[k];
      expect_near(row, rounded(by_differences(component, deformation_gradient(H))),
                  1e-8 * stress_scale(law, H, axes));
    }
  }
}

TEST_P(WallTangent, HasTheMajorSymmetryOfAnEnergyWhereNoFibreIsBeingRecruited) {
  const wall::Law<double> law =
      GetParam().entry->has_fibers ? with_recruitment(GetParam(), "sharp").law : GetParam().law;
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 20; ++sample) {
    const auto axes = random.axes();
    const auto H = random.displacement_gradient(axes);
    const auto tangent = wall::stress_and_tangent(law, H, axes).tangent;
    for (int k = 0; k < 9; ++k)
      for (int l = 0; l < k; ++l)
        EXPECT_NEAR(tangent[k][l], tangent[l][k], 2e-14 * stress_scale(law, H, axes)) << k << ", " << l;
  }
}

TEST_P(WallTangentAcrossRecruitment, WhatALinearStepLeavesFallsWithTheSquareOfTheStep) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  // Sharper, and the steps that the order shows at leave no more than rounding.
  for (const double sharpness : {10.0, 100.0, 1e3}) {
    const LawCase law = with_recruitment(GetParam(), "smooth", sharpness);
    for (const double distance : {-0.3, 0.3}) {
      // Uniaxial strain along family 0 at constant volume, until its I4bar - a^2 is 0.3/sharpness off.
      const auto axes = random.axes();
      const auto fiber = wall::families(law.law)[0].direction(axes);
      const double squared_stretch = wall::families(law.law)[0].activation_squared + distance / sharpness;
      const double along = std::sqrt(squared_stretch), across = 1 / std::sqrt(along);
      const Tensor<double> H =
          (along - across) * outer(fiber, fiber) + (across - 1) * Tensor<double>::identity();
      ASSERT_NEAR(static_cast<double>(law.reference.excess(0, deformation_gradient(H), axes)),
                  distance / sharpness, 1e-12);
      expect_second_order(law, H, axes, random.tensor(1.0), 2e-3 / sharpness);
    }
  }
}

// The share's own tangent, H' = epsilon/pi/(1 + epsilon^2 x^2), is what distinguishes the recruited law from
// an energy: at the threshold it has to be there, and it breaks the major symmetry.
TEST_P(WallTangentAcrossRecruitment, CarriesTheSlopeOfTheShare) {
  const LawCase law = with_recruitment(GetParam(), "smooth", 1e4);
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  const auto axes = random.axes();
  const auto fiber = wall::families(law.law)[0].direction(axes);
  const double along = std::sqrt(wall::families(law.law)[0].activation_squared + 1e-4),
               across = 1 / std::sqrt(along);
  const Tensor<double> H = (along - across) * outer(fiber, fiber) + (across - 1) * Tensor<double>::identity();
  const auto smooth = wall::stress_and_tangent(law.law, H, axes).tangent;
  const Matrix3 F = deformation_gradient(H);
  for (int k = 0; k < 9; ++k) {
    const auto component = [&](const Matrix3& G) { return law.reference.piola(G, axes)[k / 3][k % 3]; };
    Tensor<double> row;
    row.entries = smooth[k];
    // Steps of 1e-6 against a share that bends over 1e-4: truncation (1e-2)^2 of its part of the tangent.
    expect_near(row, rounded(by_differences(component, F)), 1e-3 * stress_scale(law.law, H, axes));
  }
}

INSTANTIATE_TEST_SUITE_P(Catalog, WallTangent, testing::ValuesIn(law_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Catalog, WallTangentAcrossRecruitment, testing::ValuesIn(fiber_law_cases()),
                         case_name);

}  // namespace
}  // namespace tunica::test_support
