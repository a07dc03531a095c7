// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/scheme.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/support/time_problems.hpp"

using namespace tunica;
using namespace tunica::test_support;
using time::Method;
using time::Scheme;

namespace {

constexpr unsigned seed = 20250217;

struct Chosen {
  std::string name;
  Method method;
  double radius;
  double order;
};

const std::vector<Chosen> methods = {{"bdf2", Method::bdf2, 0, 2},
                                     {"euler", Method::backward_euler, 0, 1},
                                     {"alpha00", Method::generalized_alpha, 0, 2},
                                     {"alpha05", Method::generalized_alpha, 0.5, 2},
                                     {"alpha10", Method::generalized_alpha, 1, 2}};

double largest(const Vector& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

Vector difference(const Vector& a, const Vector& b) {
  Vector result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] - b[i];
  return result;
}

/// Slope of log(error) against log(1/count), by least squares.
double observed_order(const std::vector<int>& counts, const Vector& errors) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(counts.size());
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double a = -std::log(counts[k]), b = std::log(errors[k]);
    x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

void take_step(const TimeProblem& problem, Scheme& scheme, double step) {
  Vector y;
  scheme.begin(step);
  ASSERT_TRUE(solve_stage(problem, scheme, y)) << problem.name << " at " << scheme.time();
  scheme.accept(y);
}

constexpr double begin_time = 0.2, length = 2;

Scheme started(const TimeProblem& problem, const Chosen& chosen) {
  Scheme scheme(chosen.method, chosen.radius);
  scheme.start(begin_time, problem.solution(begin_time), rate_of_solution(problem, begin_time));
  return scheme;
}

/// Largest errors in the second half of the run: of entries with a rate, of those without, and between the
/// steps.
struct Errors {
  double differential = 0, algebraic = 0, between = 0;
};

Errors errors_of_run(const TimeProblem& problem, const Chosen& chosen, const Vector& steps) {
  Scheme scheme = started(problem, chosen);
  Errors errors;
  Vector inside(scheme.value().size());
  for (const double step : steps) {
    take_step(problem, scheme, step);
    if (scheme.time() < begin_time + length / 2) continue;
    const Vector error = difference(scheme.value(), problem.solution(scheme.time()));
    for (std::size_t i = 0; i < error.size(); ++i) {
      double& worst = i < problem.differential ? errors.differential : errors.algebraic;
      worst = std::max(worst, std::abs(error[i]));
    }
    for (const double part : {0.25, 0.5, 0.75}) {
      const double t = scheme.time() - part * step;
      scheme.interpolate(t, inside);
      const Vector exact = problem.solution(t);
      for (std::size_t i = 0; i < problem.differential; ++i)
        errors.between = std::max(errors.between, std::abs(inside[i] - exact[i]));
    }
  }
  return errors;
}

struct Orders {
  double differential, algebraic, between;
};

Orders orders(const TimeProblem& problem, const Chosen& chosen, bool irregular) {
  const std::vector<int> counts = {80, 160, 320, 640, 1280};
  std::mt19937 random(seed);
  Vector differential, algebraic, between;
  for (const int count : counts) {
    const Errors errors =
        errors_of_run(problem, chosen, step_sequence(length, count, irregular ? &random : nullptr));
    differential.push_back(errors.differential);
    algebraic.push_back(errors.algebraic);
    between.push_back(errors.between);
  }
  return {observed_order(counts, differential), observed_order(counts, algebraic),
          observed_order(counts, between)};
}

std::ostream& operator<<(std::ostream& out, const Chosen& chosen) {
  return out << chosen.name;
}

class SchemeOrder : public testing::TestWithParam<Chosen> {};
class AnyScheme : public testing::TestWithParam<Chosen> {};

std::string name_of(const testing::TestParamInfo<Chosen>& info) {
  return info.param.name;
}

/// What a scheme remembers at `time` when all of its past is exact, the last steps having been `steps` (the
/// latest first). Under generalized alpha the rates belong to times that are shifted by `shift` steps.
Scheme::Saved exact_past(const TimeProblem& problem, double time, std::array<double, 2> steps,
                         double shift = 0) {
  Scheme::Saved saved;
  saved.time = time;
  saved.steps = 2;
  saved.step_sizes = steps;
  saved.rate_offsets = {shift * steps[0], shift * steps[1]};
  const double before = time - steps[0];
  saved.values = {problem.solution(time), problem.solution(before), problem.solution(before - steps[1])};
  saved.rates = {rate_of_solution(problem, time + saved.rate_offsets[0]),
                 rate_of_solution(problem, before + saved.rate_offsets[1])};
  return saved;
}

/// y' = 2t, which methods of second order follow without error.
TimeProblem parabola() {
  return {"parabola", [](double t, const Vector&, const Vector& rate) -> Vector { return {rate[0] - 2 * t}; },
          [](double t) -> Vector { return {t * t}; }, 1};
}

/// y' = A y, a damped turn.
constexpr double damping = 0.3, turn = 2;
TimeProblem damped_turn() {
  return {"turn",
          [](double, const Vector& y, const Vector& rate) -> Vector {
            return {rate[0] + damping * y[0] + turn * y[1], rate[1] + damping * y[1] - turn * y[0]};
          },
          [](double t) -> Vector {
            const double size = std::exp(-damping * t);
            return {size * std::cos(turn * t), size * std::sin(turn * t)};
          },
          2};
}

/// The oscillator x' = w v, v' = -w x, whose stages are solved exactly: one step of generalized alpha as a
/// matrix on (x, v, h rate of x, h rate of v).
Eigen::Matrix4d step_matrix(double frequency, double radius) {
  Eigen::Matrix4d matrix;
  for (int k = 0; k < 4; ++k) {
    Vector start(4, 0.0);
    start[k] = 1;
    Scheme::Saved saved;
    saved.steps = 2;
    saved.step_sizes = {1, 1};
    const double shift = (radius - 1) / (2 * (1 + radius));
    saved.rate_offsets = {shift, shift};
    saved.values.assign(3, {start[0], start[1]});
    saved.rates.assign(2, {start[2], start[3]});
    Scheme scheme(Method::generalized_alpha, radius);
    scheme.restore(saved);
    const double c = scheme.begin(1).coefficient;
    // c x + a = w v, c v + b = -w x.
    const double a = scheme.history()[0], b = scheme.history()[1], w = frequency;
    const double d = c * c + w * w;
    scheme.accept(Vector{-(c * a + w * b) / d, (w * a - c * b) / d});
    for (int i = 0; i < 2; ++i) {
      matrix(i, k) = scheme.value()[i];
      matrix(i + 2, k) = scheme.rate()[i];
    }
  }
  return matrix;
}

TEST(ExpectedValues, AreLinesThroughTheLastTwo) {
  for (const Chosen& chosen : methods) {
    SCOPED_TRACE(chosen.name);
    Scheme scheme(chosen.method, chosen.radius);
    // A line and a parabola, of which bdf2 has the rates without error.
    const auto exact = [](double t) { return Vector{1 + 2 * t, t * t}; };
    scheme.start(0, exact(0), {2, 0});
    double before = 0, time = 0;
    for (const double step : {0.1, 0.15, 0.08, 0.2}) {
      const double at = scheme.begin(step).time;
      Vector values(2), rates(1), all_rates(2);
      scheme.expect(values, rates);
      scheme.expect(values, all_rates);
      EXPECT_NEAR(values[0], 1 + 2 * at, 1e-14);
      EXPECT_NEAR(rates[0], 2, 1e-12);
      EXPECT_EQ(rates[0], all_rates[0]);
      if (time > 0 && chosen.method != Method::generalized_alpha) {
        EXPECT_NEAR(values[1], time * time + (at - time) * (time + before), 1e-14);
      }
      if (before > 0.1 && chosen.method == Method::bdf2) {
        EXPECT_NEAR(all_rates[1], 2 * at, 1e-12);
      }
      scheme.accept(exact(at));
      before = time;
      time = scheme.time();
    }
  }
}

}  // namespace

