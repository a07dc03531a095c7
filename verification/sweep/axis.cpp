// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/sweep/axis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/parameter.hpp"
#include "core/scene/scene.hpp"

namespace tunica::sweep {

namespace {

constexpr std::size_t most_values = 1'000'000;

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t found = text.find(at);
    parts.emplace_back(text.substr(0, found));
    if (found == std::string_view::npos) return parts;
    text.remove_prefix(found + 1);
  }
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

class AxisReader {
 public:
  AxisReader(const std::string& text, const std::string& option) : text_(text), option_(option) {
    const std::size_t equals = text.find('=');
    axis_.key = trimmed(text.substr(0, equals));
    if (equals == std::string::npos || axis_.key.empty())
      throw InvalidInput(
          fmt::format("{} {}: write {}", option, scene::in_quotes(text),
                      option == "--vary" ? "KEY=LO:HI:N, KEY=A,B, or for a sample KEY=LO:HI" : "KEY=LO:HI"));
    axis_.unit = unit_of(axis_.key, option);
    rest_ = trimmed(text.substr(equals + 1));
  }

  Axis read() {
    if (rest_.find(',') != std::string::npos && rest_.find('(') == std::string::npos)
      list();
    else if (!axis_.is_number())
      refuse(
          fmt::format("it holds no numbers; write two values or more, as in {} {}=A,B", option_, axis_.key));
    else if (auto marginal = uncertainty::parse_marginal(rest_, axis_.key, axis_.unit))
      axis_.marginal = marginal;
    else
      range();
    return std::move(axis_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InvalidInput(fmt::format("{} {}: {}", option_, scene::in_quotes(text_), why));
  }

  double number(const std::string& text) const {
    double value = 0;
    const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
    if (error == std::errc{} && end == text.data() + text.size() && std::isfinite(value)) return value;
    return convert_quantity(text, axis_.unit, axis_.key);
  }

  /// The value as an override writes it. What no scene takes at this key is refused here, not point by point.
  std::string checked(double value) const {
    if (parameter().kind == scene::Kind::integer && value != std::floor(value))
      refuse(fmt::format("{} takes whole numbers, not {}", axis_.key, value_text(value)));
    return value_text(value);
  }
  std::string checked(const std::string& word) const {
    const auto& choices = parameter().choices;
    if (parameter().kind == scene::Kind::choice &&
        std::find(choices.begin(), choices.end(), word) == choices.end())
      refuse(fmt::format("{} is none of {}{}", scene::in_quotes(word), fmt::join(choices, ", "),
                         scene::did_you_mean(scene::nearest(word, choices))));
    if (parameter().kind == scene::Kind::flag && word != "true" && word != "false")
      refuse(fmt::format("{} is neither true nor false", scene::in_quotes(word)));
    return word;
  }
  const scene::Parameter& parameter() const { return *scene::find_parameter(axis_.key); }

  void list() {
    std::set<std::string> seen;
    for (const std::string& part : split(rest_, ',')) {
      const std::string value = trimmed(part);
      if (value.empty()) refuse("the list has an empty value");
      axis_.values.push_back(axis_.is_number() ? checked(number(value)) : checked(value));
      if (!seen.insert(axis_.values.back()).second) refuse(fmt::format("{} is there twice", value));
    }
  }

  void range() {
    std::vector<std::string> parts = split(rest_, ':');
    for (std::string& part : parts) part = trimmed(part);
    const bool is_log = parts.size() > 2 && parts.back() == "log";
    if (is_log) parts.pop_back();
    if (parts.size() != 2 && parts.size() != 3)
      refuse("write LO:HI:N for a grid, LO:HI for a sample, with :log behind it for equal ratios");
    const double low = number(parts[0]), high = number(parts[1]);
    if (low == high) refuse("the range is empty: LO and HI are the same; set the value with --set");
    if (low > high) refuse("the range is reversed: LO is above HI");
    if (is_log && !(low > 0)) refuse("a logarithmic range has to begin above 0");
    if (parts.size() == 2) {
      axis_.marginal = {
          is_log ? uncertainty::Marginal::Kind::log_uniform : uncertainty::Marginal::Kind::uniform, low, high,
          0};
      return;
    }
    long count = 0;
    const auto [end, error] = std::from_chars(parts[2].data(), parts[2].data() + parts[2].size(), count);
    if (error != std::errc{} || end != parts[2].data() + parts[2].size())
      refuse(fmt::format("N = {} is no whole number", scene::in_quotes(parts[2])));
    if (count < 2) refuse("a grid has at least 2 values, its ends; set a single one with --set");
    if (static_cast<std::size_t>(count) > most_values)
      refuse(fmt::format("a grid has at most {} values a key", most_values));
    for (long k = 0; k < count; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(count - 1);
      // The ends are what was asked for, to the last digit.
      const double value = k == 0           ? low
                           : k == count - 1 ? high
                           : is_log         ? low * std::pow(high / low, share)
                                            : std::lerp(low, high, share);
      axis_.values.push_back(checked(value));
    }
  }

  const std::string& text_;
  const std::string& option_;
  std::string rest_;
  Axis axis_;
};

}  // namespace

std::string value_text(double value) {
  return fmt::format("{}", value);
}

std::string unit_of(const std::string& key, const std::string& option) {
  const scene::Parameter* parameter = scene::find_parameter(key);
  if (!parameter || key.find("[]") != std::string::npos) {
    const std::string hint = scene::did_you_mean(scene::nearest_key(key));
    throw InvalidInput(fmt::format("{}: unknown key {}{}", option, scene::one_line(key),
                                   hint.empty() ? "; docs/parameters.md lists every key" : hint));
  }
  switch (parameter->kind) {
    case scene::Kind::number:
    case scene::Kind::integer:
      return parameter->unit.empty() ? "1" : parameter->unit;
    case scene::Kind::numbers:
    case scene::Kind::texts:
      throw InvalidInput(
          fmt::format("{}: {} holds a list; what varies is a key with one value", option, key));
    default:
      return {};
  }
}

Axis parse_axis(const std::string& text, const std::string& option) {
  return AxisReader(text, option).read();
}

}  // namespace tunica::sweep
