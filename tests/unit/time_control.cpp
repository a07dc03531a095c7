// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/step_control.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>

#include "tests/support/time_problems.hpp"

using namespace tunica;
using namespace tunica::test_support;
using time::Method;
using time::Scheme;
using time::StepControl;
using time::StepOptions;
using time::Verdict;

namespace {

/// u' = -u + f(t), and a stiff follower w' = -1e6 (w - u^2). The forcing f has kinks.
constexpr double stiffness = 1e6;
const Vector kinks = {0.3, 0.7, 1.1};
const Vector heights = {0, 1, 1, 0.2, 0.6};  ///< of f at 0, the kinks and the end
constexpr double end = 2;

double corner(std::size_t piece) {
  return piece == 0 ? 0 : piece <= kinks.size() ? kinks[piece - 1] : end;
}

std::size_t piece_at(double t) {
  return std::upper_bound(kinks.begin(), kinks.end(), t) - kinks.begin();
}

double forcing(double t) {
  const std::size_t piece = piece_at(t);
  const double from = corner(piece),
               slope = (heights[piece + 1] - heights[piece]) / (corner(piece + 1) - from);
  return heights[piece] + slope * (t - from);
}

/// u at t1 exactly, from u at t0.
double flow(double u, double t0, double t1) {
  while (t0 < t1) {
    const std::size_t piece = piece_at(t0);
    const double to = std::min(t1, corner(piece + 1));
    const double slope = (heights[piece + 1] - heights[piece]) / (corner(piece + 1) - corner(piece));
    // The particular solution is f - slope.
    const double f0 = heights[piece] + slope * (t0 - corner(piece));
    const double f1 = heights[piece] + slope * (to - corner(piece));
    u = f1 - slope + (u - f0 + slope) * std::exp(t0 - to);
    t0 = to;
  }
  return u;
}

TimeProblem kinked() {
  return {"kinked",
          [](double t, const Vector& y, const Vector& rate) -> Vector {
            return {rate[0] + y[0] - forcing(t), rate[1] / stiffness + y[1] - y[0] * y[0]};
          },
          [](double t) -> Vector {
            const double u = flow(0, 0, t);
            return {u, u * u};
          },
          2};
}

struct Trace {
  Vector times, sizes, local_errors;
  std::vector<Vector> values;
  StepControl::Counts counts;
  std::vector<int> orders;  ///< of the estimates
};

struct Position {
  Scheme::Saved scheme;
  StepControl::Saved control;
};

StepOptions adaptive() {
  return {.first = 1e-3, .minimum = 1e-9, .maximum = 0.5};
}

/// From 0, or from a saved position, to the end. The scheme is told of the kinks when `announced`. The
/// position after `save_after` steps is stored.
Trace integrate(Method method, double tolerance, bool announced, const StepOptions& options,
                const std::optional<Position>& from = {}, int save_after = -1, Position* saved = nullptr) {
  const TimeProblem problem = kinked();
  Scheme scheme(method, 0.5);
  StepControl control(options);
  if (from) {
    scheme.restore(from->scheme);
    control.restore(from->control);
  } else {
    scheme.start(0, {0, 0}, {0, 0});
  }
  Trace run;
  Vector y, error(2);
  while (scheme.time() < end) {
    if (saved && static_cast<int>(run.times.size()) == save_after) *saved = {scheme.save(), control.save()};
    const double stop = announced ? corner(piece_at(scheme.time()) + 1) : end;
    const time::Step step = control.next(scheme.time(), stop);
    scheme.begin(step);
    Verdict verdict = Verdict::retry;
    const int order = scheme.error_order();
    if (solve_stage(problem, scheme, y)) {
      if (order > 0) scheme.error(y, error);
      verdict = control.judge(std::max(std::abs(error[0]), std::abs(error[1])) / tolerance, order);
    } else {
      verdict = control.solve_failed();
    }
    EXPECT_NE(verdict, Verdict::give_up);
    if (verdict == Verdict::give_up) break;
    if (verdict == Verdict::retry) continue;
    const double t = scheme.time(), u = scheme.value()[0];
    scheme.accept(y);
    run.times.push_back(scheme.time());
    run.sizes.push_back(step.size);
    run.values.push_back(scheme.value());
    run.orders.push_back(order);
    run.local_errors.push_back(std::abs(scheme.value()[0] - flow(u, t, scheme.time())));
    if (announced && scheme.time() == stop && stop < end) {
      scheme.start(scheme.time(), Vector(scheme.value()));
      control.restart();
    }
  }
  run.counts = control.counts();
  return run;
}

double global_error(const Trace& run) {
  double worst = 0;
  for (std::size_t k = 0; k < run.times.size(); ++k) {
    const double u = flow(0, 0, run.times[k]);
    worst = std::max({worst, std::abs(run.values[k][0] - u), std::abs(run.values[k][1] - u * u)});
  }
  return worst;
}

/// Largest error made within one step that had an estimate.
double largest_local_error(const Trace& run) {
  double worst = 0;
  for (std::size_t k = 0; k < run.times.size(); ++k)
    if (run.orders[k] > 0) worst = std::max(worst, run.local_errors[k]);
  return worst;
}

std::size_t changes_of_step(const Vector& sizes) {
  std::size_t changes = 0;
  for (std::size_t k = 1; k < sizes.size(); ++k) changes += sizes[k] != sizes[k - 1] ? 1 : 0;
  return changes;
}

/// Sizes of the accepted steps from `time` to `stop`, each with the error that `error_of` gives for it.
template <class ErrorOf>
Vector steps_to(StepControl& control, double time, double stop, ErrorOf error_of) {
  Vector sizes;
  while (time < stop) {
    const time::Step step = control.next(time, stop);
    EXPECT_LE(step.end_time, stop);
    // The size may be that of the steps before, to rounding.
    EXPECT_NEAR(step.end_time - time, step.size, 1e-8 * step.size + 1e-15 * stop);
    if (control.judge(error_of(step.size), 2) != Verdict::accept) continue;
    sizes.push_back(step.size);
    time = step.end_time;
  }
  EXPECT_EQ(time, stop);
  return sizes;
}

std::string method_name(const testing::TestParamInfo<Method>& info) {
  if (info.param == Method::bdf2) return "bdf2";
  return info.param == Method::backward_euler ? "euler" : "alpha";
}

class ControlledScheme : public testing::TestWithParam<Method> {};

}  // namespace

