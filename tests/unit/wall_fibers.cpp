// SPDX-License-Identifier: GPL-3.0-or-later
// Directions, thresholds, weights and what is observed of collagen families.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/wall/from_scene.hpp"
#include "tests/support/law_cases.hpp"

namespace tunica::test_support {
namespace {

constexpr double degree = std::numbers::pi / 180;
const wall::MaterialAxes axes{{0, 1, 0}, {0, 0, 1}};
using wall::CollagenFamily;

CollagenFamily<double> family_at(double degrees, double activation_squared = 1.0) {
  return {degrees * degree, 1.0, 1e5, 0.5, activation_squared, 2, {5e5}};
}

Tensor<double> diagonal_gradient(double r, double t, double z) {
  return Tensor<double>::diagonal(r - 1, t - 1, z - 1);
}

TEST(Activation, ThePapersFiniteStrainFibresAreRecruitedAtASquared) {
  // 1.5009^2 cos^2(42.82 deg) + sin^2(42.82 deg), by hand to four decimals.
  EXPECT_NEAR(wall::activation_squared(1.5009, 42.82 * degree), 1.6740, 5e-5);
  const LawCase finite_strain = law_case("EXP1+EXP2-FS");
  EXPECT_NEAR(wall::families(finite_strain.law)[0].activation_squared, 1.6740, 5e-5);
  // At activation stretch 1 every direction is recruited from rest; at 0 degrees a = lambda.
  EXPECT_NEAR(wall::activation_squared(1.0, 0.7), 1.0, 1e-15);
  EXPECT_NEAR(wall::activation_squared(1.3, 0.0), 1.69, 1e-15);
  EXPECT_NEAR(wall::activation_squared(1.3, std::numbers::pi / 2), 1.0, 1e-15);
}

TEST(Activation, IsReachedByTheActivationStretchAlongTheCircumferenceAtConstantLength) {
  const LawCase law = law_case("EXP1+EXP2-FS");
  ASSERT_EQ(wall::families(law.law).size(), 2u);
  for (const auto& family : wall::families(law.law)) {
    const Kinematics<double> k(diagonal_gradient(1 / 1.5009, 1.5009, 1));
    EXPECT_NEAR(family.excess(k, axes), 0.0, 1e-14);
  }
}

TEST(Activation, ZeroStrainFibresAreRecruitedFromRest) {
  const auto law = law_case("EXP1+EXP2-ZS").law;
  ASSERT_EQ(wall::families(law).size(), 2u);
  for (const auto& family : wall::families(law)) EXPECT_EQ(family.activation_squared, 1.0);
}

TEST(FiberState, AngleAndStretchOfAStretchedRing) {
  for (const double beta : {5.0, 42.82, 56.52, 85.0})
    for (const double sign : {-1.0, 1.0}) {
      const double lt = 1.4, lz = 1.1, lr = 1 / (lt * lz), c = std::cos(beta * degree),
                   s = std::sin(beta * degree);
      const auto state = fiber_state(family_at(sign * beta), diagonal_gradient(lr, lt, lz), axes);
      EXPECT_NEAR(state.angle, std::atan(lz * s / (lt * c)), 1e-15);
      EXPECT_NEAR(state.stretch, std::sqrt(lt * lt * c * c + lz * lz * s * s), 1e-15);
      // Equal stretches change volume alone: neither turn a fibre nor stretch it isochorically.
      const auto blown_up = fiber_state(family_at(sign * beta), diagonal_gradient(1.2, 1.2, 1.2), axes);
      EXPECT_NEAR(blown_up.angle, beta * degree, 1e-15);
      EXPECT_NEAR(blown_up.stretch, 1.0, 1e-15);
      EXPECT_NEAR(blown_up.recruitment, 0.5, 1e-8);  // the excess is 0 to 1e-15, times the sharpness 5e5
    }
}

TEST(FiberState, AngleIsMeasuredAgainstTheDeformedCircumference) {
  // Torsion by shear k of the axis along the circumference: a0 = (c, s) goes to (c + k s, s).
  const double k = 0.6;
  Tensor<double> torsion;
  torsion(1, 2) = k;
  for (const double beta : {-60.0, -42.82, 10.0, 70.0}) {
    const double c = std::cos(beta * degree), s = std::sin(beta * degree);
    const auto state = fiber_state(family_at(beta), torsion, axes);
    EXPECT_NEAR(state.angle, std::atan(std::abs(s / (c + k * s))), 1e-15);
    EXPECT_NEAR(state.stretch, std::hypot(c + k * s, s), 1e-15);
  }
  // Shear of the circumference along the axis turns the reference direction as well: (1, 0) goes to (1, k).
  Tensor<double> twist;
  twist(2, 1) = k;
  const double c = std::cos(0.5), s = std::sin(0.5);
  EXPECT_NEAR(fiber_state(family_at(0.5 / degree), twist, axes).angle,
              std::atan2(s + k * c, c) - std::atan(k), 1e-15);
}

TEST(FiberState, DoesNotFeelARotation) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  const auto family = family_at(30, 1.3);
  for (int sample = 0; sample < 20; ++sample) {
    const auto H = random.displacement_gradient();
    const auto q = random.rotation();
    const auto a = fiber_state(family, H, axes);
    const auto b =
        fiber_state(family, q * (Tensor<double>::identity() + H) - Tensor<double>::identity(), axes);
    EXPECT_NEAR(a.angle, b.angle, 1e-14);
    EXPECT_NEAR(a.stretch, b.stretch, 1e-14);
    EXPECT_GE(a.angle, 0.0);
    EXPECT_LE(a.angle, std::numbers::pi / 2);
  }
}

TEST(FiberState, DerivativesOfAngleAndStretchAreThoseOfTheirFormulae) {
  using D = Dual<double, 1>;
  const double beta = 42.82 * degree, lz = 1.1, c = std::cos(beta), s = std::sin(beta);
  const D lt = D::variable(1.4);
  const CollagenFamily<D> family{D(beta), D(1.0), D(1e5), D(0.5), D(1.0), 2, {D(10.0)}};
  const auto H = Tensor<D>::diagonal(1.0 / (lt * lz) - 1.0, lt - 1.0, D(lz - 1));
  const auto state = fiber_state(family, H, axes);
  // angle = atan(q), q = lz s/(lt c): -q/lt/(1 + q^2); stretch = sqrt(lt^2 c^2 + lz^2 s^2)
  const double q = lz * s / (1.4 * c);
  EXPECT_NEAR(state.angle.derivative[0], -q / 1.4 / (1 + q * q), 1e-14);
  EXPECT_NEAR(state.stretch.derivative[0], 1.4 * c * c / state.stretch.value, 1e-14);
  const double x = state.stretch.value * state.stretch.value - 1;
  EXPECT_NEAR(state.recruitment.derivative[0], 10 / std::numbers::pi / (1 + 100 * x * x) * 2 * 1.4 * c * c,
              1e-13);
}

// A fibre along the circumference stays there by symmetry: its angle is 0 whatever the parameters, and so is
// the derivative of that.
TEST(FiberState, AFibreAlongTheCircumferenceHasAFiniteDerivative) {
  using D = Dual<double, 1>;
  const D lt = D::variable(1.4);
  const CollagenFamily<D> family{D(0.0), D(1.0), D(1e5), D(0.5), D(1.0), 2, {D(10.0)}};
  const auto state = fiber_state(family, Tensor<D>::diagonal(1.0 / lt - 1.0, lt - 1.0, D(0.0)), axes);
  EXPECT_EQ(state.angle.value, 0.0);
  EXPECT_EQ(state.angle.derivative[0], 0.0);
  EXPECT_NEAR(state.stretch.derivative[0], 1.0, 1e-15);
}

TEST(Families, WeightsAnglesAndParametersAreEachFamilysOwn) {
  const Scene scene = parse_scene(R"(
[wall]
law = "EXP1+EXP2-FS"
activation_squared = 1.1
[[wall.families]]
angle = 20
weight = 0.3
[[wall.families]]
angle = -60
weight = 1.7
stiffness = 4e4
stiffening = 0.9
activation_stretch = 1.02
)",
                                  "families.toml", ".");
  const auto law = wall::wall_from_scene(SeededScene<double>(scene)).front().law;
  const auto& families = wall::families(law);
  ASSERT_EQ(families.size(), 2u);
  EXPECT_NEAR(families[0].angle, 20 * degree, 1e-16);
  EXPECT_NEAR(families[1].angle, -60 * degree, 1e-16);
  EXPECT_EQ(families[0].weight, 0.3);
  EXPECT_EQ(families[1].weight, 1.7);
  EXPECT_EQ(families[0].stiffness, 1.3370e5);
  EXPECT_EQ(families[1].stiffness, 4e4);
  EXPECT_EQ(families[0].stiffening, 0.2141);
  EXPECT_EQ(families[1].stiffening, 0.9);
  EXPECT_EQ(families[0].activation_squared, 1.1);
  EXPECT_NEAR(families[1].activation_squared, 1.0404 * 0.25 + 0.75, 1e-15);