// The tolerance 0.1 leaves room for higher terms at the coarse end and for the scatter of drawn steps.

TEST_P(SchemeOrder, OnAnOrdinaryDifferentialEquation) {
  for (const bool irregular : {false, true}) {
    SCOPED_TRACE(testing::Message() << (irregular ? "irregular steps, seed " : "equal steps, seed ") << seed);
    const Orders seen = orders(nonlinear_ode(), GetParam(), irregular);
    EXPECT_NEAR(seen.differential, GetParam().order, 0.1);
    EXPECT_NEAR(seen.between, GetParam().order, 0.1);
  }
}

TEST_P(SchemeOrder, OnAConstraintOfIndexOne) {
  for (const bool irregular : {false, true}) {
    SCOPED_TRACE(testing::Message() << (irregular ? "irregular steps, seed " : "equal steps, seed ") << seed);
    const Orders seen = orders(index_one(), GetParam(), irregular);
    EXPECT_NEAR(seen.differential, GetParam().order, 0.1);
    EXPECT_NEAR(seen.algebraic, GetParam().order, 0.1);
    EXPECT_NEAR(seen.between, GetParam().order, 0.1);
  }
}

TEST_P(SchemeOrder, OnAConstraintOfIndexTwo) {
  for (const bool irregular : {false, true}) {
    SCOPED_TRACE(testing::Message() << (irregular ? "irregular steps, seed " : "equal steps, seed ") << seed);
    const Orders seen = orders(index_two(), GetParam(), irregular);
    EXPECT_NEAR(seen.differential, GetParam().order, 0.1);
    // The force of the rod loses an order where steps change and what they leave behind decays slowly.
    if (irregular && GetParam().method == Method::generalized_alpha && GetParam().radius > 0) continue;
    EXPECT_NEAR(seen.algebraic, GetParam().order, 0.1);
  }
}

