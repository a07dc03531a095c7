// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/periodic_curve.hpp"

#include <gsl/gsl_interp.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <utility>

#include "core/gsl.hpp"

namespace tunica {

namespace {

/// Of the samples' range: far below what anybody sees, above the last digit of printed samples, whose
/// rounding is no shape to be kept.
constexpr double not_seen = 1e-4;

double sign(double value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

}  // namespace

PeriodicCurve::PeriodicCurve(std::vector<double> time, std::vector<double> value)
    : time_(std::move(time)), value_(std::move(value)) {
  value_.back() = value_.front();
  slope_ = spline_slopes();
  const auto [low, high] = std::minmax_element(value_.begin(), value_.end());
  const double unseen = not_seen * (*high - *low);
  std::vector<bool> is_limited(intervals());
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < intervals(); ++i) open.push_back(i);
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    if (!leaves_samples(i, unseen)) continue;
    for (const std::size_t end : {i, behind(i)}) {
      if (is_limited[end]) continue;
      is_limited[end] = true;
      ++limited_;
      slope_[end] = steffen_slope(end);
      open.push_back(before(end));
      open.push_back(end);
    }
  }
}

double PeriodicCurve::at(double time) const {
  const double period = time_.back() - time_.front();
  double within = std::fmod(time - time_.front(), period);
  if (within < 0) within += period;
  within += time_.front();
  const auto next = std::upper_bound(time_.begin() + 1, time_.end() - 1, within);
  const auto i = static_cast<std::size_t>(next - time_.begin()) - 1;
  return cubic(i, (within - time_[i]) / width(i));
}

double PeriodicCurve::secant(std::size_t interval) const {
  return (value_[interval + 1] - value_[interval]) / width(interval);
}

std::size_t PeriodicCurve::before(std::size_t interval) const {
  return (interval + intervals() - 1) % intervals();
}

std::size_t PeriodicCurve::behind(std::size_t interval) const {
  return (interval + 1) % intervals();
}

std::vector<double> PeriodicCurve::spline_slopes() const {
  let_gsl_return_codes();
  const std::unique_ptr<gsl_interp, decltype(&gsl_interp_free)> spline(
      gsl_interp_alloc(gsl_interp_cspline_periodic, time_.size()), &gsl_interp_free);
  if (!spline) throw std::bad_alloc();
  check_gsl(gsl_interp_init(spline.get(), time_.data(), value_.data(), time_.size()), "gsl_interp_init");
  std::vector<double> slopes(intervals());
  for (std::size_t i = 0; i < intervals(); ++i)
    check_gsl(
        gsl_interp_eval_deriv_e(spline.get(), time_.data(), value_.data(), time_[i], nullptr, &slopes[i]),
        "gsl_interp_eval_deriv");
  return slopes;
}

double PeriodicCurve::steffen_slope(std::size_t interval) const {
  const std::size_t last = before(interval);
  const double left = secant(last), right = secant(interval);
  const double parabola = (left * width(interval) + right * width(last)) / (width(last) + width(interval));
  return (sign(left) + sign(right)) * std::min({std::abs(left), std::abs(right), 0.5 * std::abs(parabola)});
}

double PeriodicCurve::cubic(std::size_t interval, double part) const {
  const double rise = value_[interval + 1] - value_[interval];
  const double first = slope_[interval] * width(interval), last = slope_[behind(interval)] * width(interval);
  return value_[interval] +
         part * (first + part * (3 * rise - 2 * first - last + part * (first + last - 2 * rise)));
}

/// What a curve may turn beyond the outermost sample of an interval, from which samples fall by `fall` in the
/// interval `outside` it. A parabola turns by at most fall h^2 / (4 g (g + h)), h and g the widths; an
/// interval far wider than the one outside says nothing about what is in it.
double PeriodicCurve::allowance(double fall, std::size_t interval, std::size_t outside) const {
  const double h = width(interval), g = width(outside);
  constexpr double margin = 2, widest = 2;
  return fall > 0 && h <= widest * g ? margin * fall * h * h / (4 * g * (g + h)) : 0.0;
}

bool PeriodicCurve::leaves_samples(std::size_t interval, double unseen) const {
  const std::size_t last = before(interval), next = behind(interval);
  const double a = value_[interval], b = value_[interval + 1];
  const double first_fall = a - value_[last], next_fall = b - value_[next + 1];
  // Places where the cubic's derivative p + q x + r x^2 vanishes.
  const double rise = b - a, p = slope_[interval] * width(interval), end = slope_[next] * width(interval);
  const double q = 2 * (3 * rise - 2 * p - end), r = 3 * (p + end - 2 * rise);
  const double discriminant = q * q - 4 * p * r;
  if (discriminant < 0) return false;
  const double root = -0.5 * (q + std::copysign(std::sqrt(discriminant), q));
  for (const double part : {root / r, p / root}) {
    if (!(part > 0 && part < 1)) continue;
    const double value = cubic(interval, part);
    for (const double up : {1.0, -1.0}) {
      const double beyond = up * value - std::max(up * a, up * b);
      double allowed = INFINITY;
      if (up * a >= up * b) allowed = allowance(up * first_fall, interval, last);
      if (up * b >= up * a) allowed = std::min(allowed, allowance(up * next_fall, interval, next));
      if (beyond > std::max(allowed, unseen)) return true;
    }
  }
  return false;
}

}  // namespace tunica
