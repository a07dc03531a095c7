// SPDX-License-Identifier: GPL-3.0-or-later
// Fibres at, around and far from recruitment, for sharpness from 10 to 1e7 and its limit.
#include "core/wall/recruitment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/wall/from_scene.hpp"
#include "tests/support/law_cases.hpp"

namespace tunica::test_support {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double sharpnesses[] = {10, 100, 1e3, 1e4, 1e5, 5e5, 1e6, 1e7};

/// Both families along the circumference reach I4bar = squared at constant volume and length.
Tensor<double> stretched_to(const LawCase& law, double squared) {
  const double angle = wall::families(law.law)[0].angle;
  // I4 = l^2 cos^2 + sin^2 with F = diag(1/l, l, 1)
  const double l =
      std::sqrt((squared - std::sin(angle) * std::sin(angle)) / (std::cos(angle) * std::cos(angle)));
  return Tensor<double>::diagonal(1 / l - 1, l - 1, 0);
}

const wall::MaterialAxes axes{{0, 1, 0}, {0, 0, 1}};

TEST(Recruitment, ValueAndSlopeAtAndAroundTheThreshold) {
  for (const double epsilon : sharpnesses) {
    const wall::Recruitment<double> recruitment{epsilon};
    EXPECT_EQ(recruitment.share(0.0), 0.5);
    for (const double scaled : {0.0, 1e-9, 1e-3, 0.5, 1.0, 3.0, 30.0, 1e4})
      for (const double sign : {-1.0, 1.0}) {
        const double x = sign * scaled / epsilon;
        const auto share = recruitment.share(Dual<double, 1>::variable(x));
        const Real exact = std::atan(Real(epsilon) * x) / std::numbers::pi_v<Real> + Real(0.5);
        EXPECT_NEAR(share.value, static_cast<double>(exact), 2e-16) << "x " << x;
        // H' = epsilon/pi/(1 + (epsilon x)^2)
        const double slope = epsilon / pi / (1 + epsilon * x * epsilon * x);
        EXPECT_NEAR(share.derivative[0], slope, 4e-16 * slope) << "x " << x;
        EXPECT_NEAR(share.value + recruitment.share(-x), 1.0, 2e-16);
      }
    // A quarter and three quarters at epsilon x = -+1, whatever the sharpness.
    EXPECT_NEAR(recruitment.share(-1 / epsilon), 0.25, 1e-15);
    EXPECT_NEAR(recruitment.share(1 / epsilon), 0.75, 1e-15);
  }
}

TEST(Recruitment, TheStepIsTheLimitAtTheRateOfOneOverSharpness) {
  const wall::Recruitment<double> sharp{0, true};
  EXPECT_EQ(sharp.share(0.0), 0.5);
  EXPECT_EQ(sharp.share(1e-300), 1.0);
  EXPECT_EQ(sharp.share(-1e-300), 0.0);
  EXPECT_EQ(sharp.share(Dual<double, 1>::variable(0.1)).derivative[0], 0.0);
  for (const double epsilon : sharpnesses)
    for (const double x : {-1.0, -0.2, 0.2, 1.0}) {
      const double difference = std::abs(wall::Recruitment<double>{epsilon}.share(x) - sharp.share(x));
      // 1/(pi epsilon |x|) (1 - 1/(3 (epsilon x)^2) + ...), and the share is rounded to 1e-16.
      const double leading = 1 / (pi * epsilon * std::abs(x));
      EXPECT_NEAR(difference, leading, leading / (3 * epsilon * x * epsilon * x) + 2e-16);
    }
}

class WallRecruitment : public testing::TestWithParam<LawCase> {};

TEST_P(WallRecruitment, SharpFibresCarryNothingBelowAndAllAbove) {
  const LawCase law = with_recruitment(GetParam(), "sharp");
  const double threshold = wall::families(law.law)[0].activation_squared;
  const auto matrix = without_fibers(law.law);
  for (const double distance : {-0.1, -1e-3, -1e-9, -1e-13}) {
    const auto H = stretched_to(law, threshold + distance);
    EXPECT_EQ(wall::piola(law.law, H, axes).entries, wall::piola(matrix, H, axes).entries) << distance;
  }
  for (const double distance : {1e-13, 1e-9, 1e-3, 0.1, 1.0}) {
    const auto H = stretched_to(law, threshold + distance);
    const Matrix3 F = deformation_gradient(H);
    const auto fibers =
        rounded(law.reference.fiber_piola(0, F, axes)) + rounded(law.reference.fiber_piola(1, F, axes));
    const auto actual = wall::piola(law.law, H, axes) - wall::piola(matrix, H, axes);
    expect_near(actual, fibers, 1e-14 * stress_scale(law.law, H, axes));
    for (const auto& family : wall::families(law.law))
      EXPECT_EQ(fiber_state(family, H, axes).recruitment, 1.0);
  }
}

TEST_P(WallRecruitment, TheStressTendsToTheSharpOneAtTheRateOfOneOverSharpness) {
  const LawCase sharp = with_recruitment(GetParam(), "sharp");
  const double threshold = wall::families(sharp.law)[0].activation_squared;
  for (const double distance : {-0.2, 0.3}) {
    const auto H = stretched_to(sharp, threshold + distance);
    const Matrix3 F = deformation_gradient(H);
    const auto fibers =
        rounded(sharp.reference.fiber_piola(0, F, axes)) + rounded(sharp.reference.fiber_piola(1, F, axes));
    for (const double epsilon : {1e3, 1e4, 1e5, 1e6}) {
      const auto smooth = wall::piola(with_recruitment(GetParam(), "smooth", epsilon).law, H, axes);
      const double tail = (distance < 0 ? 1 : -1) / (pi * epsilon * std::abs(distance));
      // The next term of the arctangent is 1/3 (epsilon x)^-2 of this one; rounding is that of the whole
      // stress.
      const double next = std::abs(tail) / (3 * epsilon * distance * epsilon * distance);
      expect_near(smooth - wall::piola(sharp.law, H, axes), tail * fibers,
                  1.1 * next * largest(fibers) + 1e-15 * stress_scale(sharp.law, H, axes));
    }
  }
}

// With exponent 1, as printed, the stress jumps by 2 W'(0) per family; with 2 it is continuous and its slope
// jumps.
TEST_P(WallRecruitment, TheStressJumpsOnlyWithExponentOne) {
  const LawCase law = with_recruitment(GetParam(), "sharp");
  const double threshold = wall::families(law.law)[0].activation_squared;
  const auto below = stretched_to(law, threshold - 1e-9), above = stretched_to(law, threshold + 1e-9);
  const auto jump = wall::piola(law.law, above, axes) - wall::piola(law.law, below, axes);
  // The stress itself moves by the tangent times the change of H, below 1e-8.
  const double smooth_part = 1e-8 * stress_scale(law.law, above, axes);
  if (law.exponent == 2) {
    EXPECT_LE(largest(jump), smooth_part);
    return;
  }
  Tensor<double> expected;
  for (const auto& family : wall::families(law.law)) {
    const Tensor<double> F = Tensor<double>::identity() + above;
    const auto a = F * family.direction(axes);
    // P = tau F^-T with tau = alpha dev(a x a), J = 1
    expected = expected + family.stiffness * (deviator(outer(a, a)) * cofactor(F));
  }
  expect_near(jump, expected, smooth_part);
  EXPECT_GT(largest(expected), 1e4);
}

TEST_P(WallRecruitment, FibresBelowActivationCarryNoMoreThanTheTailOfTheArctangent) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  const auto& law = GetParam();
  int below = 0;
  for (int sample = 0; sample < 200; ++sample) {
    const auto H = random.displacement_gradient();
    const Matrix3 F = deformation_gradient(H);
    const auto random_axes = random.axes();
    double bound = 0;
    bool all_below = true;
    for (std::size_t k = 0; k < law.reference.families.size(); ++k) {
      const auto x = static_cast<double>(law.reference.excess(k, F, random_axes));
      all_below &= x < -1e-3;
      bound += largest(rounded(law.reference.fiber_piola(k, F, random_axes))) / (pi * 5e5 * std::abs(x));
    }
    if (!all_below) continue;
    ++below;
    const auto fibers =
        wall::piola(law.law, H, random_axes) - wall::piola(without_fibers(law.law), H, random_axes);
    EXPECT_LE(largest(fibers), bound + 1e-15 * stress_scale(law.law, H, random_axes));
  }
  EXPECT_GE(below, 5);
}