// The estimate is of the error that a step makes from exact values: for bdf2 2/9 h^3 times the third
// derivative, whereas its steps add 1/3 h^3 each to the error. So that is up to 1.5 times the tolerance.
TEST_P(ControlledScheme, KeepsErrorsWithinTheTolerance) {
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7}) {
    SCOPED_TRACE(testing::Message() << "tolerance " << tolerance);
    EXPECT_LT(largest_local_error(integrate(GetParam(), tolerance, true, adaptive())), 1.5 * tolerance);
  }
}

TEST_P(ControlledScheme, FindsKinksThatItIsNotToldOf) {
  const Trace told = integrate(GetParam(), 1e-5, true, adaptive());
  const Trace untold = integrate(GetParam(), 1e-5, false, adaptive());
  EXPECT_LT(global_error(untold), 1.5 * global_error(told));
  EXPECT_GT(untold.counts.rejected_by_error, 0);
}

TEST_P(ControlledScheme, MeetsKinksExactlyAndWithoutSlivers) {
  const Trace run = integrate(GetParam(), 1e-5, true, adaptive());
  for (const double kink : kinks) {
    const auto found = std::find(run.times.begin(), run.times.end(), kink);
    ASSERT_NE(found, run.times.end());
    const std::size_t at = found - run.times.begin();
    EXPECT_GT(run.sizes[at], 0.5 * run.sizes[at - 1]);
    EXPECT_GT(run.sizes[at - 1], 0.5 * run.sizes[at - 2]);
  }
  EXPECT_EQ(run.times.back(), end);
}

