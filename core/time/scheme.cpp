// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/scheme.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace tunica::time {

Scheme::Scheme(Method method, double spectral_radius) : method_(method) {
  if (!(spectral_radius >= 0 && spectral_radius <= 1))
    throw std::logic_error("time::Scheme: the spectral radius must lie in [0, 1]");
  const bool alpha = method == Method::generalized_alpha;
  const double rho = spectral_radius;
  af_ = alpha ? 1 / (1 + rho) : 1;
  shift_ = alpha ? (rho - 1) / (2 * (1 + rho)) : 0;
  error_constant_ = 1.0 / 12 - shift_ * shift_ + shift_ * (1 - 2 * (af_ - shift_)) / 2;
}

void Scheme::start(double time, std::vector<double> value, std::vector<double> rate) {
  time_ = time;
  steps_ = 0;
  step_sizes_ = {};
  rate_offsets_ = {};
  rate_given_ = !rate.empty();
  if (!rate_given_) rate.assign(value.size(), 0.0);
  if (rate.size() != value.size()) throw std::logic_error("time::Scheme: a rate for each value is needed");
  values_[0] = std::move(value);
  rates_[0] = std::move(rate);
  stage_ = {};
}

bool Scheme::first_order() const {
  if (method_ == Method::backward_euler) return true;
  return steps_ == 0 && (method_ == Method::bdf2 || !rate_given_);
}

int Scheme::known_rates() const {
  return std::min(2, steps_ + (rate_given_ ? 1 : 0));
}

const Stage& Scheme::begin(const Step& step) {
  const double h = step.size;
  if (!(h > 0)) throw std::logic_error("time::Scheme: a step must be positive");
  const std::vector<double>&y = values_[0], &r = rates_[0];
  const std::size_t size = y.size();
  history_.resize(size);
  stage_ = {h, step.end_time, step.end_time, 1 / h, first_order() ? 1 : 2};
  am_ = 1;
  if (first_order()) {
    for (std::size_t i = 0; i < size; ++i) history_[i] = -stage_.coefficient * y[i];
  } else if (method_ == Method::bdf2) {
    const double before = step_sizes_[0], past = h / (before * (h + before));
    stage_.coefficient = 1 / h + 1 / (h + before);
    // r* = c (y* - y_n) - past (y_n - y_(n-1)): differences first, so that a constant stays one.
    const std::vector<double>& older = values_[1];
    for (std::size_t i = 0; i < size; ++i)
      history_[i] = -stage_.coefficient * y[i] - past * (y[i] - older[i]);
  } else {
    const double offset = rate_offsets_[0], length = h + shift_ * h - offset;
    am_ = (af_ * h - offset) / length;
    const double g = (h / 2 - offset) / length;
    stage_.time = time_ + af_ * h;
    stage_.coefficient = am_ / (g * af_ * h);
    for (std::size_t i = 0; i < size; ++i) history_[i] = (1 - am_ / g) * r[i] - stage_.coefficient * y[i];
  }
  prediction_.resize(size);
  polynomial(stage_.order == 1 ? h : af_ * h, prediction_);
  return stage_;
}

int Scheme::degree() const {
  return std::min(steps_, method_ == Method::backward_euler ? 1 : 2);
}

void Scheme::polynomial(double ahead, std::span<double> out) const {
  const std::size_t size = values_[0].size();
  const std::vector<double>& y0 = values_[0];
  if (degree() == 0) {
    for (std::size_t i = 0; i < size; ++i) out[i] = y0[i] + ahead * rates_[0][i];
    return;
  }
  // Newton's form: y_n + x [y_n, y_(n-1)] + x (x + h') [y_n, y_(n-1), y_(n-2)].
  const double h1 = step_sizes_[0], h2 = step_sizes_[1];
  const std::vector<double>& y1 = values_[1];
  if (degree() == 1) {
    const double first = ahead / h1;
    for (std::size_t i = 0; i < size; ++i) out[i] = y0[i] + first * (y0[i] - y1[i]);
    return;
  }
  const std::vector<double>& y2 = values_[2];
  const double curved = ahead * (ahead + h1) / (h1 + h2);
  const double first = (ahead + curved) / h1, second = curved / h2;
  for (std::size_t i = 0; i < size; ++i) out[i] = y0[i] + first * (y0[i] - y1[i]) - second * (y1[i] - y2[i]);
}

