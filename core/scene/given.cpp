// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/given.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/override.hpp"
#include "core/scene/text.hpp"
#include "core/scene/typed.hpp"

namespace tunica::scene {

namespace {

/// Far above any wall and few enough for a message or a report to list.
constexpr std::size_t most_tables = 50;

/// Tables of the scene as they are declared: "geometry", "wall", "wall.layers[]", ...
const std::vector<std::string>& declared_tables() {
  static const std::vector<std::string> tables = [] {
    std::vector<std::string> names;
    for (const Parameter& parameter : parameters()) {
      const std::string name = parameter.key.substr(0, parameter.key.rfind('.'));
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
  }();
  return tables;
}

bool is_table(std::string_view path) {
  const auto& tables = declared_tables();
  return std::find(tables.begin(), tables.end(), declared_form(path)) != tables.end();
}

class Walk {
 public:
  explicit Walk(GivenScene& given) : given_(given) {}

  void table(const toml::table& table, const std::string& path) {
    for (const auto& [key, node] : table) {
      const std::string name = path.empty() ? std::string(key.str()) : path + "." + std::string(key.str());
      // A dot or bracket inside a quoted key must not look like a path.
      if (key.str().find_first_of(".[]") != std::string_view::npos)
        refuse(node, fmt::format("unknown key {}; write keys without quotes, dots apart tables and names",
                                 in_quotes(name)));
      if (is_table_array(name))
        tables(node, name);
      else if (is_table(name))
        subtable(node, name);
      else if (const Parameter* parameter = find_parameter(name))
        leaf(*parameter, name, node);
      else
        unknown(name, node);
    }
  }

 private:
  void subtable(const toml::node& node, const std::string& path) {
    if (const toml::table* inner = node.as_table()) return table(*inner, path);
    refuse(node, node.is_array() ? fmt::format("{0} is one table, not a list; write [{0}] once", path)
                                 : fmt::format("{0} = {1} is not a table; write [{0}] and its keys below",
                                               path, shown(node)));
  }

  void tables(const toml::node& node, const std::string& path) {
    const toml::array* array = node.as_array();
    const std::string heading = without_brackets(path);
    const std::string remedy = fmt::format("write [[{}]] for each", heading);
    if (!array) refuse(node, fmt::format("{} is a list of tables, not {}; {}", path, shown(node), remedy));
    if (array->size() > most_tables)
      refuse(node, fmt::format("{} has {} tables; at most {} are allowed", path, array->size(), most_tables));
    given_.counts[path] = array->size();
    for (std::size_t i = 0; i < array->size(); ++i) {
      const toml::node& element = *array->get(i);
      const toml::table* inner = element.as_table();
      if (!inner)
        refuse(element, fmt::format("{}[{}] = {} is not a table; {}", path, i, shown(element), remedy));
      table(*inner, fmt::format("{}[{}]", path, i));
    }
  }

  void leaf(const Parameter& parameter, const std::string& key, const toml::node& node) {
    const std::string place = where(node);
    try {
      given_.values[key] = {typed_value(node, parameter, key), place, node.is_number()};
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("{}: {}", place, error.what()));
    }
  }

  [[noreturn]] void unknown(const std::string& path, const toml::node& node) const {
    const std::string name = one_line(path);
    constexpr const char* otherwise = "; docs/parameters.md lists every key";
    const auto or_manual = [&](const std::string& hint) { return hint.empty() ? otherwise : hint; };
    const toml::table* inner = node.as_table();
    if (node.is_array_of_tables() && !node.as_array()->empty()) inner = node.as_array()->get(0)->as_table();
    if (!inner)
      refuse(node, fmt::format("unknown key {}{}", name, or_manual(did_you_mean(nearest_key(path)))));
    std::string table = nearest(path, declared_tables());
    if (table.empty() && !inner->empty()) {
      const std::string key = nearest_key(path + "." + std::string(inner->begin()->first.str()));
      table = key.substr(0, std::min(key.rfind('.'), key.size()));
    }
    const bool list = table.ends_with("[]");
    const std::string heading = without_brackets(table);
    const std::string written = heading.empty() ? "" : list ? "[[" + heading + "]]" : "[" + heading + "]";
    refuse(node, fmt::format("unknown table [{}]{}", name, or_manual(did_you_mean(written))));
  }

  static std::string without_brackets(std::string_view path) {
    std::string heading;
    bool inside = false;
    for (const char letter : path) {
      if (letter == '[') inside = true;
      if (!inside) heading += letter;
      if (letter == ']') inside = false;
    }
    return heading;
  }

  std::string where(const toml::node& node) const {
    const auto line = node.source().begin.line;
    // Only what an override puts into the tree has no place in the file.
    return line == 0 ? given_.label + ", override" : fmt::format("{}, line {}", given_.label, line);
  }

  [[noreturn]] void refuse(const toml::node& node, const std::string& message) const {
    throw InvalidInput(fmt::format("{}: {}", where(node), message));
  }

  GivenScene& given_;
};

toml::table parse(std::string_view text, const std::string& label) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const auto& place = error.source().begin;
    throw InvalidInput(
        fmt::format("{}, line {}, column {}: not TOML: {}; write one key = value a line, texts in "
                    "double quotes",
                    label, place.line, place.column, one_line(error.description(), 200)));
  }
}

}  // namespace

bool is_table_array(std::string_view path) {
  return is_table(std::string(path) + "[]");
}

GivenScene read_given(std::string_view toml_text, const std::string& label,
                      const std::vector<std::string>& overrides) {
  check_scene_text(toml_text, label);
  toml::table root = parse(toml_text, label);
  if (root.empty())
    throw InvalidInput(
        fmt::format("{} is empty but for comments; write at least one table, for example [geometry]", label));
  for (const std::string& override_text : overrides) apply_override(root, override_text, label);
  GivenScene given;
  given.label = label;
  Walk(given).table(root, "");
  return given;
}

}  // namespace tunica::scene