TEST_P(ControlledScheme, ResumesBitwise) {
  const Trace whole = integrate(GetParam(), 1e-5, true, adaptive());
  const int last = static_cast<int>(whole.times.size());
  for (int after = 0; after < last; after += 1 + last / 40) {
    SCOPED_TRACE(testing::Message() << "after step " << after);
    Position position;
    integrate(GetParam(), 1e-5, true, adaptive(), {}, after, &position);
    const Trace rest = integrate(GetParam(), 1e-5, true, adaptive(), position);
    EXPECT_EQ(rest.times, Vector(whole.times.begin() + after, whole.times.end()));
    EXPECT_EQ(rest.values, std::vector<Vector>(whole.values.begin() + after, whole.values.end()));
    EXPECT_EQ(rest.counts.rejected_by_error, whole.counts.rejected_by_error);
  }
}

INSTANTIATE_TEST_SUITE_P(Time, ControlledScheme,
                         testing::Values(Method::bdf2, Method::backward_euler, Method::generalized_alpha),
                         method_name);

// Errors of tol a step, of a size h ~ tol^(1/(p+1)), add up to tol^(p/(p+1)). Steps are not all at the limit.
TEST(StepControl, ErrorsOfTheRunFallWithTheTolerance) {
  for (const Method method : {Method::bdf2, Method::backward_euler}) {
    const double order = method == Method::backward_euler ? 1 : 2;
    const Trace loose = integrate(method, 1e-4, true, adaptive());
    const Trace tight = integrate(method, 1e-7, true, adaptive());
    EXPECT_NEAR(std::log10(global_error(loose) / global_error(tight)) / 3, order / (order + 1), 0.1);
  }
}

TEST(StepControl, SeldomChangesTheStep) {
  const Trace run = integrate(Method::bdf2, 1e-6, true, adaptive());
  // Four starts, each with some eight doublings, account for most changes.
  EXPECT_LT(changes_of_step(run.sizes), run.sizes.size() / 4);
  // Few steps are tried in vain.
  EXPECT_LT(run.counts.rejected_by_error, static_cast<long>(run.sizes.size()) / 20);
  EXPECT_EQ(run.counts.accepted, static_cast<long>(run.sizes.size()));
}

TEST(StepControl, LeavesAStepThatIsNearlyRight) {
  StepControl control({.first = 0.01, .minimum = 1e-6, .maximum = 1});
  // Errors that ask for 1.20 and 1.27 times the step, in turns.
  int step = 0;
  const auto error = [&](double) { return std::pow(0.9 / (step++ % 2 ? 1.27 : 1.2), 3); };
  const Vector sizes = steps_to(control, 0, 1, error);
  EXPECT_EQ(sizes.size(), 100u);
  EXPECT_EQ(changes_of_step(sizes), 0u);
}

TEST(StepControl, ApproachesTheStepOfTheTolerance) {
  StepControl control({.first = 1e-4, .minimum = 1e-6, .maximum = 10});
  // Error (h/0.05)^3: steps of 0.9 0.05 are wanted, those down to 0.9 0.05/1.3 are near enough, and the even
  // division takes less than a tenth of that, as there are more than ten left.
  const Vector sizes = steps_to(control, 0, 5, [](double h) { return std::pow(h / 0.05, 3); });
  EXPECT_EQ(control.counts().rejected_by_error, 0);
  for (std::size_t k = 1; k < sizes.size(); ++k) EXPECT_LE(sizes[k], 2 * sizes[k - 1] * (1 + 1e-9));
  EXPECT_GT(sizes.back(), 0.9 * 0.9 * 0.05 / 1.3);
  EXPECT_LE(sizes.back(), 0.9 * 0.05 * (1 + 1e-9));
}

TEST(StepControl, GoesBackToLongStepsAfterAStopNearby) {
  StepControl control({.first = 0.1, .minimum = 1e-6, .maximum = 0.1});
  const auto small = [](double h) { return std::pow(h / 0.2, 3); };
  EXPECT_EQ(steps_to(control, 0, 1, small).size(), 10u);
  const Vector near = steps_to(control, 1, 1.01, small);
  EXPECT_EQ(near.size(), 1u);
  // Doubled from 0.01 on.
  const Vector after = steps_to(control, 1.01, 3, small);
  EXPECT_LE(after[0], 0.02 * (1 + 1e-9));
  EXPECT_GT(after[4], 0.09);
}

