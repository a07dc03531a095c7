// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/periodic_curve.hpp"

#include <gsl/gsl_interp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "core/gsl.hpp"

namespace tunica {
namespace {

struct Samples {
  std::vector<double> time, value;
};

Samples sampled(int intervals, double period, const std::function<double(double)>& function) {
  Samples samples;
  for (int k = 0; k <= intervals; ++k) {
    samples.time.push_back(period * k / intervals);
    samples.value.push_back(function(samples.time.back()));
  }
  return samples;
}

/// GSL's own curves, with derivatives.
class Gsl {
 public:
  Gsl(const gsl_interp_type* type, Samples samples)
      : samples_(std::move(samples)), curve_(gsl_interp_alloc(type, samples_.time.size()), &gsl_interp_free) {
    check_gsl(
        gsl_interp_init(curve_.get(), samples_.time.data(), samples_.value.data(), samples_.time.size()),
        "gsl_interp_init");
  }
  double at(double time) const {
    return gsl_interp_eval(curve_.get(), samples_.time.data(), samples_.value.data(), time, nullptr);
  }

 private:
  Samples samples_;
  std::unique_ptr<gsl_interp, decltype(&gsl_interp_free)> curve_;
};

struct Range {
  double low = INFINITY, high = -INFINITY;
};
template <class Curve>
Range range(const Curve& curve, double from, double to) {
  Range found;
  constexpr int places = 20000;
  for (int k = 0; k <= places; ++k) {
    const double value = curve.at(from + (to - from) * k / places);
    found.low = std::min(found.low, value);
    found.high = std::max(found.high, value);
  }
  return found;
}

double wave(double time) {
  const double angle = 2 * M_PI * time / 0.8;
  return 1 - 0.15 * std::cos(angle) + 0.13 * std::sin(angle) - 0.11 * std::cos(2 * angle) +
         0.03 * std::sin(4 * angle);
}

TEST(PeriodicCurve, IsTheSplineWhereSamplesAreSmooth) {
  const Samples samples = sampled(40, 0.8, wave);
  const PeriodicCurve curve(samples.time, samples.value);
  EXPECT_EQ(curve.limited(), 0U);
  const Gsl spline(gsl_interp_cspline_periodic, samples);
  for (int k = 0; k < 1000; ++k) {
    const double time = 0.8 * k / 1000;
    EXPECT_NEAR(curve.at(time), spline.at(time), 1e-14) << time;
    EXPECT_NEAR(curve.at(time - 1.6), curve.at(time), 1e-14) << time;
  }
}

TEST(PeriodicCurve, IsOfOrderFourOnSmoothSamples) {
  const auto error = [](int intervals) {
    const Samples samples = sampled(intervals, 0.8, wave);
    const PeriodicCurve curve(samples.time, samples.value);
    double largest = 0;
    for (int k = 0; k < 4000; ++k) largest = std::max(largest, std::abs(curve.at(2e-4 * k) - wave(2e-4 * k)));
    return largest;
  };
  EXPECT_NEAR(std::log2(error(40) / error(80)), 4, 0.3);
}

// Through these a spline runs from -10.8 to 110.8.
TEST(PeriodicCurve, StaysWithinAnEjectionThatIsABlock) {
  const Samples samples =
      sampled(40, 1, [](double time) { return time > 0.09 && time < 0.41 ? 100.0 : 0.0; });
  const Range spline = range(Gsl(gsl_interp_cspline_periodic, samples), 0, 1);
  EXPECT_NEAR(spline.low, -10.8, 0.05);
  EXPECT_NEAR(spline.high, 110.8, 0.05);
  const PeriodicCurve curve(samples.time, samples.value);
  const Range ours = range(curve, 0, 1);
  EXPECT_GE(ours.low, -0.01);
  EXPECT_LE(ours.high, 100.01);
  for (std::size_t k = 0; k < samples.time.size(); ++k)
    EXPECT_NEAR(curve.at(samples.time[k]), samples.value[k], 1e-12);
}

// Of positive samples: 0.05, and 0.4 for a while. A spline dips to 0.012.
TEST(PeriodicCurve, StaysWithinAStep) {
  const Samples samples = sampled(20, 1, [](double time) { return time > 0.24 && time < 0.49 ? 0.4 : 0.05; });
  EXPECT_NEAR(range(Gsl(gsl_interp_cspline_periodic, samples), 0, 1).low, 0.0122, 1e-4);
  const Range ours = range(PeriodicCurve(samples.time, samples.value), 0, 1);
  EXPECT_GE(ours.low, 0.05 - 1e-4 * 0.35);
  EXPECT_LE(ours.high, 0.4 + 1e-4 * 0.35);
}

// Half a sine of 400, then nothing for 0.7 s, which two samples tell: a spline would dip to -721.
TEST(PeriodicCurve, IsZeroBetweenTheTwoPointsOfADiastole) {
  Samples samples = sampled(15, 0.3, [](double time) { return 400 * std::sin(M_PI * time / 0.3); });
  samples.value.back() = 0;
  samples.time.push_back(1);
  samples.value.push_back(0);
  EXPECT_LT(range(Gsl(gsl_interp_cspline_periodic, samples), 0, 1).low, -700);
  const PeriodicCurve curve(samples.time, samples.value);
  const Range diastole = range(curve, 0.3, 1);
  EXPECT_EQ(diastole.low, 0);
  EXPECT_EQ(diastole.high, 0);
  // No sample lies at the peak; that of the sine is found all the same.
  EXPECT_NEAR(range(curve, 0, 0.3).high, 400, 0.1);
}

// Where no interval is left as the spline has it, all slopes are Steffen's; GSL's own are one-sided at its
// ends.
TEST(PeriodicCurve, HasSteffensSlopesWhereItIsLimited) {
  const Samples samples =
      sampled(12, 1.2, [](double time) { return std::fmod(std::round(10 * time), 6) < 3 ? 0.0 : 1.0; });
  const PeriodicCurve curve(samples.time, samples.value);
  ASSERT_EQ(curve.limited(), 12U);
  const Gsl steffen(gsl_interp_steffen, samples);
  for (int k = 0; k <= 100; ++k) {
    const double time = 0.1 + 1.0 * k / 100;
    EXPECT_NEAR(curve.at(time), steffen.at(time), 1e-12) << time;
  }
}

TEST(PeriodicCurve, MayBeConstant) {
  const PeriodicCurve curve({0, 0.1, 0.2, 0.5}, {3, 3, 3, 3});
  for (const double time : {0.0, 0.05, 0.3, 7.7}) EXPECT_DOUBLE_EQ(curve.at(time), 3);
}

}  // namespace
}  // namespace tunica
