// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/time_left.hpp"

namespace tunica {
namespace {

/// A run of `end` s that takes a second a step. Its steps begin at `first` s and grow by `growth` to `most`.
struct Course {
  double first, growth, most, end;

  double step(long k) const { return std::min(most, first * std::pow(growth, static_cast<double>(k))); }
  long steps() const {
    double time = 0;
    long k = 0;
    for (; time < end; ++k) time += step(k);
    return k;
  }
};

/// All figures are within a factor of two of the truth; gives how many there were.
long expect_meaningful(const Course& course) {
  TimeLeft left;
  const long steps = course.steps();
  double time = 0;
  long figures = 0;
  left.note(0, 0);
  for (long k = 0; k < steps; ++k) {
    time = std::min(course.end, time + course.step(k));
    const auto spent = static_cast<double>(k + 1);
    left.note(spent, time);
    const auto figure = left.until(course.end);
    if (!figure) continue;
    ++figures;
    const double truth = static_cast<double>(steps) - spent;
    EXPECT_LE(*figure, 2 * truth + 1) << "after " << spent << " of " << steps << " s";
    EXPECT_GE(*figure, 0.5 * truth - 1) << "after " << spent << " of " << steps << " s";
  }
  return figures;
}

// First steps are a ten-thousandth of a beat: by their pace a run of a minute takes ten hours.
TEST(TimeLeft, IsNotToldFromTheTinyStepsOfABeginning) {
  const Course two_beats{8e-5, 1.6, 0.03, 1.6};
  ASSERT_NEAR(static_cast<double>(two_beats.steps()), 66, 5);
  EXPECT_GT(expect_meaningful(two_beats), 20);
}

TEST(TimeLeft, OfAFixedStepIsToldSoonAndExactly) {
  TimeLeft left;
  for (int k = 0; k < 9; ++k) left.note(k, 0.01 * k);
  EXPECT_FALSE(left.until(1.0));
  left.note(9, 0.09);
  ASSERT_TRUE(left.until(1.0));
  EXPECT_NEAR(*left.until(1.0), 91, 1e-9);
}

// A lead-in of steps that are hardly longer than the first, as of a load that comes at once.
TEST(TimeLeft, OfSlowGrowthWaitsForThePace) {
  EXPECT_GT(expect_meaningful({1e-6, 1.2, 0.01, 1.6}), 20);
}

TEST(TimeLeft, FollowsRunsOfManySteps) {
  TimeLeft left;
  constexpr long steps = 100000;
  for (long k = 0; k <= steps / 2; ++k) left.note(1e-3 * static_cast<double>(k), static_cast<double>(k));
  ASSERT_TRUE(left.until(steps));
  EXPECT_NEAR(*left.until(steps), 50, 1e-6);
}

TEST(TimeLeft, IsNoneWhileNothingMoves) {
  TimeLeft left;
  for (int k = 0; k < 100; ++k) left.note(k, 0.5);
  EXPECT_FALSE(left.until(1.0));
}

}  // namespace
}  // namespace tunica
