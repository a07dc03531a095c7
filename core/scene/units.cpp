// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/scene/message.hpp"
#include "core/scene/scene.hpp"
#include "core/units.hpp"

namespace tunica {

namespace {

using scene::in_quotes;
using scene::one_line;

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeSystem {
  void operator()(ut_system* system) const { ut_free_system(system); }
};
struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

/// The UDUNITS-2 database with the names that people who work with blood flow write. Loading it
/// takes milliseconds, as long as a whole 0D run, so it is loaded when the first unit is met.
class UnitDatabase {
 public:
  UnitDatabase() : system_((ut_set_error_message_handler(ut_ignore), ut_read_xml(nullptr))) {
    if (!system_)
      throw InvalidInput(
          "the UDUNITS-2 unit database cannot be read: set UDUNITS2_XML_PATH to udunits2.xml or write "
          "numbers without units (CGS)");
    name_unit("dyn", "dyne");
    name_unit("deg", "arc_degree");
    name_unit("P", "poise");
    // UDUNITS derives mmHg from densities and gets another eighth digit than the project's value.
    name_unit("mmHg", fmt::format("{} dyne/cm2", mmhg));
    name_unit("mmH2O", "0.1 cmH2O");
    name_unit("inH2O", "2.54 cmH2O");
    name_unit("Ba", "barye");
    name_unit("Pas", "Pa s");
    name_unit("PRU", "mmHg s/ml");
    name_unit("WU", "mmHg min/l");
  }

  Unit parse(const std::string& text) const {
    const bool ascii = std::all_of(text.begin(), text.end(), [](char c) { return (c & 0x80) == 0; });
    return Unit(ut_parse(system_.get(), text.c_str(), ascii ? UT_ASCII : UT_UTF8));
  }

 private:
  void name_unit(const char* name, const std::string& definition) {
    const Unit unit = parse(definition);
    const Unit before(unit ? ut_get_unit_by_symbol(system_.get(), name) : nullptr);
    if (!unit || (before && ut_unmap_symbol_to_unit(system_.get(), name, UT_ASCII) != UT_SUCCESS) ||
        ut_map_symbol_to_unit(name, UT_ASCII, unit.get()) != UT_SUCCESS)
      throw InvalidInput(fmt::format(
          "the UDUNITS-2 unit database cannot take {} as a name of {}: set UDUNITS2_XML_PATH to udunits2.xml",
          name, definition));
  }

