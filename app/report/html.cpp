// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace tunica::report {

std::string escape(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char character : text) {
    switch (character) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += character;
    }
  }
  return escaped;
}

std::string script_json(const nlohmann::ordered_json& value) {
  const std::string text = value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string escaped;
  escaped.reserve(text.size());
  // '<' occurs in JSON inside strings only, where its escape means the same.
  for (const char character : text) {
    if (character == '<')
      escaped += "\\u003c";
    else
      escaped += character;
  }
  return escaped;
}

std::string script_string(std::string_view text) {
  return script_json(nlohmann::ordered_json(text));
}

void append_array(std::string& json, const std::vector<double>& values, double factor, int digits) {
  json += '[';
  for (const double value : values) {
    char buffer[32];
    if (std::isfinite(value)) {
      const auto end =
          std::to_chars(buffer, buffer + sizeof buffer, value * factor, std::chars_format::general, digits)
              .ptr;
      json.append(buffer, end);
    } else {
      json += "null";
    }
    json += ',';
  }
  if (json.back() == ',') json.pop_back();
  json += ']';
}

std::string table(std::string_view caption, std::string_view head, std::string_view body) {
  return fmt::format(
      "<div class=\"scroll\" tabindex=\"0\"><table><caption>{}</caption><thead>{}</thead>"
      "<tbody>{}</tbody></table></div>\n",
      caption, head, body);
}

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool is_zero = text.find_first_not_of("0.") == std::string::npos;
  return value < 0 && !is_zero ? "−" + text : text;
}

std::string fill(std::string_view text, const std::vector<Slot>& slots) {
  std::string filled;
  for (;;) {
    const std::size_t open = text.find("{{");
    filled += text.substr(0, open);
    if (open == std::string_view::npos) return filled;
    const std::size_t close = text.find("}}", open);
    if (close == std::string_view::npos) throw std::logic_error("the report's template has an open {{");
    const std::string_view name = text.substr(open + 2, close - open - 2);
    const auto slot =
        std::find_if(slots.begin(), slots.end(), [&](const Slot& known) { return known.name == name; });
    if (slot == slots.end())
      throw std::logic_error(fmt::format("the report has nothing for {{{{{}}}}}", name));
    filled += slot->value;
    text.remove_prefix(close + 2);
  }
}

}  // namespace tunica::report