// The exponential of the square would grow again far below the threshold, against which no tail of an
// arctangent helps.
TEST_P(WallRecruitment, FibresAnyDistanceBelowActivationCarryLess) {
  for (const wall::CollagenFamily<double>& own : wall::families(GetParam().law))
    for (const double stiffening : {own.stiffening, 20.0})
      for (const double excess : {-1e-3, -0.1, -1.0, -8.1, -24.0}) {
        wall::CollagenFamily<double> family = own;
        family.stiffening = stiffening;
        const double slope = family.energy(seed(excess)).derivative[0];
        EXPECT_LE(std::abs(slope * family.recruitment.share(excess)),
                  family.exponent == 2 ? 1.0001 * family.stiffness / (pi * 5e5)
                                       : family.stiffness / (pi * 5e5 * std::abs(excess)))
            << excess;
        family.recruitment.sharp = true;
        EXPECT_EQ(slope * family.recruitment.share(excess), 0);
      }
}

// W' = alpha x (1 + O(x^2)) on both sides.
TEST_P(WallRecruitment, TheEnergyIsSmoothAtTheThreshold) {
  for (const wall::CollagenFamily<double>& family : wall::families(GetParam().law)) {
    if (family.exponent == 1) continue;
    for (const double x : {-1e-6, 0.0, 1e-6}) {
      const auto energy = family.energy(seed(seed(seed(x))));
      EXPECT_NEAR(energy.derivative[0].value.value, family.stiffness * x, 1e-15 * family.stiffness);
      EXPECT_NEAR(energy.derivative[0].derivative[0].value / family.stiffness, 1, 1e-11);
      EXPECT_NEAR(energy.derivative[0].derivative[0].derivative[0] / family.stiffness, 0, 1e-4);
    }
  }
}

