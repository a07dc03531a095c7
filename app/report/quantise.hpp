// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::report {

/// Numbers as integers of 8 or 16 bits between a lowest and a highest value, little-endian: value = lowest +
/// step * integer, to within step / 2. The largest integer stands for NaN.
struct Quantised {
  double lowest = 0;
  double step = 0;  ///< 0 when all values are the same
  std::string bytes;
};

/// Range of the finite values; {0, 0} when there is none.
struct Span {
  double lowest = 0, highest = 0;
};
Span span_of(const std::vector<std::vector<float>>& rows);

/// The range without that hundredth of the values which is farthest out, when this at least halves it (what
/// becomes singular at clamped ends would leave the rest in one colour); else the whole range. Values count
/// by the weights of a row's entries, empty for equal ones: where a surface has many points, each has little
/// area.
Span telling_span(const std::vector<std::vector<float>>& rows, std::span<const double> weights = {});

/// One row after the other. Throws std::logic_error for other than 1 or 2 bytes.
Quantised quantise(const std::vector<std::vector<float>>& rows, Span range, int bytes);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);
template <class Number>
std::string base64_of(const std::vector<Number>& numbers) {
  return base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

}  // namespace tunica::report