// With radius 1 nothing damps what the constraints' entries start with: another set of cases.
INSTANTIATE_TEST_SUITE_P(Time, SchemeOrder, testing::ValuesIn(methods.begin(), methods.end() - 1), name_of);

TEST(GeneralizedAlpha, IsOfSecondOrderWithoutDamping) {
  for (const bool irregular : {false, true}) {
    SCOPED_TRACE(testing::Message() << (irregular ? "irregular steps, seed " : "equal steps, seed ") << seed);
    EXPECT_NEAR(orders(nonlinear_ode(), methods.back(), irregular).differential, 2, 0.1);
  }
}

TEST(GeneralizedAlpha, LosesAnOrderOfIndexTwoAfterAChangeOfStepUntilItHasDecayed) {
  const std::vector<int> counts = {80, 160, 320, 640};
  Vector at_once, later;
  for (const int count : counts) {
    const TimeProblem problem = index_two();
    Scheme scheme = started(problem, methods[3]);
    const double step = length / count;
    const auto error = [&] {
      return std::abs(scheme.value().back() - problem.solution(scheme.time()).back());
    };
    for (int k = 0; k < count / 2; ++k) take_step(problem, scheme, step);
    take_step(problem, scheme, step / 2);
    at_once.push_back(error());
    double worst = 0;
    for (int k = 1; k < count; ++k) {
      take_step(problem, scheme, step / 2);
      // By then n 0.5^n is less than 1e-10.
      if (k > count / 2) worst = std::max(worst, error());
    }
    later.push_back(worst);
  }
  EXPECT_NEAR(observed_order(counts, at_once), 1, 0.1);
  EXPECT_NEAR(observed_order(counts, later), 2, 0.1);
}