  const ReferenceLaw reference = reference_law(scene);
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  for (int sample = 0; sample < 20; ++sample) {
    const auto random_axes = random.axes();
    const auto H = random.displacement_gradient(random_axes);
    expect_near(wall::piola(law, H, random_axes),
                rounded(reference.piola(deformation_gradient(H), random_axes)),
                2e-14 * stress_scale(law, H, random_axes));
  }
}

TEST(Families, TheWeightMultipliesAFamilysStress) {
  const auto weighted = [](const char* weight) {
    const Scene scene = parse_scene(
        std::string("[[wall.families]]\nangle = 30\nactivation_squared = 1.01\nweight = ") + weight,
        "weight.toml", ".");
    return wall::wall_from_scene(SeededScene<double>(scene)).front().law;
  };
  const auto H = diagonal_gradient(1 / 1.4, 1.4, 1);
  const auto none = wall::piola(weighted("0"), H, axes), one = wall::piola(weighted("1"), H, axes),
             twice = wall::piola(weighted("2.5"), H, axes);
  expect_near(none, wall::piola(without_fibers(weighted("1")), H, axes), 1e-9);
  EXPECT_GT(largest(one - none), 1e4);
  expect_near(twice - none, 2.5 * (one - none), 1e-9);
}

}  // namespace
}  // namespace tunica::test_support