  std::unique_ptr<ut_system, FreeSystem> system_;
};

/// The base units of a unit without its scale: "rad" for degrees, empty for a percentage. UDUNITS
/// itself counts angles and plain ratios as one dimension.
std::string base_units(const Unit& unit) {
  std::array<char, 256> text{};
  const int length = ut_format(unit.get(), text.data(), text.size(), UT_ASCII | UT_DEFINITION);
  if (length < 0 || static_cast<std::size_t>(length) >= text.size()) return "?";
  std::string_view units(text.data(), static_cast<std::size_t>(length));
  // "0.01 1" for a percentage: the scale, and the unit of a plain number.
  for (std::errc error{}; error == std::errc{};) {
    double scale = 0;
    const auto number = std::from_chars(units.data(), units.data() + units.size(), scale);
    error = number.ec;
    if (error == std::errc{}) units.remove_prefix(static_cast<std::size_t>(number.ptr - units.data()));
    while (!units.empty() && units.front() == ' ') units.remove_prefix(1);
  }
  return std::string(units);
}

/// The factor from one unit to another, empty when the dimensions differ. Conversions with an offset
/// (temperatures, time stamps) and between reciprocals (s and Hz) are none that a scene can mean.
std::optional<double> factor_between(const Unit& from, const Unit& to) {
  if (!ut_are_convertible(from.get(), to.get())) return std::nullopt;
  if (base_units(from) != base_units(to)) return std::nullopt;
  const Converter converter(ut_get_converter(from.get(), to.get()));
  if (!converter) return std::nullopt;
  const double zero = cv_convert_double(converter.get(), 0.0);
  const double one = cv_convert_double(converter.get(), 1.0);
  const double two = cv_convert_double(converter.get(), 2.0);
  const bool linear = zero == 0.0 && std::abs(two - 2 * one) <= 1e-12 * std::abs(one);
  return linear ? std::optional(one) : std::nullopt;
}

/// Unit text as UDUNITS reads it: papers write "dyn·s/cm⁵", of which it knows ² and ³ alone.
std::string in_ascii(std::string unit) {
  constexpr std::pair<std::string_view, std::string_view> signs[] = {
      {"⁰", "0"}, {"¹", "1"}, {"²", "2"}, {"³", "3"}, {"⁴", "4"}, {"⁵", "5"}, {"⁶", "6"}, {"⁷", "7"},
      {"⁸", "8"}, {"⁹", "9"}, {"⁻", "-"}, {"⁺", "+"}, {"−", "-"}, {"·", "."}, {"⋅", "."}, {"×", "*"}};
  for (const auto& [sign, ascii] : signs)
    for (std::size_t at = unit.find(sign); at != std::string::npos; at = unit.find(sign, at + ascii.size()))
      unit.replace(at, sign.size(), ascii);
  return unit;
}

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}
/// A letter of a unit's name; bytes beyond ASCII are of µ, °, Å and the like.
bool is_letter(char letter) {
  return std::isalpha(static_cast<unsigned char>(letter)) != 0 || letter == '_' || (letter & 0x80) != 0;
}

/// Whether a number stands where UDUNITS would multiply by it: "mmHg -10", "cm3.5", "s 2", "ml/60". Digits
/// belong to a name ("cmH2O") or are a whole exponent right behind what they raise, a sign, ^ or ** at most
/// in between ("cm3", "cm-3", "cm^3", "s**-2", "(cm s)2").
bool multiplies_by_number(std::string_view unit) {
  for (std::size_t i = 0; i < unit.size(); ++i) {
    if (!is_digit(unit[i])) continue;
    std::string_view before = unit.substr(0, i);
    if (before.ends_with('-') || before.ends_with('+')) before.remove_suffix(1);
    if (before.ends_with("**"))
      before.remove_suffix(2);
    else if (before.ends_with('^'))
      before.remove_suffix(1);
    if (before.empty() || !(is_letter(before.back()) || before.back() == ')')) return true;
    while (i + 1 < unit.size() && is_digit(unit[i + 1])) ++i;
  }
  return false;
}

/// The names in a unit's text without their exponents: "dyn", "s" and "cm" of "dyn s/cm5".
std::vector<std::string> names_in(std::string_view unit) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    if (!is_letter(unit[i])) continue;
    std::size_t end = i;
    while (end < unit.size() && (is_letter(unit[end]) || is_digit(unit[end]))) ++end;
    std::string name(unit.substr(i, end - i));
    while (is_digit(name.back())) name.pop_back();
    names.push_back(std::move(name));
    i = end;
  }
  return names;
}

/// A known unit that a misspelt one of the text was probably meant to be.
std::string suggestion_for(const UnitDatabase& database, std::string_view unit) {
  static const std::vector<std::string> common{
      "mmHg", "cmH2O", "mmH2O", "kPa", "hPa", "MPa", "Pa",  "bar", "mbar", "torr", "dyn", "N",   "mN", "cm",
      "mm",   "um",    "ml",    "l",   "s",   "ms",  "min", "g",   "kg",   "cP",   "P",   "deg", "rad"};
  for (const std::string& name : names_in(unit))
    if (!database.parse(name))
      if (const std::string near = scene::nearest(name, common); !near.empty()) return in_quotes(near);
  return {};
}

/// Whether a part of the unit is a mere number to UDUNITS: "ppm mmHg", "count/s", "% mmHg".
bool holds_number_by_name(const UnitDatabase& database, std::string_view unit) {
  if (unit.find('%') != std::string_view::npos) return true;
  const std::vector<std::string> names = names_in(unit);
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    const Unit part = database.parse(name);
    return part && ut_is_dimensionless(part.get()) && base_units(part).empty();
  });
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

}  // namespace