TEST(GeneralizedAlpha, HasTheTextbookCoefficientsWithEqualSteps) {
  for (const double rho : {0.0, 0.3, 0.5, 1.0}) {
    Scheme scheme(Method::generalized_alpha, rho);
    scheme.start(0, {1.5}, {0.7});
    const double h = 0.1, am = (3 - rho) / (2 * (1 + rho)), af = 1 / (1 + rho), g = 0.5 + am - af;
    scheme.begin(h);
    scheme.accept(Vector{1.52});
    const double y = scheme.value()[0], r = scheme.rate()[0];
    const time::Stage stage = scheme.begin(h);
    EXPECT_NEAR(stage.time, h + af * h, 1e-15);
    const double y_stage = 1.61, r_stage = stage.coefficient * y_stage + scheme.history()[0];
    scheme.accept(Vector{y_stage});
    const double Y = scheme.value()[0], R = scheme.rate()[0];
    // The method's three equations; rounding of numbers of size 10.
    EXPECT_NEAR(y_stage, y + af * (Y - y), 1e-13);
    EXPECT_NEAR(r_stage, r + am * (R - r), 1e-13);
    EXPECT_NEAR(Y, y + h * ((1 - g) * r + g * R), 1e-13);
  }
}

TEST(GeneralizedAlpha, DampsInfiniteFrequenciesByItsRadius) {
  for (const double rho : {0.0, 0.25, 0.5, 0.8, 1.0}) {
    Scheme scheme(Method::generalized_alpha, rho);
    scheme.start(0, {1.0}, {0.0});
    // F = y, the limit of y' = -k y: y* = 0, whatever the steps.
    for (const double step : {0.1, 0.1, 0.37, 0.02}) {
      const double before = scheme.value()[0];
      scheme.begin(step);
      scheme.accept(Vector{0.0});
      EXPECT_NEAR(scheme.value()[0], -rho * before, 1e-15);
    }
    // Equal steps damp the rate alike, once y has gone.
    Scheme::Saved saved = scheme.save();
    saved.step_sizes = {0.1, 0.1};
    const double shift = (rho - 1) / (2 * (1 + rho));
    saved.rate_offsets = {shift * 0.1, shift * 0.1};
    saved.values.assign(3, {0.0});
    saved.rates.assign(2, {1.0});
    scheme.restore(saved);
    scheme.begin(0.1);
    scheme.accept(Vector{0.0});
    EXPECT_NEAR(scheme.rate()[0], -rho, 1e-14);
  }
}

TEST(GeneralizedAlpha, IsStableForAllFrequencies) {
  for (const double rho : {0.0, 0.25, 0.5, 0.8, 1.0}) {
    double radius = 0;
    for (double frequency = 1e-3; frequency < 1e9; frequency *= 1.3) {
      radius = step_matrix(frequency, rho).eigenvalues().cwiseAbs().maxCoeff();
      EXPECT_LE(radius, 1 + 1e-7) << "radius " << rho << ", frequency " << frequency;
    }
    // Double eigenvalues are found to the root of rounding.
    EXPECT_NEAR(radius, rho, 1e-4);
  }
}

TEST(GeneralizedAlpha, IsBdf2WhenItsRadiusIsZero) {
  std::mt19937 random(seed);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  const TimeProblem problem = nonlinear_ode();
  Scheme alpha = started(problem, methods[2]);
  const Vector steps = step_sequence(2, 40, &random);
  for (int k = 0; k < 4; ++k) take_step(problem, alpha, steps[k]);
  Scheme bdf2(Method::bdf2);
  bdf2.restore(alpha.save());
  for (int k = 4; k < 40; ++k) {
    take_step(problem, alpha, steps[k]);
    take_step(problem, bdf2, steps[k]);
    // Rounding, and Newton's tolerance, of 36 steps.
    EXPECT_LT(largest(difference(alpha.value(), bdf2.value())), 1e-12);
  }
}

