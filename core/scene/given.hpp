// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/parameter.hpp"

namespace tunica::scene {

/// A value that a scene file or an override gives.
struct GivenValue {
  Value value;
  std::string where;      ///< "cylinder.toml, line 3", for messages
  bool is_plain = false;  ///< a number without a unit
};

/// What a scene file and its overrides say: every key declared, every value of its kind, in CGS units
/// and within its bounds. Nothing is filled in yet.
struct GivenScene {
  std::string label;  ///< the file, for messages
  std::map<std::string, GivenValue, std::less<>> values;
  std::map<std::string, std::size_t, std::less<>> counts;  ///< tables in each array of tables

  const GivenValue* find(std::string_view key) const {
    const auto entry = values.find(key);
    return entry == values.end() ? nullptr : &entry->second;
  }
  std::size_t count(std::string_view array) const {
    const auto entry = counts.find(array);
    return entry == counts.end() ? 0 : entry->second;
  }
};

/// Parses TOML text, applies "key=value" overrides and checks each value by itself.
/// Throws InvalidInput: one line with place, key, value, what is allowed and the nearest known name.
GivenScene read_given(std::string_view toml_text, const std::string& label,
                      const std::vector<std::string>& overrides);

/// True for the path of an array of tables: "wall.layers", "wall.layers[0].families".
bool is_table_array(std::string_view path);

}  // namespace tunica::scene