double unit_factor(const std::string& text, const std::string& target, const std::string& complaint,
                   const std::string& remedy) {
  if (text == target) return 1;
  // UDUNITS' scanner echoes control characters to the standard output.
  if (one_line(text) != text)
    throw InvalidInput(fmt::format("{}: the unit holds a control character; {}", complaint, remedy));
  const std::string unit = in_ascii(text);
  if (multiplies_by_number(unit))
    throw InvalidInput(fmt::format("{}: {} is not a unit alone: it holds a number, which would multiply; {}",
                                   complaint, in_quotes(text), remedy));
  // UDUNITS keeps one parser state for the whole process.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  static const UnitDatabase database;
  const Unit from = database.parse(unit);
  if (!from)
    throw InvalidInput(fmt::format(
        "{}: the unit {} is not known{}; use {} or another UDUNITS-2 name", complaint, in_quotes(text),
        scene::did_you_mean(suggestion_for(database, unit)), target == "1" ? "no unit or %" : target));
  const bool ratio = target == "1";
  if (!ratio && holds_number_by_name(database, unit))
    throw InvalidInput(fmt::format("{}: a part of the unit {} is a mere number, which would multiply; {}",
                                   complaint, in_quotes(text), remedy));
  const std::optional<double> factor = factor_between(from, database.parse(target));
  if (!factor)
    throw InvalidInput(
        ratio ? fmt::format("{}: {} is not a unit of a plain ratio; write the number alone or with %",
                            complaint, in_quotes(text))
              : fmt::format("{}: {} has another dimension than {}; {}", complaint, in_quotes(text), target,
                            remedy));
  return *factor;
}

double convert_quantity(std::string_view text, const std::string& target_unit, std::string_view key) {
  const bool ratio = target_unit == "1";
  const std::string complaint = fmt::format("{} = {}", one_line(key), in_quotes(text));
  const std::string remedy =
      ratio ? "write a number, or a percentage such as \"1%\""
            : fmt::format("write a number in {0}, or a number with a unit such as \"1 {0}\"", target_unit);
  // Far beyond any unit that people write, and short enough for UDUNITS' recursive parser.
  constexpr std::size_t longest_quantity = 100;
  std::string_view rest = trimmed(text);
  if (rest.size() > longest_quantity) throw InvalidInput(fmt::format("{}: too long; {}", complaint, remedy));
  if (rest.starts_with('+')) rest.remove_prefix(1);

  double value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error == std::errc::result_out_of_range)
    throw InvalidInput(fmt::format("{}: the number is too large or too small; {}", complaint, remedy));
  if (error != std::errc{})
    throw InvalidInput(fmt::format("{}: not a number with a unit; {}", complaint, remedy));
  if (!std::isfinite(value))
    throw InvalidInput(fmt::format("{}: not a finite number; {}", complaint, remedy));
  const std::string unit(trimmed(rest.substr(static_cast<std::size_t>(end - rest.data()))));

  if (unit.empty()) {
    if (ratio) return value;
    throw InvalidInput(fmt::format("{}: a number in quotes needs a unit; {}", complaint, remedy));
  }
  if (ratio && unit == "%") return value / 100;
  // "1 000 cm" is no thousand centimetres but nothing.
  const bool begins_like_number =
      std::string_view("0123456789+-.,_").find(unit.front()) != std::string_view::npos;
  if (begins_like_number)
    throw InvalidInput(fmt::format("{}: not one number with a unit; {}", complaint, remedy));
  const double converted =
      value * unit_factor(unit, target_unit, complaint,
                          fmt::format("write the number alone (in {}) or with a unit of that dimension",
                                      target_unit));
  if (!std::isfinite(converted))
    throw InvalidInput(fmt::format("{}: too large once in {}; {}", complaint, target_unit, remedy));
  return converted;
}

}  // namespace tunica