TEST(Scheme, SecondOrderFollowsAParabolaForAnySteps) {
  const TimeProblem problem = parabola();
  std::mt19937 random(seed);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  const Vector steps = step_sequence(2, 50, &random);
  for (const Chosen& chosen : methods) {
    if (chosen.order < 2) continue;
    SCOPED_TRACE(chosen.name);
    Scheme scheme = started(problem, chosen);
    if (chosen.method == Method::bdf2) scheme.restore(exact_past(problem, begin_time, {0.03, 0.02}));
    for (const double step : steps) {
      take_step(problem, scheme, step);
      // The rate at the start comes from a difference good to 1e-12.
      EXPECT_NEAR(scheme.value()[0], scheme.time() * scheme.time(), 1e-11);
      EXPECT_NEAR(scheme.rate()[0], 2 * (scheme.time() + scheme.rate_offset()), 1e-10);
    }
  }
}

TEST_P(AnyScheme, LeavesWhatRestsAtRest) {
  std::mt19937 random(seed);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  Scheme scheme(GetParam().method, GetParam().radius);
  scheme.start(0, {0.1, -1e5, 3e-7});
  const Vector rest = scheme.value();
  for (const double step : step_sequence(1, 20, &random)) {
    const double c = scheme.begin(step).coefficient;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      EXPECT_EQ(scheme.prediction()[i], rest[i]);
      EXPECT_EQ(c * rest[i] + scheme.history()[i], 0);
    }
    scheme.accept(rest);
    EXPECT_EQ(scheme.value(), rest);
  }
}

TEST_P(AnyScheme, EqualStepsHaveEqualCoefficientsAndEndWhereTheyAreToldTo) {
  Scheme scheme(GetParam().method, GetParam().radius);
  scheme.start(0, {1.0});
  double coefficient = 0;
  for (int k = 1; k <= 30; ++k) {
    const time::Stage stage = scheme.begin({0.1, k / 10.0});
    if (k > 3) {
      EXPECT_EQ(stage.coefficient, coefficient);
    }
    coefficient = stage.coefficient;
    scheme.accept(Vector{1.0});
    EXPECT_EQ(scheme.time(), k / 10.0);
  }
}

TEST_P(AnyScheme, ARejectedStepLeavesNoTrace) {
  const TimeProblem problem = nonlinear_ode();
  Scheme plain = started(problem, GetParam()), retried = started(problem, GetParam());
  for (int k = 0; k < 5; ++k) {
    Vector y, error(3);
    retried.begin(0.08);
    ASSERT_TRUE(solve_stage(problem, retried, y));
    if (retried.has_error_estimate()) retried.error(y, error);
    take_step(problem, plain, 0.05);
    take_step(problem, retried, 0.05);
    EXPECT_EQ(plain.value(), retried.value());
    EXPECT_EQ(plain.rate(), retried.rate());
  }
}

TEST_P(AnyScheme, ResumesBitwise) {
  const TimeProblem problem = index_two();
  std::mt19937 random(seed);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  const Vector steps = step_sequence(1, 12, &random);
  for (std::size_t stop = 0; stop < 6; ++stop) {
    Scheme scheme = started(problem, GetParam());
    for (std::size_t k = 0; k < stop; ++k) take_step(problem, scheme, steps[k]);
    Scheme resumed(GetParam().method, GetParam().radius);
    resumed.restore(scheme.save());
    for (std::size_t k = stop; k < steps.size(); ++k) {
      Vector y, error(5), resumed_error(5);
      scheme.begin(steps[k]);
      resumed.begin(steps[k]);
      ASSERT_TRUE(solve_stage(problem, scheme, y));
      scheme.error(y, error);
      resumed.error(y, resumed_error);
      EXPECT_EQ(error, resumed_error);
      EXPECT_EQ(Vector(scheme.prediction().begin(), scheme.prediction().end()),
                Vector(resumed.prediction().begin(), resumed.prediction().end()));
      scheme.accept(y);
      take_step(problem, resumed, steps[k]);
      EXPECT_EQ(scheme.value(), resumed.value());
      EXPECT_EQ(scheme.rate(), resumed.rate());
      EXPECT_EQ(scheme.time(), resumed.time());
      Vector inside(5), resumed_inside(5);
      scheme.interpolate(scheme.time() - 0.4 * steps[k], inside);
      resumed.interpolate(scheme.time() - 0.4 * steps[k], resumed_inside);
      EXPECT_EQ(inside, resumed_inside);
    }
  }
}

