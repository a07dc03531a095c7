// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "core/time/scheme.hpp"

namespace tunica::test_support {

using Vector = std::vector<double>;

/// F(y, dy/dt, t) = 0 with a known solution.
struct TimeProblem {
  std::string name;
  std::function<Vector(double t, const Vector& y, const Vector& rate)> residual;
  std::function<Vector(double t)> solution;
  std::size_t differential;  ///< the first entries have a rate in F, the others have none
};

/// Central difference, accurate to about 1e-10 for solutions of unit size and time scale.
inline Vector rate_of_solution(const TimeProblem& problem, double t) {
  const double d = 1e-3;
  const auto at = [&](double s) { return problem.solution(t + s * d); };
  const Vector a = at(1), b = at(-1), e = at(2), f = at(-2), g = at(3), h = at(-3);
  Vector rate(a.size());
  for (std::size_t i = 0; i < rate.size(); ++i)
    rate[i] = (45 * (a[i] - b[i]) - 9 * (e[i] - f[i]) + (g[i] - h[i])) / (60 * d);
  return rate;
}

/// u' = u^2 cos t with u = 1/(2 - sin t), and a forced oscillator x'' = -x^3 + ... with x = sin t.
inline TimeProblem nonlinear_ode() {
  return {"ode",
          [](double t, const Vector& y, const Vector& rate) -> Vector {
            const double s = std::sin(t);
            return {rate[0] - y[0] * y[0] * std::cos(t), rate[1] - y[2],
                    rate[2] + y[1] * y[1] * y[1] + s - s * s * s};
          },
          [](double t) -> Vector {
            return {1 / (2 - std::sin(t)), std::sin(t), std::cos(t)};
          },
          3};
}

/// y' = y z + a(t), 0 = z + z^3 - y - b(t), with y = 2 + sin t, z = cos(2t)/2.
inline TimeProblem index_one() {
  return {"index1",
          [](double t, const Vector& y, const Vector& rate) -> Vector {
            const double Y = 2 + std::sin(t), Z = std::cos(2 * t) / 2;
            return {rate[0] - y[0] * y[1] - std::cos(t) + Y * Z,
                    y[1] + y[1] * y[1] * y[1] - y[0] - (Z + Z * Z * Z - Y)};
          },
          [](double t) -> Vector {
            return {2 + std::sin(t), std::cos(2 * t) / 2};
          },
          1};
}

/// A driven pendulum at the angle a = sin t, held by the constraint on its velocity:
///   x' = v, v' = -l x + a'' k x, x . v = 0, with k a quarter turn and the force of the rod l = a'^2.
inline TimeProblem index_two() {
  return {"index2",
          [](double t, const Vector& y, const Vector& rate) -> Vector {
            const double drive = -std::sin(t);
            return {rate[0] - y[2], rate[1] - y[3], rate[2] + y[4] * y[0] + drive * y[1],
                    rate[3] + y[4] * y[1] - drive * y[0], y[0] * y[2] + y[1] * y[3]};
          },
          [](double t) -> Vector {
            const double a = std::sin(t), w = std::cos(t);
            return {std::cos(a), std::sin(a), -w * std::sin(a), w * std::cos(a), w * w};
          },
          4};
}

/// Solves the stage that the scheme has begun by Newton's method, to rounding. False when it fails.
inline bool solve_stage(const TimeProblem& problem, const time::Scheme& scheme, Vector& y) {
  const double t = scheme.stage().time, c = scheme.stage().coefficient;
  y.assign(scheme.prediction().begin(), scheme.prediction().end());
  const auto n = static_cast<Eigen::Index>(y.size());
  const auto residual = [&] {
    Vector rate(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) rate[i] = c * y[i] + scheme.history()[i];
    return problem.residual(t, y, rate);
  };
  double before = INFINITY;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Vector base = residual();
    Eigen::MatrixXd jacobian(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double kept = y[k], d = 1e-7 * std::max(1.0, std::abs(kept));
      y[k] = kept + d;
      const Vector moved = residual();
      y[k] = kept;
      for (Eigen::Index i = 0; i < n; ++i) jacobian(i, k) = (moved[i] - base[i]) / d;
    }
    const Eigen::VectorXd update =
        jacobian.fullPivLu().solve(Eigen::Map<const Eigen::VectorXd>(base.data(), n));
    for (Eigen::Index i = 0; i < n; ++i) y[i] -= update[i];
    const double size = update.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(size)) return false;
    if (size < 1e-15 || (size < 1e-11 && size >= before / 2)) return true;
    before = size;
  }
  return false;
}

/// `count` steps that add up to `length`: equal, or each drawn from 0.6 to 1.4 of the mean. The first is the
/// mean, for its error by backward Euler to fall regularly under refinement.
inline Vector step_sequence(double length, int count, std::mt19937* random) {
  const double mean = length / count;
  Vector steps(count, mean);
  if (!random) return steps;
  double sum = 0;
  for (int k = 1; k < count; ++k) sum += steps[k] = 0.6 + 0.8 * std::generate_canonical<double, 53>(*random);
  for (int k = 1; k < count; ++k) steps[k] *= (length - mean) / sum;
  return steps;
}

}  // namespace tunica::test_support
