// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/tensor.hpp"

#include <gtest/gtest.h>

#include "tests/support/random_deformation.hpp"

namespace tunica::test_support {
namespace {

using T = Tensor<double>;

T from(const std::array<double, 9>& entries) {
  T t;
  t.entries = entries;
  return t;
}

const T a = from({2, -1, 3, 0, 4, 1, -2, 5, 7});
const T b = from({1, 2, 0, -1, 3, 5, 2, 2, -3});

TEST(Tensor, ProductsWorkedOutByHand) {
  EXPECT_EQ((a * b).entries, (std::array<double, 9>{9, 7, -14, -2, 14, 17, 7, 25, 4}));
  EXPECT_EQ((a * Vector<double>{1, -1, 2}), (Vector<double>{9, -2, 7}));
  EXPECT_EQ(transpose(a).entries, (std::array<double, 9>{2, 0, -2, -1, 4, 5, 3, 1, 7}));
  EXPECT_EQ(trace(a), 13.0);
  EXPECT_EQ(contract(a, b), 2 - 2 + 0 + 0 + 12 + 5 - 4 + 10 - 21.0);
  EXPECT_EQ((a + b).entries, (std::array<double, 9>{3, 1, 3, -1, 7, 6, 0, 7, 4}));
  EXPECT_EQ((a - b).entries, (std::array<double, 9>{1, -3, 3, 1, 1, -4, -4, 3, 10}));
  EXPECT_EQ((2 * a).entries, (a + a).entries);
}

TEST(Tensor, DeterminantAndCofactorWorkedOutByHand) {
  // Along the first row: 2 (28 - 5) + 1 (0 + 2) + 3 (0 + 8)
  EXPECT_EQ(determinant(a), 72.0);
  EXPECT_EQ(cofactor(a).entries, (std::array<double, 9>{23, -2, 8, 22, 20, -8, -13, -2, 8}));
  EXPECT_EQ(determinant(T::identity()), 1.0);
  // A singular one: the third row is the sum of the others.
  EXPECT_EQ(determinant(from({1, 2, 3, 4, 5, 6, 5, 7, 9})), 0.0);
}

TEST(Tensor, CofactorOverDeterminantIsTheInverseTransposed) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 50; ++sample) {
    const T F = T::identity() + random.displacement_gradient();
    const double J = determinant(F);
    // Entries of order 1, condition numbers below 10.
    expect_near(transpose(cofactor(F)) * F, J * T::identity(), 1e-14);
    expect_near(F * transpose(cofactor(F)), J * T::identity(), 1e-14);
    const T G = T::identity() + random.displacement_gradient();
    EXPECT_NEAR(determinant(F * G), J * determinant(G), 1e-14);
    expect_near(cofactor(F * G), cofactor(F) * cofactor(G), 1e-13);
  }
}

TEST(Tensor, TheDerivativeOfTheDeterminantIsTheCofactor) {
  Tensor<Dual<double, 9>> seeded;
  for (int k = 0; k < 9; ++k) seeded.entries[k] = Dual<double, 9>::variable(a.entries[k], k);
  EXPECT_EQ(determinant(seeded).derivative, cofactor(a).entries);
}

TEST(Tensor, DotCrossAndOuterProducts) {
  const Vector<double> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, u{2, -3, 5}, v{-1, 4, 0.5};
  EXPECT_EQ(cross(x, y), z);
  EXPECT_EQ(cross(y, z), x);
  EXPECT_EQ(cross(z, x), y);
  EXPECT_EQ(cross(u, v), (Vector<double>{-21.5, -6, 5}));
  EXPECT_EQ(dot(cross(u, v), u), 0.0);
  EXPECT_EQ(dot(u, v), -11.5);
  EXPECT_EQ(outer(u, v).entries, (std::array<double, 9>{-2, 8, 1, 3, -12, -1.5, -5, 20, 2.5}));
  // (u x v) w = u (v . w)
  const Vector<double> w{0.5, 1, -2};
  EXPECT_EQ(outer(u, v) * w, (Vector<double>{2 * 2.5, -3 * 2.5, 5 * 2.5}));
}

TEST(Tensor, TheDeviatorHasNoTraceAndLeavesThePressure) {
  const T s = deviator(from({5, 1, 2, 1, -1, 3, 2, 3, 2}));
  EXPECT_EQ(s.entries, (std::array<double, 9>{3, 1, 2, 1, -3, 3, 2, 3, 0}));
  EXPECT_EQ(largest(deviator(7.0 * T::identity())), 0.0);
}

TEST(Tensor, LiftedEntriesAreConstants) {
  const auto lifted = lift<Dual<double, 2>>(a);
  for (int k = 0; k < 9; ++k) {
    EXPECT_EQ(lifted.entries[k].value, a.entries[k]);
    EXPECT_EQ(lifted.entries[k].derivative, (std::array<double, 2>{0, 0}));
  }
  const auto x = Dual<double, 2>::variable(3.0, 1);
  EXPECT_EQ((x * lifted)(2, 1).derivative[1], 5.0);
  EXPECT_EQ((lifted * Vector<double>{1, -1, 2})[0].value, 9.0);
}

}  // namespace
}  // namespace tunica::test_support
