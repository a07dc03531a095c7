// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace tunica::test_support {

// Functions of independent inputs, uniform in the unit cube, whose Sobol' indices are known in closed form.

using Function = std::function<double(const std::vector<double>&)>;  ///< of the unit cube

/// sin x1 + 7 sin^2 x2 + 0.1 x3^4 sin x1 on [-pi, pi]^3 (Ishigami and Homma 1990).
inline double ishigami(const std::vector<double>& unit) {
  const auto x = [&](std::size_t k) { return std::numbers::pi * (2 * unit[k] - 1); };
  return std::sin(x(0)) + 7 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * std::sin(x(0));
}
/// Sobol' indices by input.
struct Exact {
  std::vector<double> first, total;
};
inline Exact ishigami_indices() {
  const double a = 7, b = 0.1, pi4 = std::pow(std::numbers::pi, 4);
  const double variance = a * a / 8 + b * pi4 / 5 + b * b * pi4 * pi4 / 18 + 0.5;
  const double one = 0.5 * std::pow(1 + b * pi4 / 5, 2), two = a * a / 8;
  const double interaction = b * b * pi4 * pi4 * (1.0 / 18 - 1.0 / 50);
  return {{one / variance, two / variance, 0},
          {(one + interaction) / variance, two / variance, interaction / variance}};
}

inline constexpr std::array g_weights{0.0, 1.0, 4.5, 9.0};
/// The product of (|4 x - 2| + a) / (1 + a) (Saltelli and Sobol' 1995).
inline double g_function(const std::vector<double>& unit) {
  double product = 1;
  for (std::size_t k = 0; k < g_weights.size(); ++k)
    product *= (std::abs(4 * unit[k] - 2) + g_weights[k]) / (1 + g_weights[k]);
  return product;
}
inline Exact g_indices() {
  double whole = 1;
  std::vector<double> parts;
  for (const double a : g_weights) {
    parts.push_back(1 / (3 * (1 + a) * (1 + a)));
    whole *= 1 + parts.back();
  }
  const double variance = whole - 1;
  Exact exact;
  for (const double part : parts) {
    exact.first.push_back(part / variance);
    exact.total.push_back(part * whole / (1 + part) / variance);
  }
  return exact;
}

}  // namespace tunica::test_support
