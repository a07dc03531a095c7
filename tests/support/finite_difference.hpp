// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tunica::test_support {

/// df/dx by central differences of order 8: errors are h^8 f^(9)/630 and round-off of f over h.
template <class Function>
auto finite_difference(const Function& f, double x, double step) {
  const auto pair = [&](int k) { return f(x + k * step) - f(x - k * step); };
  return (0.8 * pair(1) - 0.2 * pair(2) + (4.0 / 105) * pair(3) - (1.0 / 280) * pair(4)) / step;
}

}  // namespace tunica::test_support
