// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_deformation.hpp"
#include "tests/support/reference_law.hpp"

namespace tunica::test_support {
namespace {

__extension__ using Wide = __int128;

/// det(I + N/2^40) - 1 exactly: (det(2^40 I + N) - 2^120)/2^120 in whole numbers of 128 bits, which hold it
/// for entries of N up to some thousand, that is strains of 1e-12 to 1e-9.
double exact_volume_change(const std::array<long, 9>& n) {
  const Wide one = Wide{1} << 40;
  Wide a[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a[i][j] = n[3 * i + j] + (i == j ? one : 0);
  const Wide determinant = a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
                           a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
                           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
  return std::ldexp(static_cast<double>(determinant - (Wide{1} << 120)), -120);
}

Tensor<double> gradient_of(const std::array<long, 9>& n) {
  Tensor<double> H;
  for (int k = 0; k < 9; ++k) H.entries[k] = std::ldexp(static_cast<double>(n[k]), -40);
  return H;
}

// Five terms are added, the largest first: some ulps of the result unless the trace nearly cancels.
constexpr double ulps = 1e-15;

TEST(VolumeChange, IsExactToRoundOffAtStrainsOf1e12) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 100; ++sample) {
    std::array<long, 9> n;
    // Up to 5 * 2^-40, that is 4.5e-12.
    for (long& entry : n) entry = std::lround(random.uniform(-5, 5));
    const double exact = exact_volume_change(n);
    EXPECT_NEAR(volume_change(gradient_of(n)), exact, ulps * std::abs(exact));
    // The naive way keeps no more than four digits of it: this is what the formula is for.
  }
}

TEST(VolumeChange, KeepsItsSecondOrderWhereTheFirstVanishes) {
  // No trace: J - 1 is then of the order 1e-24.
  for (const std::array<long, 9>& n : {std::array<long, 9>{3, 0, 0, 0, -3, 0, 0, 0, 0},
                                       {5, 2, 0, 7, -2, 1, 0, 4, -3},
                                       {0, 9, 0, 9, 0, 0, 0, 0, 0}}) {
    const double exact = exact_volume_change(n);
    ASSERT_NE(exact, 0.0);
    ASSERT_LT(std::abs(exact), 1e-21);
    EXPECT_NEAR(volume_change(gradient_of(n)), exact, ulps * std::abs(exact));
  }
  // Simple shear changes no volume at all.
  EXPECT_EQ(volume_change(gradient_of({0, 7, 0, 0, 0, 0, 0, 0, 0})), 0.0);
}

TEST(VolumeChange, IsTheDeterminantMinusOneAtFiniteStrain) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 50; ++sample) {
    const auto H = random.displacement_gradient();
    Real J = 0;
    inverse_transpose(deformation_gradient(H), J);
    EXPECT_NEAR(volume_change(H), static_cast<double>(J - 1), 2e-15);
  }
}

TEST(Kinematics, HoldsTheMeasuresOfADeformation) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 50; ++sample) {
    const auto H = random.displacement_gradient();
    const Kinematics<double> k(H);
    const Matrix3 F = deformation_gradient(H);
    Real J = 0, trace_b = 0;
    Matrix3 cofactor_of_f = inverse_transpose(F, J);
    for (auto& row : cofactor_of_f)
      for (Real& entry : row) entry *= J;
    Matrix3 b{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int l = 0; l < 3; ++l) b[i][j] += F[i][l] * F[j][l];
    for (int i = 0; i < 3; ++i) {
      trace_b += b[i][i];
      b[i][i] -= 1;
    }
    const Real factor = std::pow(J, -2 / Real(3));
    expect_near(k.left_cauchy_green_change, rounded(b), 1e-14);
    expect_near(k.deformation_gradient, rounded(F), 1e-15);
    expect_near(k.deformation_cofactor, rounded(cofactor_of_f), 1e-14);
    EXPECT_NEAR(k.jacobian, static_cast<double>(J), 2e-15);
    EXPECT_NEAR(k.log_jacobian, static_cast<double>(std::log(J)), 4e-15);
    EXPECT_NEAR(k.isochoric_factor, static_cast<double>(factor), 4e-15);
    EXPECT_NEAR(k.isochoric_factor_change, static_cast<double>(factor - 1), 4e-15);
    EXPECT_NEAR(k.isochoric_first_invariant_change(), static_cast<double>(factor * trace_b - 3), 4e-14);
  }
}

TEST(Kinematics, TheInvariantDoesNotFeelAChangeOfSize) {
  // I1bar - 3 of F and of 1.1 F are the same; of the identity it is 0.
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  const auto I = Tensor<double>::identity();
  const auto F = I + random.displacement_gradient();
  EXPECT_NEAR(Kinematics<double>(F - I).isochoric_first_invariant_change(),
              Kinematics<double>(1.1 * F - I).isochoric_first_invariant_change(), 1e-14);
  EXPECT_EQ(Kinematics<double>(Tensor<double>{}).isochoric_first_invariant_change(), 0.0);
}

// The short way to the kinematics of a ring against the long one; with duals, whose products it leaves out,
// too.
TEST(Kinematics, OfADiagonalGradientAreThoseOfAnyOther) {
  using D = Dual<double, 3>;
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 20; ++sample) {
    D h[3];
    for (int i = 0; i < 3; ++i) h[i] = D::variable(random.uniform(-0.4, 0.8), i);
    const auto brief = Kinematics<D>::diagonal(h[0], h[1], h[2]);
    const Kinematics<D> full(Tensor<D>::diagonal(h[0], h[1], h[2]));
    const auto expect_same = [](const D& a, const D& b) {
      EXPECT_NEAR(a.value, b.value, 1e-14);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(a.derivative[i], b.derivative[i], 1e-13);
    };
    for (int k = 0; k < 9; ++k) {
      expect_same(brief.displacement_gradient.entries[k], full.displacement_gradient.entries[k]);
      expect_same(brief.deformation_gradient.entries[k], full.deformation_gradient.entries[k]);
      expect_same(brief.deformation_cofactor.entries[k], full.deformation_cofactor.entries[k]);
      expect_same(brief.left_cauchy_green_change.entries[k], full.left_cauchy_green_change.entries[k]);
    }
    expect_same(brief.volume_change, full.volume_change);
    expect_same(brief.jacobian, full.jacobian);
    expect_same(brief.log_jacobian, full.log_jacobian);
    expect_same(brief.isochoric_factor_change, full.isochoric_factor_change);
    expect_same(brief.isochoric_factor, full.isochoric_factor);
  }
}

TEST(Kinematics, PiolaAndKirchhoffStressAreOneThroughF) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 20; ++sample) {
    const auto H = random.displacement_gradient();
    const Kinematics<double> k(H);
    const auto tau = random.tensor(1.0);
    const auto P = k.piola_from_kirchhoff(tau);
    expect_near(P * transpose(k.deformation_gradient), tau, 2e-14);
    expect_near(k.jacobian * cauchy_stress(P, H), tau, 2e-14);
  }
}

}  // namespace
}  // namespace tunica::test_support
