// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace tunica {

/// A periodic function through one period of samples that does not leave them: in each interval a cubic with
/// the slopes of the periodic cubic spline at its ends, two continuous derivatives, wherever that spline
/// turns only where the samples do and by no more than twice what a parabola through them would. At the ends
/// of other intervals it has Steffen's slopes (Astron. Astrophys. 239:443, 1990), which make it monotone
/// between samples; there the second derivative jumps.
class PeriodicCurve {
 public:
  /// Times increase, four or more; the last value is the first one again.
  PeriodicCurve(std::vector<double> time, std::vector<double> value);

  double at(double time) const;
  /// Samples at which the slope is Steffen's.
  std::size_t limited() const { return limited_; }

 private:
  std::size_t intervals() const { return time_.size() - 1; }
  double width(std::size_t interval) const { return time_[interval + 1] - time_[interval]; }
  double secant(std::size_t interval) const;
  /// The interval before or behind.
  std::size_t before(std::size_t interval) const;
  std::size_t behind(std::size_t interval) const;

  std::vector<double> spline_slopes() const;
  /// At the sample that an interval begins with.
  double steffen_slope(std::size_t interval) const;
  double cubic(std::size_t interval, double part) const;
  bool leaves_samples(std::size_t interval, double unseen) const;
  double allowance(double fall, std::size_t interval, std::size_t outside) const;

  std::vector<double> time_, value_, slope_;
  std::size_t limited_ = 0;
};

}  // namespace tunica
