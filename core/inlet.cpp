// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/inlet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/periodic_curve.hpp"
#include "core/scene/waveform_file.hpp"

namespace tunica {

namespace {

/// Flow of the internal carotid artery over its mean, 1 + sum_k a_k cos(2 pi k t/T) + b_k sin(2 pi k t/T).
/// Coefficients: Baek, Jayaraman, Richardson and Karniadakis, J. R. Soc. Interface 7:967 (2010), the
/// waveform that the paper's authors use.
class CarotidFlow final : public Waveform {
 public:
  explicit CarotidFlow(double period) : period_(period) {}

  double at(double time) const override {
    static constexpr std::array<double, 7> cosine{-0.152001, -0.111619, 0.043304, 0.028871,
                                                  0.002098,  -0.027237, -0.000557};
    static constexpr std::array<double, 7> sine{0.129013, -0.031435, -0.086106, 0.028263,
                                                0.010177, 0.012160,  -0.026303};
    const double phase = 2 * std::numbers::pi * std::fmod(time, period_) / period_;
    // The real part of sum_k (a_k - i b_k) z^k with z = exp(i phase), by Horner's rule.
    const double c = std::cos(phase), s = std::sin(phase);
    double real = 0, imaginary = 0;
    for (std::size_t k = cosine.size(); k-- > 0;) {
      const double before = real + cosine[k], below = imaginary - sine[k];
      real = before * c - below * s;
      imaginary = before * s + below * c;
    }
    return 1 + real;
  }

 private:
  double period_;
};

class Constant final : public Waveform {
 public:
  double at(double) const override { return 1; }
};

/// 1 for a while at the beginning of each period, then 0.
class Pulse final : public Waveform {
 public:
  Pulse(double duration, double period) : duration_(duration), period_(period) {}
  double at(double time) const override { return std::fmod(time, period_) < duration_ ? 1 : 0; }
  std::vector<double> jumps() const override { return {0.0, duration_}; }

 private:
  double duration_, period_;
};

/// A curve through one period of samples.
class Sampled final : public Waveform {
 public:
  explicit Sampled(scene::WaveformFile file) : curve_(std::move(file.time), std::move(file.value)) {}
  double at(double time) const override { return curve_.at(time); }

 private:
  PeriodicCurve curve_;
};

}  // namespace

double Inlet::growth_at(double time) const {
  return time < ramp ? 0.5 * (1 - std::cos(std::numbers::pi * time / ramp)) : 1.0;
}

double Inlet::shape_at(double time) const {
  return growth_at(time) * shape->at(time);
}

std::vector<double> Inlet::jumps(double end) const {
  std::vector<double> times;
  for (const double within : shape->jumps())
    for (int beat = 0; beat * period + within < end; ++beat)
      if (const double time = beat * period + within; time > 0) times.push_back(time);
  std::sort(times.begin(), times.end());
  return times;
}

double Inlet::greatest_shape() const {
  double greatest = 0;
  constexpr int samples = 64;
  for (int k = 0; k < samples; ++k) greatest = std::max(greatest, std::abs(shape->at(period * k / samples)));
  return greatest;
}

double Inlet::mean_shape() const {
  const std::vector<double> values = samples();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double Inlet::time_of_mean() const {
  const std::vector<double> values = samples();
  const double mean = mean_shape();
  const auto nearest = std::min_element(values.begin(), values.end(), [&](double a, double b) {
    return std::abs(a - mean) < std::abs(b - mean);
  });
  return period * static_cast<double>(nearest - values.begin()) / static_cast<double>(values.size());
}

std::vector<double> Inlet::samples() const {
  constexpr int count = 256;
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(shape->at(period * k / count));
  return values;
}

Inlet inlet_from_scene(const Scene& scene) {
  Inlet inlet;
  const std::string& waveform = scene.text("inlet.waveform");
  if (waveform == "ica" || waveform == "constant") {
    inlet.period = scene.number("inlet.period");
    inlet.scale_key = "inlet.flow";
    if (waveform == "ica")
      inlet.shape = std::make_unique<CarotidFlow>(inlet.period);
    else
      inlet.shape = std::make_unique<Constant>();
  } else if (waveform == "pressure" || waveform == "pulse") {
    inlet.is_pressure = true;
    inlet.period = scene.number("inlet.period");
    inlet.scale_key = "inlet.pressure";
    if (waveform == "pulse")
      inlet.shape = std::make_unique<Pulse>(scene.number("inlet.duration"), inlet.period);
    else
      inlet.shape = std::make_unique<Constant>();
  } else {
    scene::WaveformFile file = scene::read_waveform(scene.folder() / waveform);
    inlet.is_pressure = file.is_pressure;
    inlet.period = file.period;
    inlet.shape = std::make_unique<Sampled>(std::move(file));
  }
  if (scene.text("time.start") == "rest") inlet.ramp = scene.number("time.ramp");
  return inlet;
}

}  // namespace tunica