TEST(StepControl, HalvesThenQuartersWhatCannotBeSolvedAndDoesNotGrowAtOnce) {
  StepControl control({.first = 1, .minimum = 1e-3, .maximum = 1});
  EXPECT_EQ(control.next(0, 16).size, 1);
  EXPECT_EQ(control.solve_failed(), Verdict::retry);
  EXPECT_EQ(control.next(0, 16).size, 0.5);
  EXPECT_EQ(control.solve_failed(), Verdict::retry);
  EXPECT_EQ(control.next(0, 16).size, 0.125);
  int held = 0;
  for (double time = 0; control.next(time, 16).size == 0.125; ++held) {
    EXPECT_EQ(control.judge(1e-6, 2), Verdict::accept);
    time += 0.125;
  }
  EXPECT_GE(held, 5);
  EXPECT_LE(held, 10);
  EXPECT_EQ(control.counts().rejected_by_solver, 2);
}

TEST(StepControl, GivesUpAtTheFloor) {
  StepControl control({.first = 1, .minimum = 0.1, .maximum = 1});
  Vector tried;
  Verdict verdict = Verdict::retry;
  while (verdict == Verdict::retry && tried.size() < 10) {
    tried.push_back(control.next(0, 100).size);
    verdict = control.judge(NAN, 2);
  }
  EXPECT_EQ(verdict, Verdict::give_up);
  EXPECT_NEAR(tried.back(), 0.1, 1e-15);

  StepControl failing({.first = 1, .minimum = 0.1, .maximum = 1});
  tried.clear();
  do {
    tried.push_back(failing.next(0, 100).size);
    verdict = failing.solve_failed();
  } while (verdict == Verdict::retry && tried.size() < 10);
  EXPECT_EQ(tried, (Vector{1, 0.5, 0.125, 0.1}));
}

TEST(StepControl, FixedStepsAreEqualAndDivideTheTimeToTheStop) {
  StepControl control({.first = 0.03, .minimum = 1e-6, .maximum = 0.03, .fixed = true});
  const auto ignored = [](double) { return 1e9; };
  Vector sizes = steps_to(control, 0, 1, ignored);
  EXPECT_EQ(sizes.size(), 34u);
  for (const double size : sizes) EXPECT_EQ(size, 1.0 / 34);
  // The step goes into this ten times, but for rounding.
  sizes = steps_to(control, 1, 1.3, ignored);
  EXPECT_EQ(sizes.size(), 10u);
  EXPECT_EQ(changes_of_step(sizes), 0u);
  EXPECT_EQ(control.counts().accepted, 44);
  EXPECT_EQ(control.counts().rejected_by_error, 0);
}

TEST(StepControl, AFixedStepThatFailsIsDividedAndTheOthersDoubleUntilTheyAreAsBefore) {
  StepControl control({.first = 0.1, .minimum = 1e-6, .maximum = 0.1, .fixed = true});
  Vector sizes;
  double time = 0;
  while (time < 1) {
    const time::Step step = control.next(time, 1);
    // Around 0.43 nothing longer than 0.02 can be solved.
    if (time < 0.43 && step.end_time > 0.43 && step.size > 0.02) {
      EXPECT_EQ(control.solve_failed(), Verdict::retry);
      continue;
    }
    EXPECT_EQ(control.judge(0, 0), Verdict::accept);
    sizes.push_back(step.size);
    time = step.end_time;
  }
  EXPECT_EQ(time, 1);
  EXPECT_EQ(control.counts().rejected_by_solver, 2);
  // BDF2 bears growth of up to 1 + sqrt(2) (Grigorieff 1983), not that from 0.0125 to 0.1.
  ASSERT_EQ(sizes.size(), 4u + 8u + 4u + 2u + 3u);
  const auto wanted = [](std::size_t k) { return k < 4 ? 0.1 : k < 12 ? 0.0125 : k < 16 ? 0.025 : 0.05; };
  for (std::size_t k = 0; k < 18; ++k) EXPECT_NEAR(sizes[k], wanted(k), 1e-15) << "step " << k;
  // Equal to the last bit, also after the divided ones.
  for (std::size_t k = 18; k < sizes.size(); ++k) EXPECT_EQ(sizes[k], sizes[0]);
}

