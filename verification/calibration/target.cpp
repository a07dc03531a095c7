// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/calibration/target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/parameter.hpp"
#include "verification/sweep/axis.hpp"

namespace tunica::verification::calibration {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<double> plain_number(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc{} && end == text.data() + text.size() && std::isfinite(number)) return number;
  return std::nullopt;
}

/// "mmHg" of "130 mmHg"; empty for a plain number.
std::string unit_behind(std::string_view text) {
  double number = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number).ptr;
  return std::string(trimmed(text.substr(static_cast<std::size_t>(end - text.data()))));
}

class TargetReader {
 public:
  TargetReader(const std::string& text, const Scene& scene, const std::vector<FreeKey>& free)
      : text_(text), scene_(scene), free_(free) {}

  Target read() {
    const std::size_t equals = text_.find('=');
    if (equals == std::string::npos) refuse("write QUANTITY=VALUE or QUANTITY=VALUE+-SD");
    Target target;
    target.asked = text_;
    target.quantity = run::parse_quantity(trimmed(std::string_view(text_).substr(0, equals)));
    unit_ = target.quantity.unit();
    std::string_view value = trimmed(std::string_view(text_).substr(equals + 1));
    std::string_view deviation;
    for (const std::string_view sign : {"+-", "+/-", "±"}) {
      const std::size_t at = value.find(sign);
      if (at == std::string_view::npos) continue;
      deviation = trimmed(value.substr(at + sign.size()));
      value = trimmed(value.substr(0, at));
      if (deviation.empty()) refuse(fmt::format("there is no standard deviation behind {}", sign));
      break;
    }
    if (value.empty()) refuse("there is no value");
    const bool is_share_of_value = deviation.ends_with('%');
    target.value = number(value, is_share_of_value ? "" : unit_behind(deviation));
    target.deviation_given = !deviation.empty();
    if (!target.deviation_given)
      target.standard_deviation = Target::usual_share * std::abs(target.value);
    else if (is_share_of_value)
      target.standard_deviation = share(deviation) * std::abs(target.value);
    else
      target.standard_deviation = number(deviation, is_share_of_key(value) ? "" : unit_behind(value));
    if (!(target.standard_deviation > 0))
      refuse(target.deviation_given ? "the standard deviation has to be above 0"
                                    : "a value of 0 needs a standard deviation: write 0+-SD");
    return target;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InvalidInput(fmt::format("--target {}: {}", scene::in_quotes(text_), why));
  }

  static bool is_share_of_key(std::string_view value) { return value.find(" of ") != std::string_view::npos; }

  double share(std::string_view percentage) const {
    const auto number = plain_number(trimmed(percentage.substr(0, percentage.find('%'))));
    if (!number || trimmed(percentage.substr(percentage.find('%') + 1)) != "")
      refuse(fmt::format("{} is not a percentage", scene::in_quotes(percentage)));
    return *number / 100;
  }

  double number(std::string_view text, const std::string& unit_of_other) const {
    if (is_share_of_key(text)) return share_of_key(text);
    const std::string label = fmt::format("--target {}", text_.substr(0, text_.find('=')));
    if (const auto plain = plain_number(text)) {
      if (unit_of_other.empty()) return *plain;
      return convert_quantity(fmt::format("{} {}", text, unit_of_other), unit_, label);
    }
    return convert_quantity(text, unit_, label);
  }

  double share_of_key(std::string_view text) const {
    const std::size_t of = text.find(" of ");
    const std::string key(trimmed(text.substr(of + 4)));
    const double part = share(trimmed(text.substr(0, of)));
    const std::string key_unit = sweep::unit_of(key, "--target");
    if (key_unit.empty() || !scene_.has(key) ||
        !std::holds_alternative<double>(scene_.values().find(key)->second))
      refuse(fmt::format("{} is no number of this scene", key));
    if (std::any_of(free_.begin(), free_.end(), [&](const FreeKey& one) { return one.key == key; }))
      refuse(fmt::format("{} is free itself; give the value in {}", key, unit_));
    return part * scene_.number(key) *
           unit_factor(key_unit, unit_, fmt::format("--target {}", scene::in_quotes(text_)),
                       fmt::format("take a key in {}", unit_));
  }

  const std::string& text_;
  const Scene& scene_;
  const std::vector<FreeKey>& free_;
  std::string unit_;
};

}  // namespace

double FreeKey::value(double u) const {
  if (u <= 0) return low;
  if (u >= 1) return high;
  return is_log() ? low * std::pow(high / low, u) : std::lerp(low, high, u);
}

double FreeKey::slope(double u) const {
  return is_log() ? value(u) * std::log(high / low) : high - low;
}

double FreeKey::place(double x) const {
  if (x <= low) return 0;
  if (x >= high) return 1;
  return is_log() ? std::log(x / low) / std::log(high / low) : (x - low) / (high - low);
}

FreeKey parse_free(const std::string& text, const run::SceneSource& source) {
  const sweep::Axis axis = sweep::parse_axis(text, "--free");
  using Kind = uncertainty::Marginal::Kind;
  const bool is_range =
      axis.marginal && (axis.marginal->kind == Kind::uniform || axis.marginal->kind == Kind::log_uniform);
  if (!is_range || scene::find_parameter(axis.key)->kind != scene::Kind::number)
    throw InvalidInput(fmt::format("--free {}: write KEY=LO:HI, the bounds of a key that holds a number",
                                   scene::in_quotes(text)));
  // The scene says what it refuses, with its own words.
  for (const double bound : {axis.marginal->a, axis.marginal->b})
    source.with({fmt::format("{}={}", axis.key, sweep::value_text(bound))});
  return {axis.key, axis.unit, axis.marginal->a, axis.marginal->b};
}

Target parse_target(const std::string& text, const Scene& scene, const std::vector<FreeKey>& free) {
  return TargetReader(text, scene, free).read();
}

}  // namespace tunica::verification::calibration
