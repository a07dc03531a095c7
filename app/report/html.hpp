// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace tunica::report {

/// Text for element content and quoted attributes: & < > " ' are replaced.
std::string escape(std::string_view text);

/// JSON for the inside of a <script> element: no '<', so neither "</script" nor "<!--".
std::string script_json(const nlohmann::ordered_json& value);
std::string script_string(std::string_view text);

/// Appends [1.5,null,...]: numbers times a factor with so many digits; null for what is not finite.
void append_array(std::string& json, const std::vector<double>& values, double factor, int digits);

/// A table in a box that scrolls sideways by itself, so that the page does not. All three are HTML.
std::string table(std::string_view caption, std::string_view head, std::string_view body);

/// A number with a fixed count of decimals and a real minus sign; "–" for none.
std::string number(double value, int decimals);

/// Puts values in place of {{name}}. Values are not looked into, so text of users stays text.
/// Throws std::logic_error for a name without a value.
struct Slot {
  std::string_view name;
  std::string value;
};
std::string fill(std::string_view text, const std::vector<Slot>& slots);

}  // namespace tunica::report
