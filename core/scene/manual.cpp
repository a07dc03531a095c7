// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "core/scene/message.hpp"
#include "core/scene/parameter.hpp"
#include "core/wall/catalog.hpp"

namespace tunica::scene {

namespace {

constexpr std::string_view introduction = R"(# The parameters of a scene

<!-- Made from core/scene/parameters.cpp and core/wall/catalog.cpp by `tunica_manual docs/parameters.md`. -->

A scene is one TOML file, the same for every tier; `tunica scene SCENE` prints one with every default
filled in. Numbers are in the unit of the table below (CGS), or text with any unit of that dimension:
`thickness = 0.01` and `thickness = "100 um"` are the same. `--set key=value` overrides a key:
`--set tether.stiffness="2e7 dyn/cm3"`, `--set wall.layers[0].stiffness=2e4`.

A known key that the scene's other choices make useless (a fibre angle of an isotropic law, the compliance
of a resistance) is no error: the run remarks on it and goes on without it. Everything else that does not
fit is refused before any work.

What fits but hardly can be meant is computed and remarked on: a number without a unit that is usual in another
one (`pressure = 80` at the outlet, which is 0.06 mmHg; with its unit, `"80 dyn/cm2"`, it is meant), a mean
pressure R Q + p_v outside 30 to 200 mmHg, a ramp longer than the pulse. Remarks are printed before the run and
kept in record.json; after the run it adds what it finds of the last beat.
)";

constexpr std::string_view layers_text = R"(
A layer is a table `[[wall.layers]]`, listed from the lumen outwards. What it does not give it takes from
`[wall]` where that key is set there and the layer has the wall's law; `bulk_modulus`, `exponent`,
`recruitment` and `sharpness` mean the same for every law and are always taken from `[wall]`. What is then
still open is the default of the layer's law.
)";

constexpr std::string_view families_text = R"(
Without families a law with fibres has two, at plus and minus `fiber_angle`. Tables of families replace
them: each gives its angle, and takes what it does not give from its tissue's `fiber_*` and `activation_*`
keys. A layer with the wall's law takes over the wall's families unless it gives families or a
`fiber_angle` of its own.
)";

/// A text that Markdown does not take for the end of a cell.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '|') escaped += '\\';
    escaped += letter;
  }
  return escaped;
}

std::string default_of(const Parameter& parameter) {
  if (!parameter.default_value) return parameter.derived_default;
  const std::string value = fmt::format("`{}`", shown(*parameter.default_value));
  return parameter.derived_default.empty() ? value : value + ", " + parameter.derived_default;
}

std::string allowed_by(const Parameter& parameter) {
  switch (parameter.kind) {
    case Kind::number:
    case Kind::integer:
      return (parameter.kind == Kind::integer ? "whole, " : "") + parameter.bounds.text();
    case Kind::numbers:
      return "list, each " + parameter.bounds.text();
    case Kind::flag:
      return "true, false";
    case Kind::choice:
      return fmt::format("`{}`", fmt::join(parameter.choices, "`, `"));
    case Kind::text:
      return "text";
    case Kind::texts:
      return "list of texts";
  }
  return {};
}

/// "[wall]", "[[wall.layers.families]]": the table as a scene file opens it.
std::string heading_of(std::string_view table) {
  std::string heading;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table.substr(i, 2) == "[]")
      ++i;
    else
      heading += table[i];
  }
  return table.ends_with("[]") ? "[[" + heading + "]]" : "[" + heading + "]";
}

std::string laws() {
  std::string text = "\n## Laws\n\n| law | meaning | defaults |\n|---|---|---|\n";
  for (const wall::LawEntry& law : wall::laws()) {
    std::vector<std::string> defaults;
    for (const wall::LawParameter& parameter : law.parameters)
      defaults.push_back(fmt::format("`{} = {:g}`", parameter.key, parameter.value));
    text += fmt::format("| `{}` | {} | {} |\n", law.name, cell(law.meaning), fmt::join(defaults, ", "));
  }
  return text;
}

}  // namespace

std::string manual() {
  std::string text(introduction);
  std::string_view last;
  for (const Parameter& parameter : parameters()) {
    const std::size_t dot = parameter.key.rfind('.');
    const std::string_view table = std::string_view(parameter.key).substr(0, dot);
    if (table != last) {
      // A heading of brackets alone would be a link.
      text += fmt::format("\n## `{}`\n", heading_of(table));
      if (table == "wall.layers[]") text += layers_text;
      if (table == "wall.families[]") text += families_text;
      text += "\n| key | unit | default | allowed | meaning |\n|---|---|---|---|---|\n";
      last = table;
    }
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", parameter.key.substr(dot + 1), parameter.unit,
                        cell(default_of(parameter)), cell(allowed_by(parameter)), cell(parameter.meaning));
  }
  return text + laws();
}

}  // namespace tunica::scene
