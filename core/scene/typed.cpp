// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/typed.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/slips.hpp"

namespace tunica::scene {

namespace {

/// Lists longer than this are mistakes; their values would be unreadable in every result.
constexpr std::size_t longest_list = 100;
constexpr std::size_t longest_text = 1000;

std::string in_unit(const Parameter& parameter) {
  return parameter.unit == "1" || parameter.unit.empty() ? "" : " (in " + parameter.unit + ")";
}

/// What may be written at a key, for the end of a message.
std::string allowed(const Parameter& parameter) {
  const std::string unit = in_unit(parameter);
  switch (parameter.kind) {
    case Kind::number:
      return parameter.unit == "1" ? fmt::format("write a number, {}", parameter.bounds.text())
                                   : fmt::format("write a number{}, {}, or text with a unit such as \"1 {}\"",
                                                 unit, parameter.bounds.text(), parameter.unit);
    case Kind::integer:
      return fmt::format("write a whole number, {}", parameter.bounds.text());
    case Kind::flag:
      return "write true or false, without quotes";
    case Kind::choice: {
      std::vector<std::string> choices;
      for (const std::string& each : parameter.choices) choices.push_back(in_quotes(each));
      return fmt::format("write one of {}", fmt::join(choices, ", "));
    }
    case Kind::text:
      return "write a text in double quotes";
    case Kind::numbers:
      return fmt::format("write a list of numbers{}, each {}", unit, parameter.bounds.text());
    case Kind::texts:
      return "write a list of texts, for example [\"outlet.resistance\"]";
  }
  return {};
}

[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& why,
                         const std::string& remedy) {
  throw InvalidInput(fmt::format("{} = {} {}; {}", one_line(key), value, why, remedy));
}

void check_bounds(double value, const Parameter& parameter, const std::string& key, bool is_plain) {
  if (parameter.bounds.contains(value)) return;
  refuse(key, with_unit(value, parameter.unit),
         std::isfinite(value) ? "is out of range" : "is not a finite number",
         allowed(parameter) + did_you_mean(is_plain ? unit_meant(key, value) : ""));
}

double number_from(const toml::node& node, const Parameter& parameter, const std::string& key) {
  double value = 0;
  if (const auto* integer = node.as_integer())
    value = static_cast<double>(integer->get());
  else if (const auto* floating = node.as_floating_point())
    value = floating->get();
  else if (const auto* text = node.as_string())
    value = convert_quantity(text->get(), parameter.unit, key);
  else
    refuse(key, shown(node), "is not a number", allowed(parameter));
  check_bounds(value, parameter, key, node.is_number());
  return value;
}

long integer_from(const toml::node& node, const Parameter& parameter, const std::string& key) {
  double value = 0;
  if (const auto* integer = node.as_integer())
    value = static_cast<double>(integer->get());
  else if (const auto* floating = node.as_floating_point())
    value = floating->get();
  else
    refuse(key, shown(node), "is not a whole number", allowed(parameter));
  check_bounds(value, parameter, key, false);
  if (value != std::floor(value)) refuse(key, shown(node), "is not a whole number", allowed(parameter));
  return static_cast<long>(value);
}

std::string text_from(const std::string& text, const Parameter& parameter, const std::string& key) {
  if (text.empty()) refuse(key, "\"\"", "is empty", allowed(parameter));
  if (text.size() > longest_text)
    refuse(key, in_quotes(text), fmt::format("is longer than {} bytes", longest_text), allowed(parameter));
  if (one_line(text, longest_text) != text)
    refuse(key, in_quotes(text), "holds a control character", allowed(parameter));
  return text;
}

std::string choice_from(const std::string& text, const Parameter& parameter, const std::string& key) {
  if (std::find(parameter.choices.begin(), parameter.choices.end(), text) != parameter.choices.end())
    return text;
  const std::string near = nearest(text, parameter.choices);
  refuse(key, in_quotes(text), "is not known",
         allowed(parameter) + did_you_mean(near.empty() ? near : in_quotes(near)));
}

/// The parts of "a, b, c", which people type as an override instead of a TOML list.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char letter : text) {
    if (letter == ',')
      parts.emplace_back();
    else if (!std::isspace(static_cast<unsigned char>(letter)) || !parts.back().empty())
      parts.back() += letter;
  }
  for (std::string& part : parts)
    while (!part.empty() && std::isspace(static_cast<unsigned char>(part.back()))) part.pop_back();
  return parts;
}

/// One number of a list that was typed as text: plain numbers are in the parameter's unit.
double listed_number(const std::string& part, const Parameter& parameter, const std::string& key) {
  char* end = nullptr;
  const double plain = std::strtod(part.c_str(), &end);
  const bool whole = !part.empty() && *end == '\0';
  const double value = whole ? plain : convert_quantity(part, parameter.unit, key);
  check_bounds(value, parameter, key, whole);
  return value;
}

template <class Element, class FromNode, class FromText>
std::vector<Element> list_from(const toml::node& node, const Parameter& parameter, const std::string& key,
                               FromNode from_node, FromText from_text) {
  std::vector<Element> list;
  const auto check_length = [&](std::size_t length) {
    if (length > longest_list)
      refuse(key, "(a list)", fmt::format("has {} entries, more than {}", length, longest_list),
             allowed(parameter));
  };
  if (const toml::array* array = node.as_array()) {
    check_length(array->size());
    for (const toml::node& element : *array) list.push_back(from_node(element));
  } else if (const auto* text = node.as_string()) {
    const std::vector<std::string> parts = parts_of(text->get());
    check_length(parts.size());
    for (const std::string& part : parts) list.push_back(from_text(part));
  } else {
    list.push_back(from_node(node));
  }
  return list;
}

}  // namespace

std::string shown(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* floating = node.as_floating_point()) return fmt::format("{:.10g}", floating->get());
  if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
  if (const auto* text = node.as_string()) return in_quotes(text->get());
  if (node.is_table()) return "(a table)";
  if (node.is_array()) return "(a list)";
  return "(a date or time)";
}

Value typed_value(const toml::node& node, const Parameter& parameter, const std::string& key) {
  switch (parameter.kind) {
    case Kind::number:
      return number_from(node, parameter, key);
    case Kind::integer:
      return integer_from(node, parameter, key);
    case Kind::flag:
      if (const auto* boolean = node.as_boolean()) return boolean->get();
      refuse(key, shown(node), "is not true or false", allowed(parameter));
    case Kind::choice:
      if (const auto* text = node.as_string()) return choice_from(text->get(), parameter, key);
      refuse(key, shown(node), "is not a text", allowed(parameter));
    case Kind::text:
      if (const auto* text = node.as_string()) return text_from(text->get(), parameter, key);
      refuse(key, shown(node), "is not a text", allowed(parameter));
    case Kind::numbers:
      return list_from<double>(
          node, parameter, key, [&](const toml::node& each) { return number_from(each, parameter, key); },
          [&](const std::string& part) { return listed_number(part, parameter, key); });
    case Kind::texts:
      return list_from<std::string>(
          node, parameter, key,
          [&](const toml::node& each) {
            const auto* text = each.as_string();
            if (!text) refuse(key, shown(each), "is not a text", allowed(parameter));
            return text_from(text->get(), parameter, key);
          },
          [&](const std::string& part) { return text_from(part, parameter, key); });
  }
  throw std::logic_error("unknown kind of parameter");
}

}  // namespace tunica::scene
