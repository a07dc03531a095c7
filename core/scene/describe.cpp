// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/scene/message.hpp"
#include "core/scene/scene.hpp"

namespace tunica {

namespace {

using scene::Parameter;

std::string toml_text(const std::string& text) {
  std::string written = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') written += '\\';
    written += letter;
  }
  return written + '"';
}

/// The fewest digits that read back as the same number; people's powers of ten stay readable.
std::string toml_number(double number) {
  const double size = std::abs(number);
  const bool plain = size == 0 || (size >= 1e-3 && size < 1e6);
  if (plain) return fmt::format("{}", number);
  std::string shortest = fmt::format("{}", number);
  // "{:e}" alone would pad with zeros; the precision follows from the digits that are needed.
  for (int digits = 0; digits <= 16; ++digits) {
    shortest = fmt::format("{:.{}e}", number, digits);
    if (std::stod(shortest) == number) break;
  }
  return shortest;
}

std::string toml_value(const scene::Value& value) {
  struct Write {
    std::string operator()(double number) const { return toml_number(number); }
    std::string operator()(long number) const { return fmt::format("{}", number); }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(const std::string& text) const { return toml_text(text); }
    std::string operator()(const std::vector<double>& numbers) const {
      std::vector<std::string> each;
      for (const double number : numbers) each.push_back(toml_number(number));
      return fmt::format("[{}]", fmt::join(each, ", "));
    }
    std::string operator()(const std::vector<std::string>& texts) const {
      std::vector<std::string> each;
      for (const std::string& text : texts) each.push_back(toml_text(text));
      return fmt::format("[{}]", fmt::join(each, ", "));
    }
  };
  return std::visit(Write{}, value);
}

std::string bracketed_unit(const Parameter& parameter) {
  return parameter.unit.empty() || parameter.unit == "1" ? std::string{}
                                                         : fmt::format("[{}]", parameter.unit);
}

/// "[cm] Inner radius ...", with what can be chosen.
std::string comment_for(const Parameter& parameter) {
  std::string comment = bracketed_unit(parameter);
  if (!comment.empty()) comment += ' ';
  comment += parameter.meaning;
  if (!parameter.choices.empty()) comment += fmt::format(" One of: {}.", fmt::join(parameter.choices, ", "));
  return comment;
}

/// The declared table of a parameter: "wall.layers[]" of "wall.layers[].law".
std::string_view table_of(const Parameter& parameter) {
  return std::string_view(parameter.key).substr(0, parameter.key.rfind('.'));
}

class Description {
 public:
  explicit Description(const Scene& scene) : scene_(scene) {}

  std::string write() {
    text_ = fmt::format(
        "# Scene {}: every value that it computes with, defaults included. Numbers are in the unit\n"
        "# in brackets; text with another unit, such as \"75 mmHg\", may stand in their place.\n",
        scene_.name());
    for (const Parameter& parameter : scene::parameters()) {
      const std::string_view table = table_of(parameter);
      if (table == last_table_ || table.find("[]") != std::string_view::npos) continue;
      last_table_ = table;
      write_table(std::string(table), fmt::format("[{}]", table), table);
      if (table == "wall") write_wall_arrays();
    }
    return text_;
  }

 private:
  void write_wall_arrays() {
    write_array("wall.families", "wall.families[]");
    for (std::size_t i = 0; i < scene_.count("wall.layers"); ++i) {
      const std::string layer = fmt::format("wall.layers[{}]", i);
      write_table(layer, "[[wall.layers]]", "wall.layers[]");
      write_array(layer + ".families", "wall.layers[].families[]");
    }
  }

  void write_array(const std::string& path, std::string_view declared) {
    const std::string heading =
        path.starts_with("wall.layers") ? "[[wall.layers.families]]" : "[[wall.families]]";
    for (std::size_t i = 0; i < scene_.count(path); ++i)
      write_table(fmt::format("{}[{}]", path, i), heading, declared);
  }

  void write_table(const std::string& path, const std::string& heading, std::string_view declared) {
    text_ += "\n" + heading + "\n";
    // The second layer needs no explanation any more.
    const bool explained = !explained_.insert(std::string(declared)).second;
    for (const Parameter& parameter : scene::parameters()) {
      if (table_of(parameter) != declared) continue;
      const std::string name = parameter.key.substr(declared.size() + 1);
      const std::string key = path + "." + name;
      const auto value = scene_.values().find(key);
      if (value == scene_.values().end()) continue;
      const std::string line =
          fmt::format("{}{} = {}", overshadowed(path, name) && !scene_.was_set(key) ? "# " : "", name,
                      toml_value(value->second));
      constexpr int comment_column = 38;
      const std::string comment = explained ? bracketed_unit(parameter) : comment_for(parameter);
      text_ += comment.empty() ? line + "\n" : fmt::format("{:<{}}  # {}\n", line, comment_column, comment);
    }
  }

  /// A default of the whole wall that no layer uses: written as a comment, or reading it back would
  /// remark on it. The default fills it in again.
  bool overshadowed(const std::string& path, const std::string& name) const {
    return path == "wall" && scene_.count("wall.layers") > 0 && name != "law" &&
           scene::find_parameter("wall.layers[0]." + name) != nullptr;
  }

  const Scene& scene_;
  std::string text_;
  std::string_view last_table_;
  std::set<std::string> explained_;
};

}  // namespace

std::string describe(const Scene& scene) {
  return Description(scene).write();
}

}  // namespace tunica
