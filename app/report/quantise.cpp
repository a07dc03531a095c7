// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/quantise.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace tunica::report {

// The page's script reads the bytes as its machine's integers, which are little-endian wherever browsers run.
static_assert(std::endian::native == std::endian::little, "arrays are put into the report as they are");

Span span_of(const std::vector<std::vector<float>>& rows) {
  Span span;
  bool is_first = true;
  for (const auto& row : rows)
    for (const float value : row) {
      if (!std::isfinite(value)) continue;
      span.lowest = is_first ? value : std::min<double>(span.lowest, value);
      span.highest = is_first ? value : std::max<double>(span.highest, value);
      is_first = false;
    }
  return span;
}

Span telling_span(const std::vector<std::vector<float>>& rows, std::span<const double> weights) {
  constexpr double left_out_each_side = 0.005;
  std::vector<std::pair<float, double>> values;
  double sum = 0;
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (!std::isfinite(row[k])) continue;
      values.emplace_back(row[k], weights.empty() ? 1.0 : weights[k]);
      sum += values.back().second;
    }
  const Span whole = span_of(rows);
  if (values.empty()) return whole;
  std::sort(values.begin(), values.end());
  const auto beyond = [&](auto first, auto last) {
    double passed = 0;
    while (first + 1 != last && passed + first->second <= left_out_each_side * sum)
      passed += (first++)->second;
    return static_cast<double>(first->first);
  };
  const Span inner{beyond(values.begin(), values.end()), beyond(values.rbegin(), values.rend())};
  const double width = inner.highest - inner.lowest;
  return width > 0 && 2 * width < whole.highest - whole.lowest ? inner : whole;
}

Quantised quantise(const std::vector<std::vector<float>>& rows, Span range, int bytes) {
  if (bytes != 1 && bytes != 2) throw std::logic_error("quantise: 1 or 2 bytes");
  const unsigned missing = bytes == 1 ? 0xff : 0xffff;
  const double steps = missing - 1;
  Quantised made;
  made.lowest = range.lowest;
  made.step = (range.highest - range.lowest) / steps;
  for (const auto& row : rows)
    for (const float value : row) {
      unsigned code = missing;
      if (std::isfinite(value))
        code = made.step == 0 ? 0
                              : static_cast<unsigned>(
                                    std::clamp(std::round((value - made.lowest) / made.step), 0.0, steps));
      made.bytes += static_cast<char>(code & 0xff);
      if (bytes == 2) made.bytes += static_cast<char>(code >> 8);
    }
  return made;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[at + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace tunica::report