TEST(StepControl, RestartsWithTheFirstStep) {
  StepControl control({.first = 0.001, .minimum = 1e-6, .maximum = 1});
  const Vector sizes = steps_to(control, 0, 1, [](double) { return 0.01; });
  EXPECT_GT(sizes.back(), 0.1);
  control.restart();
  EXPECT_NEAR(control.next(1, 2).size, 0.001, 1e-15);
}

TEST(StepControl, HoldsItsPromisesForAnyErrorsAndStops) {
  constexpr unsigned seed = 20250218;
  std::mt19937 random(seed);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  const auto uniform = [&] { return std::generate_canonical<double, 53>(random); };
  for (int sample = 0; sample < 200; ++sample) {
    const StepOptions options{.first = 1e-3, .minimum = 1e-7, .maximum = 0.2};
    StepControl control(options);
    double time = 0, before = 0;
    for (int stops = 0; stops < 5; ++stops) {
      const double stop = time + std::pow(10, -3 * uniform());
      while (time < stop) {
        const time::Step step = control.next(time, stop);
        ASSERT_GT(step.size, 0);
        ASSERT_LE(step.size, options.maximum * (1 + 1e-9));
        ASSERT_LE(step.end_time, stop);
        if (before > 0) {
          ASSERT_LE(step.size, 2 * before * (1 + 1e-9));
        }
        const double draw = uniform(), error = std::pow(step.size / 0.02, 3) * (0.3 + 2 * uniform());
        const Verdict verdict =
            draw < 0.05 ? control.solve_failed() : control.judge(error, draw > 0.5 ? 2 : 1);
        ASSERT_NE(verdict, Verdict::give_up);
        if (verdict == Verdict::retry) {
          ASSERT_LT(control.next(time, stop).size, step.size);
          continue;
        }
        time = step.end_time;
        before = step.size;
      }
      ASSERT_EQ(time, stop);
    }
  }
}

// The velocity v = d' of a follower d = u^2 jumps by h^2 when the step changes. Weighed by the step, it does
// not disturb the choice of steps.
TEST(StepControl, TakesTheVelocityOfAFollowerWhenItIsWeighedByTheStep) {
  const TimeProblem problem = {
      "follower",
      [](double t, const Vector& y, const Vector& rate) -> Vector {
        return {rate[0] + y[0] - std::sin(3 * t), y[1] - y[0] * y[0], y[2] - rate[1]};
      },
      {},
      3};
  const auto steps = [&](bool with_velocity) {
    Scheme scheme(Method::bdf2);
    scheme.start(0, {0, 0, 0}, {0, 0, 0});
    StepControl control(adaptive());
    Vector y, error(3);
    while (scheme.time() < 4) {
      const time::Step step = control.next(scheme.time(), 4);
      scheme.begin(step);
      EXPECT_TRUE(solve_stage(problem, scheme, y));
      scheme.error(y, error);
      double norm = std::max(std::abs(error[0]), std::abs(error[1]));
      if (with_velocity) norm = std::max(norm, step.size * std::abs(error[2]));
      if (control.judge(norm / 1e-6, scheme.error_order()) == Verdict::accept) scheme.accept(y);
    }
    return static_cast<double>(control.counts().accepted + control.counts().rejected_by_error);
  };
  EXPECT_NEAR(steps(true) / steps(false), 1, 0.05);
}

TEST(StepControl, RefusesWhatMakesNoSense) {
  EXPECT_THROW(StepControl({.first = 0, .minimum = 0, .maximum = 1}), std::logic_error);
  EXPECT_THROW(StepControl({.first = 2, .minimum = 0.1, .maximum = 1}), std::logic_error);
  EXPECT_THROW(StepControl({.first = 0.01, .minimum = 0.1, .maximum = 1}), std::logic_error);
  EXPECT_THROW(StepControl({.first = 0.1, .minimum = 0.01, .maximum = 1, .growth = 1.2}), std::logic_error);
  StepControl control(adaptive());
  EXPECT_THROW(control.next(1, 1), std::logic_error);
  EXPECT_THROW(control.next(1, INFINITY), std::logic_error);
}
