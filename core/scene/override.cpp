// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/override.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string_view>

#include "core/error.hpp"
#include "core/scene/given.hpp"
#include "core/scene/message.hpp"
#include "core/scene/parameter.hpp"
#include "core/scene/text.hpp"
#include "core/scene/typed.hpp"

namespace tunica::scene {

namespace {

std::string trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(blank) - first + 1));
}

/// The value alone in a table, under the name "value".
toml::table value_table(const std::string& text, const std::string& label) {
  if (!text.empty()) check_scene_text(text, label);
  try {
    toml::table parsed = toml::parse("value = " + text);
    // A line break in the value must not bring in further keys.
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
    // Not TOML: a bare word, or a quantity without quotes.
  }
  return toml::table{{"value", text}};
}

/// One step of a path: the name before the brackets and the index inside, if any.
struct Step {
  std::string name;
  bool indexed = false;
  std::size_t index = 0;
};

Step step_from(std::string_view part) {
  Step step{std::string(part.substr(0, part.find('[')))};
  if (step.name.size() == part.size()) return step;
  step.indexed = true;
  const std::string_view digits = part.substr(step.name.size() + 1);
  // Digits alone can stand here since the key is declared; too many of them are no existing table.
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), step.index);
  if (error != std::errc{}) step.index = std::numeric_limits<std::size_t>::max();
  return step;
}

}  // namespace

void apply_override(toml::table& root, const std::string& text, const std::string& label) {
  const std::string place = label + ", override";
  const std::size_t equals = text.find('=');
  const std::string key = trimmed(std::string_view(text).substr(0, equals));
  if (equals == std::string::npos || key.empty())
    throw InvalidInput(
        fmt::format("{} {}: write key=value, for example outlet.resistance=1e6", place, in_quotes(text)));
  if (!find_parameter(key) && !is_table_array(key)) {
    // The name of a table is not meant for a key of the same name in another.
    const bool is_table = std::any_of(parameters().begin(), parameters().end(),
                                      [&](const Parameter& p) { return p.key.starts_with(key + '.'); });
    const std::string hint = is_table ? std::string{} : did_you_mean(nearest_key(key));
    throw InvalidInput(fmt::format(
        "{}: unknown key {}{}", place, one_line(key),
        hint.empty() ? "; name a key of a table, such as geometry.radius (docs/parameters.md)" : hint));
  }

  toml::table* table = &root;
  std::string_view rest = key;
  for (std::size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
    const Step step = step_from(rest.substr(0, dot));
    rest.remove_prefix(dot + 1);
    toml::node* node = table->get(step.name);
    if (step.indexed) {
      toml::array* array = node ? node->as_array() : nullptr;
      const std::size_t size = array ? array->size() : 0;
      if (step.index >= size)
        throw InvalidInput(
            fmt::format("{}: {} names a table that the scene has not: it has {} [[{}]], counted "
                        "from 0; add the table to the file",
                        place, key, size, key.substr(0, key.rfind('['))));
      node = array->get(step.index);
    } else if (!node) {
      node = &table->insert(step.name, toml::table{}).first->second;
    }
    table = node->as_table();
    if (!table)
      throw InvalidInput(fmt::format("{}: {} cannot be set: {} is not a table in the file; write [{}]", place,
                                     key, step.name, step.name));
  }
  const toml::table value = value_table(trimmed(std::string_view(text).substr(equals + 1)), place);
  // Copies have no place in the file, which is how messages tell an override from a line.
  table->insert_or_assign(rest, *value.get("value"));
}

bool apply_number(GivenScene& given, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return false;
  const std::string key = trimmed(std::string_view(text).substr(0, equals));
  const std::string number = trimmed(std::string_view(text).substr(equals + 1));
  if (key.find('[') != std::string::npos) return false;
  const Parameter* parameter = find_parameter(key);
  if (!parameter || (parameter->kind != Kind::number && parameter->kind != Kind::integer)) return false;
  const char *begin = number.data(), *end = begin + number.size();
  const std::string place = given.label + ", override";
  const auto put = [&](const auto& node) {
    try {
      given.values[key] = {typed_value(node, *parameter, key), place, true};
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("{}: {}", place, error.what()));
    }
    return true;
  };
  // TOML's own forms; what else reads as a number is left to its parser.
  if (!number.empty() && number.find_first_not_of("0123456789-") == std::string::npos) {
    std::int64_t whole = 0;
    const auto [last, error] = std::from_chars(begin, end, whole);
    const bool leads_with_zero = number.size() > 1 && number[number[0] == '-' ? 1 : 0] == '0';
    return error == std::errc{} && last == end && !leads_with_zero && put(toml::value<std::int64_t>(whole));
  }
  if (number.find_first_not_of("0123456789-.e+") != std::string::npos || number.front() == '.') return false;
  double value = 0;
  const auto [last, error] = std::from_chars(begin, end, value);
  return error == std::errc{} && last == end && put(toml::value<double>(value));
}

}  // namespace tunica::scene