TEST_P(AnyScheme, InterpolationIsContinuousAndStaysWithinTheStep) {
  const TimeProblem problem = nonlinear_ode();
  std::mt19937 random(seed);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  Scheme scheme = started(problem, GetParam());
  Vector inside(3);
  for (const double step : step_sequence(2, 20, &random)) {
    const Vector before = scheme.value();
    const double t = scheme.time();
    take_step(problem, scheme, step);
    scheme.interpolate(t, inside);
    EXPECT_LT(largest(difference(inside, before)), 1e-14);
    scheme.interpolate(scheme.time(), inside);
    EXPECT_EQ(inside, scheme.value());
    EXPECT_THROW(scheme.interpolate(t - 0.01 * step, inside), std::logic_error);
    EXPECT_THROW(scheme.interpolate(scheme.time() + 0.01 * step, inside), std::logic_error);
  }
}

// A polynomial of degree k differs from the solution by h^(k+1).
TEST_P(AnyScheme, InterpolatesAndPredictsToOneOrderMoreThanItSteps) {
  const TimeProblem problem = nonlinear_ode();
  const std::vector<int> counts = {50, 100, 200, 400};
  Vector between, ahead;
  for (const int count : counts) {
    const double h = 1.0 / count;
    Scheme scheme(GetParam().method, GetParam().radius);
    scheme.restore(exact_past(problem, 1, {h, 0.7 * h}));
    Vector inside(3);
    scheme.interpolate(1 - 0.4 * h, inside);
    between.push_back(largest(difference(inside, problem.solution(1 - 0.4 * h))));
    scheme.begin(1.3 * h);
    const Vector guess(scheme.prediction().begin(), scheme.prediction().end());
    ahead.push_back(largest(difference(guess, problem.solution(scheme.stage().time))));
  }
  EXPECT_NEAR(observed_order(counts, between), GetParam().order + 1, 0.1);
  EXPECT_NEAR(observed_order(counts, ahead), GetParam().order + 1, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Time, AnyScheme, testing::ValuesIn(methods), name_of);

// The estimate is made in a run with all its errors; the true local error in a step from exact values.
TEST(ErrorEstimate, ApproachesTheLocalErrorForIrregularSteps) {
  const TimeProblem problem = nonlinear_ode();
  for (const Chosen& chosen : {methods[0], methods[1]}) {
    SCOPED_TRACE(testing::Message() << chosen.name << ", seed " << seed);
    const std::vector<int> counts = {80, 160, 320};
    Vector deviations;
    for (const int count : counts) {
      std::mt19937 random(seed);
      const Vector steps = step_sequence(length, count, &random);
      Scheme scheme = started(problem, chosen);
      double deviation = 0;
      for (std::size_t k = 0; k < steps.size(); ++k) {
        Vector y, estimate(3);
        if (k > 3) {
          Scheme exact(chosen.method);
          exact.restore(exact_past(problem, scheme.time(), {steps[k - 1], steps[k - 2]}));
          take_step(problem, exact, steps[k]);
          const Vector truth = difference(exact.value(), problem.solution(exact.time()));
          scheme.begin(steps[k]);
          ASSERT_TRUE(solve_stage(problem, scheme, y));
          scheme.error(y, estimate);
          deviation = std::max(deviation, largest(difference(estimate, truth)) / largest(truth));
        }
        take_step(problem, scheme, steps[k]);
      }
      deviations.push_back(deviation);
    }
    // The next term of the error is smaller by one order; it is the deviation.
    EXPECT_NEAR(observed_order(counts, deviations), 1, 0.1);
    EXPECT_LT(deviations.back(), 0.05);
  }
}

TEST(ErrorEstimate, OfGeneralizedAlphaApproachesTheLocalErrorOfLinearSystems) {
  const TimeProblem problem = damped_turn();
  for (const Chosen& chosen : {methods[2], methods[3], methods[4]}) {
    SCOPED_TRACE(chosen.name);
    const std::vector<int> counts = {200, 400, 800};
    Vector deviations;
    for (const int count : counts) {
      const double h = length / count;
      Scheme scheme = started(problem, chosen);
      double deviation = 0;
      for (int k = 0; k < count; ++k) {
        const Vector from = scheme.value();
        Vector y, estimate(2);
        scheme.begin(h);
        ASSERT_TRUE(solve_stage(problem, scheme, y));
        scheme.error(y, estimate);
        scheme.accept(y);
        // The exact solution from where the step began.
        const Vector flow = problem.solution(h);
        const Vector truth = difference(
            scheme.value(), {flow[0] * from[0] - flow[1] * from[1], flow[1] * from[0] + flow[0] * from[1]});
        if (k > 50) deviation = std::max(deviation, largest(difference(estimate, truth)) / largest(truth));
      }
      deviations.push_back(deviation);
    }
    EXPECT_NEAR(observed_order(counts, deviations), 1, 0.1);
    EXPECT_LT(deviations.back(), 0.05);
  }
}

TEST(ErrorEstimate, NeedsRatesOfThePast) {
  const auto orders_of_steps = [](Method method, Vector rate) {
    Scheme scheme(method, 0.5);
    scheme.start(0, {1.0}, std::move(rate));
    std::vector<std::pair<int, int>> orders;
    for (int k = 0; k < 4; ++k) {
      const int step_order = scheme.begin(0.1).order;
      EXPECT_EQ(scheme.has_error_estimate(), scheme.error_order() > 0);
      Vector error(1);
      if (!scheme.has_error_estimate()) {
        EXPECT_THROW(scheme.error(Vector{1.0}, error), std::logic_error);
      }
      orders.emplace_back(step_order, scheme.error_order());
      scheme.accept(Vector{1.0});
    }
    return orders;
  };
  using Expected = std::vector<std::pair<int, int>>;
  EXPECT_EQ(orders_of_steps(Method::backward_euler, {}), (Expected{{1, 0}, {1, 1}, {1, 1}, {1, 1}}));
  EXPECT_EQ(orders_of_steps(Method::backward_euler, {0.0}), (Expected{{1, 1}, {1, 1}, {1, 1}, {1, 1}}));
  EXPECT_EQ(orders_of_steps(Method::bdf2, {}), (Expected{{1, 0}, {2, 1}, {2, 2}, {2, 2}}));
  EXPECT_EQ(orders_of_steps(Method::bdf2, {0.0}), (Expected{{1, 1}, {2, 2}, {2, 2}, {2, 2}}));
  EXPECT_EQ(orders_of_steps(Method::generalized_alpha, {}), (Expected{{1, 0}, {2, 1}, {2, 2}, {2, 2}}));
  EXPECT_EQ(orders_of_steps(Method::generalized_alpha, {0.0}), (Expected{{2, 1}, {2, 2}, {2, 2}, {2, 2}}));
}

TEST(Scheme, RefusesWhatMakesNoSense) {
  EXPECT_THROW(Scheme(Method::generalized_alpha, 1.1), std::logic_error);
  EXPECT_THROW(Scheme(Method::generalized_alpha, -0.1), std::logic_error);
  Scheme scheme(Method::bdf2);
  EXPECT_THROW(scheme.start(0, {1, 2}, {1}), std::logic_error);
  scheme.start(0, {1, 2});
  EXPECT_THROW(scheme.begin(0.0), std::logic_error);
  EXPECT_THROW(scheme.begin(NAN), std::logic_error);
  EXPECT_THROW(scheme.accept(Vector{1, 2}), std::logic_error);
}
