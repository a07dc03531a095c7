// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>

#include "core/wall/collagen.hpp"

namespace tunica::test_support {

inline double largest(const Tensor<double>& a) {
  double most = 0;
  for (double entry : a.entries) most = std::max(most, std::abs(entry));
  return most;
}

/// Entry by entry, with one tolerance for all: rounding is relative to the largest.
inline void expect_near(const Tensor<double>& actual, const Tensor<double>& expected, double tolerance) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(actual(i, j), expected(i, j), tolerance) << i << ", " << j;
}

/// Random tensors that a seed repeats. The seed is fixed unless the environment variable TUNICA_SEED
/// sets it; SCOPED_TRACE(random.origin()) shows it with every failure.
class RandomDeformation {
 public:
  RandomDeformation() : seed_(seed_from_environment()), engine_(seed_) {
    testing::Test::RecordProperty("seed", std::to_string(seed_));
  }

  std::string origin() const { return "random deformations of TUNICA_SEED=" + std::to_string(seed_); }

  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }

  /// Entries in [-size, size].
  Tensor<double> tensor(double size) {
    Tensor<double> t;
    for (double& entry : t.entries) entry = uniform(-size, size);
    return t;
  }

  /// Uniform over all rotations (Shoemake's unit quaternion).
  Tensor<double> rotation() {
    const double share = uniform(0, 1);
    const double one = uniform(0, 2 * std::numbers::pi), two = uniform(0, 2 * std::numbers::pi);
    const double x = std::sqrt(1 - share) * std::sin(one), y = std::sqrt(1 - share) * std::cos(one);
    const double z = std::sqrt(share) * std::sin(two), w = std::sqrt(share) * std::cos(two);
    Tensor<double> q;
    q.entries = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                 2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                 2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    return q;
  }

  wall::MaterialAxes axes() {
    const Tensor<double> q = rotation();
    return {{q(0, 1), q(1, 1), q(2, 1)}, {q(0, 2), q(1, 2), q(2, 2)}};
  }

  /// H = F - I with principal stretches that differ by up to a factor of 2.3, J from 0.9 to 1.1, turned at
  /// random before and after.
  Tensor<double> displacement_gradient() {
    double stretches[3];
    for (double& stretch : stretches) stretch = uniform(0.7, 1.6);
    const double jacobian = uniform(0.9, 1.1);
    const double scale = std::cbrt(jacobian / (stretches[0] * stretches[1] * stretches[2]));
    const auto stretch =
        Tensor<double>::diagonal(scale * stretches[0], scale * stretches[1], scale * stretches[2]);
    return rotation() * stretch * rotation() - Tensor<double>::identity();
  }

  /// Half of the time the same; else an inflated and stretched artery, distorted by a tenth and turned, in
  /// which fibres about the circumference are often all recruited.
  Tensor<double> displacement_gradient(const wall::MaterialAxes& axes) {
    if (uniform(0, 1) < 0.5) return displacement_gradient();
    const double ring = uniform(1.0, 2.2), axial = uniform(0.9, 1.3), jacobian = uniform(0.9, 1.1);
    const Vector<double> radial = cross(axes.circumferential, axes.axial);
    const Tensor<double> inflation = jacobian / (ring * axial) * outer(radial, radial) +
                                     ring * outer(axes.circumferential, axes.circumferential) +
                                     axial * outer(axes.axial, axes.axial);
    return rotation() * inflation * (Tensor<double>::identity() + tensor(0.1)) - Tensor<double>::identity();
  }

 private:
  static unsigned long seed_from_environment() {
    const char* given = std::getenv("TUNICA_SEED");
    return given ? std::strtoul(given, nullptr, 10) : 20220607;
  }

  unsigned long seed_;
  std::mt19937_64 engine_;
};

}  // namespace tunica::test_support
