// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

namespace tunica {

// Checks of an option's text, as CLI::Option::check takes them: what is wrong with it, empty where nothing
// is.

/// All of the text as a T; false where it is none, or none that T can hold.
template <class T>
bool reads_as(const std::string& text, T& value) {
  const char* const back = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), back, value);
  return error == std::errc{} && end == back;
}

inline std::string check_seed(const std::string& text) {
  std::uint64_t seed = 0;
  return reads_as(text, seed) ? "" : "a seed is a whole number from 0 to 18446744073709551615";
}

inline std::string check_width(const std::string& text) {
  double width = 0;
  return reads_as(text, width) && std::isfinite(width) && width > 0
             ? ""
             : "the width of an interval is a number above 0, such as 0.05";
}

}  // namespace tunica
