// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/element/gmsh_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.hpp"
#include "core/scene/message.hpp"

namespace tunica::element {

namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

template <class Number>
bool read(std::string_view word, Number& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

}  // namespace

void GmshText::refuse(const std::string& why) const {
  throw InvalidInput(fmt::format("{}, line {}: {}", label_, line_, why));
}

void GmshText::skip_blanks() {
  const std::size_t length = std::min(rest_.find_first_not_of(blanks), rest_.size());
  line_ += std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(length), '\n');
  rest_.remove_prefix(length);
}

std::string_view GmshText::word() {
  skip_blanks();
  const std::string_view found = rest_.substr(0, std::min(rest_.find_first_of(blanks), rest_.size()));
  rest_.remove_prefix(found.size());
  return found;
}

bool GmshText::at_end() {
  skip_blanks();
  return rest_.empty();
}

void GmshText::skip_section(std::string_view section) {
  const std::string end = fmt::format("$End{}", section);
  for (std::string_view next = word(); next != end; next = word())
    if (next.empty())
      refuse(fmt::format("the file ends inside the section ${}; it is cut off: save it again",
                         scene::one_line(section)));
}

void GmshText::leave() {
  const std::string end = fmt::format("$End{}", section_);
  const std::string_view found = word();
  if (found.empty()) refuse(fmt::format("the file ends before {}; it is cut off: save it again", end));
  if (found != end)
    refuse(
        fmt::format("{} where {} is expected; the counts of the section do not fit what it holds: save the "
                    "mesh again",
                    scene::in_quotes(found), end));
}

std::string_view GmshText::item(std::string_view what) {
  const std::string_view found = word();
  if (found.empty())
    refuse(fmt::format("the file ends inside the section ${}, before {}; it is cut off: save it again",
                       section_, what));
  if (found.starts_with('$'))
    refuse(fmt::format(
        "{} where {} is expected; the section ${} holds less than it announces: save the mesh again",
        scene::in_quotes(found), what, section_));
  return found;
}

double GmshText::real(std::string_view what) {
  const std::string_view found = item(what);
  double value = 0;
  if (!read(found, value)) refuse(fmt::format("{} = {} is not a number", what, scene::in_quotes(found)));
  constexpr double largest = 1e6;  // cm: 10 km
  if (!(std::abs(value) <= largest))
    refuse(fmt::format("{} = {}; allowed is a finite number up to {:g} cm: repair or remesh the geometry",
                       what, scene::one_line(found), largest));
  return value;
}

long GmshText::integer(std::string_view what, long least, long most) {
  const std::string_view found = item(what);
  long value = 0;
  if (!read(found, value))
    refuse(fmt::format("{} = {} is not a whole number", what, scene::in_quotes(found)));
  if (value < least || value > most)
    refuse(fmt::format("{} = {} is out of range; allowed is {} to {}", what, value, least, most));
  return value;
}

long GmshText::count(std::string_view what) {
  const auto most = static_cast<long>(rest_.size() / 2);
  const std::string_view found = item(what);
  long value = 0;
  if (!read(found, value) || value < 0)
    refuse(fmt::format("{} = {} is not a count", what, scene::in_quotes(found)));
  if (value > most)
    refuse(fmt::format("{} = {} but only {} characters follow; the file is cut off or damaged: save it again",
                       what, value, rest_.size()));
  return value;
}

std::string GmshText::quoted(std::string_view what) {
  skip_blanks();
  const std::size_t end = rest_.starts_with('"') ? rest_.find_first_of("\"\n", 1) : std::string_view::npos;
  if (end == std::string_view::npos || rest_[end] != '"')
    refuse(fmt::format("{} is not between double quotes on one line", what));
  std::string text(rest_.substr(1, end - 1));
  rest_.remove_prefix(end + 1);
  return text;
}

}  // namespace tunica::element