void Scheme::expect(std::span<double> values, std::span<double> rates) const {
  const double ahead = stage_.time - time_;
  const std::vector<double>&y = values_[0], &r = rates_[0];
  if (steps_ > 0) {
    const double slope = ahead / step_sizes_[0];
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = y[i] + slope * (y[i] - values_[1][i]);
  } else {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = y[i] + ahead * r[i];
  }
  if (known_rates() < 2) {
    std::copy(r.begin(), r.begin() + static_cast<std::ptrdiff_t>(rates.size()), rates.begin());
    return;
  }
  const double past = step_sizes_[0] + rate_offsets_[0] - rate_offsets_[1];
  const double slope = (ahead - rate_offsets_[0]) / past;
  for (std::size_t i = 0; i < rates.size(); ++i) rates[i] = r[i] + slope * (r[i] - rates_[1][i]);
}

void Scheme::end_value(std::span<const double> stage_value, std::span<double> out) const {
  if (stage_.order == 1 || method_ == Method::bdf2) {
    std::copy(stage_value.begin(), stage_value.end(), out.begin());
    return;
  }
  const std::vector<double>& y = values_[0];
  for (std::size_t i = 0; i < y.size(); ++i) out[i] = y[i] + (stage_value[i] - y[i]) / af_;
}

double Scheme::end_rate_offset() const {
  return stage_.order == 1 || method_ == Method::bdf2 ? 0 : shift_ * stage_.step;
}

void Scheme::end_rate(std::span<const double> stage_value, std::span<double> out) const {
  // r* = r_n + am (r_(n+1) - r_n); exactly r* where am = 1.
  const double inverse = 1 / am_;
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = inverse * (stage_.coefficient * stage_value[i] + history_[i]) + (1 - inverse) * rates_[0][i];
}

int Scheme::error_order() const {
  return std::min({stage_.order, known_rates(), 2});
}

void Scheme::error(std::span<const double> stage_value, std::span<double> out) const {
  const int order = error_order();
  if (order == 0) throw std::logic_error("time::Scheme: no error estimate without a rate of the past");
  const double h = stage_.step, before = step_sizes_[0];
  const std::vector<double>&r0 = rates_[0], &r1 = rates_[1];
  const double latest = h + end_rate_offset() - rate_offsets_[0];  // between r_(n+1) and r_n
  end_rate(stage_value, out);
  if (order == 1) {
    const double factor = h * h / (2 * latest);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = factor * (out[i] - r0[i]);
    return;
  }
  const double past = before + rate_offsets_[0] - rate_offsets_[1];  // between r_n and r_(n-1)
  const double constant = method_ == Method::bdf2
                              ? h * h * (h + before) * (h + before) / (6 * (2 * h + before))
                              : error_constant_ * h * h * h;
  const double factor = 2 * constant / (latest + past);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = factor * ((out[i] - r0[i]) / latest - (r0[i] - r1[i]) / past);
}

void Scheme::accept(std::span<const double> stage_value) {
  if (!(stage_.step > 0)) throw std::logic_error("time::Scheme: no step was begun");
  const std::size_t size = values_[0].size();
  // The oldest vectors are overwritten before they become the latest, which still need the levels in place.
  values_.back().resize(size);
  rates_.back().resize(size);
  end_value(stage_value, values_.back());
  end_rate(stage_value, rates_.back());
  rate_offsets_ = {end_rate_offset(), rate_offsets_[0]};
  step_sizes_ = {stage_.step, step_sizes_[0]};
  std::rotate(values_.begin(), values_.end() - 1, values_.end());
  std::rotate(rates_.begin(), rates_.end() - 1, rates_.end());
  time_ = stage_.end_time;
  steps_ = std::min(steps_ + 1, 2);
  stage_.step = 0;
}

void Scheme::interpolate(double time, std::span<double> out) const {
  const double h1 = step_sizes_[0], back = time - time_;
  // Times that were added up may miss the ends by rounding.
  const double slack = 1e-9 * h1 + 1e-14 * std::abs(time_);
  if (back > slack || back < -h1 - slack)
    throw std::logic_error("time::Scheme: interpolation outside of the last step");
  polynomial(back, out);
}

Scheme::Saved Scheme::save() const {
  const std::size_t levels = std::min<std::size_t>(steps_ + 1, values_.size());
  const std::size_t rates = std::min<std::size_t>(steps_ + 1, rates_.size());
  return {time_,
          steps_,
          rate_given_,
          step_sizes_,
          rate_offsets_,
          {values_.begin(), values_.begin() + levels},
          {rates_.begin(), rates_.begin() + rates}};
}

void Scheme::restore(const Saved& saved) {
  time_ = saved.time;
  steps_ = saved.steps;
  rate_given_ = saved.rate_given;
  step_sizes_ = saved.step_sizes;
  rate_offsets_ = saved.rate_offsets;
  std::copy(saved.values.begin(), saved.values.end(), values_.begin());
  std::copy(saved.rates.begin(), saved.rates.end(), rates_.begin());
  stage_ = {};
}

}  // namespace tunica::time
