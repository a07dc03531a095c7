// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "app/report/html.hpp"

namespace tunica::report {

/// Digits of lone numbers: times of different runs are compared by the script.
inline constexpr int time_digits = 10;

/// Builds a JSON object for a <script> element member by member; numbers are written straight, for speed.
class Object {
 public:
  explicit Object(std::string& json) : json_(json) { json_ += '{'; }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() { json_ += '}'; }

  std::string& key(std::string_view name) {
    if (!first_) json_ += ',';
    first_ = false;
    json_ += script_string(name) + ":";
    return json_;
  }
  void text(std::string_view name, std::string_view value) { key(name) += script_string(value); }
  void value(std::string_view name, double value) {
    key(name) += std::isfinite(value) ? fmt::format("{:.{}g}", value, time_digits) : "null";
  }

 private:
  std::string& json_;
  bool first_ = true;
};

/// Writes [a,b,...], each element by `write(json, element)`.
template <class Elements, class Write>
void append_list(std::string& json, const Elements& elements, const Write& write) {
  json += '[';
  bool first = true;
  for (const auto& element : elements) {
    if (!first) json += ',';
    first = false;
    write(json, element);
  }
  json += ']';
}

}  // namespace tunica::report