/// In mmHg, of a wall that has not moved.
double greatest_stress_at_rest(const std::vector<std::string>& overrides, const std::string& tissue = "") {
  const Scene scene = parse_scene("[wall]\n" + tissue, "at rest", ".", overrides);
  double greatest = 0;
  for (const auto& layer : wall::wall_from_scene(SeededScene<double>(scene))) {
    const Tensor<double> stress = wall::piola(layer.law, Tensor<double>{}, axes);
    for (const double entry : stress.entries) EXPECT_TRUE(std::isfinite(entry));
    greatest = std::max(greatest, largest(stress));
  }
  return greatest / 1333.22387;
}

TEST(WallAtRest, BearsNothingHoweverFarItsFibresAreFromTheirThreshold) {
  constexpr double bar = 1e-3;
  for (const char* stretch : {"4", "5"}) {
    const std::string threshold = std::string("wall.activation_stretch=") + stretch;
    for (const char* more : {"wall.exponent=2", "wall.exponent=1", "wall.recruitment=sharp"})
      EXPECT_LT(greatest_stress_at_rest({threshold, more}), bar) << threshold << ' ' << more;
  }
  // Beyond the greatest number, which a share of nothing does not multiply to nothing.
  for (const char* recruitment : {"smooth", "sharp"})
    EXPECT_LT(greatest_stress_at_rest({"wall.activation_squared=25", "wall.fiber_stiffening=100",
                                       std::string("wall.recruitment=") + recruitment}),
              bar);
  EXPECT_LT(greatest_stress_at_rest({},
                                    "[[wall.families]]\nangle = 10\nactivation_stretch = 5\n"
                                    "[[wall.families]]\nangle = -10\nactivation_squared = 24\n"),
            bar);
  EXPECT_LT(greatest_stress_at_rest({},
                                    "[[wall.layers]]\nfraction = 0.4\nactivation_stretch = 5\n"
                                    "[[wall.layers]]\nfraction = 0.6\nactivation_squared = 25\n"),
            bar);
}

TEST(WallAtRest, BearsLessThanHalfAMillimetreWhateverItsFibres) {
  RandomDeformation random;
  SCOPED_TRACE(random.origin());
  const auto set = [](const char* key, double value) {
    return std::string(key) + '=' + std::to_string(value);
  };
  for (int wall = 0; wall < 200; ++wall) {
    const std::vector<std::string> overrides{
        set("wall.fiber_stiffness", std::pow(10, random.uniform(4, 6.5))),
        set("wall.fiber_stiffening", std::pow(10, random.uniform(-2, 2))),
        set("wall.fiber_angle", random.uniform(0, 80)),
        set("wall.activation_stretch", random.uniform(1.1, 5)),
        random.uniform(0, 1) < 0.5 ? "wall.exponent=1" : "wall.exponent=2"};
    EXPECT_LT(greatest_stress_at_rest(overrides), 0.5) << testing::PrintToString(overrides);
  }
}

INSTANTIATE_TEST_SUITE_P(Catalog, WallRecruitment, testing::ValuesIn(fiber_law_cases()), case_name);

}  // namespace
}  // namespace tunica::test_support
