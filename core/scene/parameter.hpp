// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tunica::scene {

/// What a scene file may hold at a key.
using Value = std::variant<double, long, bool, std::string, std::vector<double>, std::vector<std::string>>;

enum class Kind { number, integer, flag, choice, text, numbers, texts };

/// Interval of allowed numbers. A closed end is allowed itself, an open end is not.
struct Bounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  bool contains(double value) const;
  /// For messages and the manual: "> 0", "0 to 90", "1 or more".
  std::string text() const;
};

/// One entry of a scene: the single place where its name, unit, default, range and meaning stand.
/// The reader, the checks, `tunica scene` and docs/parameters.md are all made from it.
///
/// A key such as "wall.layers[].fraction" belongs to an array of tables; `[]` stands for the index.
struct Parameter {
  std::string key;
  Kind kind = Kind::number;
  std::string unit = "1";              ///< UDUNITS text of the CGS unit that plain numbers are in
  std::optional<Value> default_value;  ///< empty: derived (see derived_default) or none
  std::string derived_default;         ///< how the default follows from other keys, for the manual
  Bounds bounds;                       ///< for number, integer and numbers
  std::vector<std::string> choices;    ///< for choice
  std::string meaning;                 ///< one or two sentences for users
};

/// Every parameter of a scene, in the order of the manual.
std::span<const Parameter> parameters();

/// The declaration of a key; indices in brackets ("wall.layers[2].fraction") match `[]`.
/// Null when there is none.
const Parameter* find_parameter(std::string_view key);

/// A key as it is declared: "wall.layers[].fraction" for "wall.layers[2].fraction". Brackets that hold
/// anything but digits stay as they are, and so match no declaration.
std::string declared_form(std::string_view key);

/// The known key nearest to a misspelt one (edit distance), empty when none is near.
std::string nearest_key(std::string_view key);

}  // namespace tunica::scene
