// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/observables/result.hpp"
#include "lumped/lumped_tier.hpp"
#include "tests/support/ring_cases.hpp"

namespace tunica::test_support {

/// Runs the 0D tier; a run that gives up fails the test.
inline Result run_lumped(const Scene& scene) {
  Result result = lumped::LumpedTier().prepare(scene)->execute({});
  EXPECT_EQ(result.record.failure, "");
  EXPECT_TRUE(result.record.converged);
  return result;
}

/// To far more digits than the default has, unless the overrides say otherwise.
inline Result run_lumped(std::vector<std::string> overrides, const std::string& folder = ".") {
  overrides.insert(overrides.begin(), "accuracy.tolerance=2e-8");
  return run_lumped(scene_with(overrides, folder));
}

inline const std::vector<double>& column(const observables::Table& table, const std::string& name) {
  const observables::Column* found = table.find(name);
  if (!found) throw std::runtime_error("no column " + name);
  return found->values;
}

inline const std::vector<std::string>& labels(const observables::Table& table, const std::string& name) {
  const observables::Column* found = table.find(name);
  if (!found) throw std::runtime_error("no column " + name);
  return found->labels;
}

/// Greatest minus least value; 0 for a column of empty cells.
inline double range(const std::vector<double>& values) {
  double least = INFINITY, greatest = -INFINITY;
  for (const double value : values) {
    if (observables::is_none(value)) continue;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  return greatest > least ? greatest - least : 0;
}

/// Complex amplitude 2/T int f exp(-i w t) dt of the given harmonic, over the rows from `first` to the
/// last, which are one period of equal steps with both ends: the trapezoidal rule is spectral.
struct Harmonic {
  double cosine, sine;
  double amplitude() const { return std::hypot(cosine, sine); }
  /// of A cos(w t - phase)
  double phase() const { return std::atan2(sine, cosine); }
};
inline Harmonic harmonic(const std::vector<double>& values, std::size_t first, int order = 1) {
  const std::size_t count = values.size() - 1 - first;
  Harmonic sum{0, 0};
  for (std::size_t k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * order * static_cast<double>(k) / static_cast<double>(count);
    sum.cosine += values[first + k] * std::cos(angle) * 2 / static_cast<double>(count);
    sum.sine += values[first + k] * std::sin(angle) * 2 / static_cast<double>(count);
  }
  return sum;
}

/// Simpson's rule over the rows from `first` to the last, an even number of equal steps.
inline double integral(const std::vector<double>& values, std::size_t first, double step) {
  double sum = values[first] + values.back();
  for (std::size_t k = first + 1; k + 1 < values.size(); ++k)
    sum += ((k - first) % 2 == 1 ? 4 : 2) * values[k];
  return sum * step / 3;
}

}  // namespace tunica::test_support
