// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/element/gmsh_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

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

void GmshReader::refuse(const std::string& why) const {
  // Bytes have no lines.
  if (has_bytes_) throw InvalidInput(fmt::format("{}, byte {}: {}", label_, size_ - rest_.size(), why));
  throw InvalidInput(fmt::format("{}, line {}: {}", label_, line_, why));
}

void GmshReader::skip_blanks() {
  const std::size_t length = std::min(rest_.find_first_not_of(blanks), rest_.size());
  line_ += std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(length), '\n');
  rest_.remove_prefix(length);
}

std::string_view GmshReader::word() {
  skip_blanks();
  const std::string_view found = rest_.substr(0, std::min(rest_.find_first_of(blanks), rest_.size()));
  rest_.remove_prefix(found.size());
  return found;
}

bool GmshReader::at_end() {
  skip_blanks();
  return rest_.empty();
}

bool GmshReader::skip_past(std::string_view line) {
  for (std::size_t at = rest_.find(line); at != std::string_view::npos; at = rest_.find(line, at + 1)) {
    const std::size_t end = at + line.size();
    const auto is_blank = [this](std::size_t k) { return blanks.find(rest_[k]) != std::string_view::npos; };
    if ((at > 0 && !is_blank(at - 1)) || (end < rest_.size() && !is_blank(end))) continue;
    line_ += std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    rest_.remove_prefix(end);
    return true;
  }
  return false;
}

void GmshReader::skip_section(std::string_view section) {
  in_bytes_ = false;
  if (skip_past(fmt::format("$End{}", section))) return;
  rest_.remove_prefix(rest_.size());
  refuse(fmt::format("the file ends inside the section ${}; it is cut off: save it again",
                     scene::one_line(section)));
}

void GmshReader::bytes_follow() {
  const std::size_t end = rest_.find('\n');
  if (end == std::string_view::npos || rest_.find_first_not_of(blanks) < end)
    refuse(fmt::format("the line before the numbers of ${} does not end; save the mesh again", section_));
  ++line_;
  rest_.remove_prefix(end + 1);
  in_bytes_ = has_bytes_ = true;
}

void GmshReader::leave() {
  in_bytes_ = false;
  const std::string end = fmt::format("$End{}", section_);
  const std::string_view found = word();
  if (found.empty()) refuse(fmt::format("the file ends before {}; it is cut off: save it again", end));
  if (found != end)
    refuse(
        fmt::format("{} where {} is expected; the counts of the section do not fit what it holds: save the "
                    "mesh again",
                    scene::in_quotes(found), end));
}

std::string_view GmshReader::item(std::string_view what) {
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

template <class Number>
Number GmshReader::bytes(std::string_view what) {
  Number value;
  if (rest_.size() < sizeof value)
    refuse(fmt::format("the file ends inside the section ${}, before {}; it is cut off: save it again",
                       section_, what));
  std::memcpy(&value, rest_.data(), sizeof value);
  rest_.remove_prefix(sizeof value);
  return value;
}

void GmshReader::skip(std::string_view what) {
  if (in_bytes_)
    bytes<double>(what);
  else
    item(what);
}

double GmshReader::real(std::string_view what) {
  double value = 0;
  std::string_view found;
  if (in_bytes_) {
    value = bytes<double>(what);
  } else {
    found = item(what);
    if (!read(found, value)) refuse(fmt::format("{} = {} is not a number", what, scene::in_quotes(found)));
  }
  constexpr double largest = 1e6;  // cm: 10 km
  if (!(std::abs(value) <= largest))
    refuse(fmt::format("{} = {}; allowed is a finite number up to {:g} cm: repair or remesh the geometry",
                       what, in_bytes_ ? fmt::format("{:g}", value) : scene::one_line(found), largest));
  return value;
}

long GmshReader::whole(std::string_view what, Width width) {
  if (in_bytes_) return width == Width::four ? bytes<std::int32_t>(what) : bytes<std::int64_t>(what);
  const std::string_view found = item(what);
  long value = 0;
  if (!read(found, value))
    refuse(fmt::format("{} = {} is not a whole number", what, scene::in_quotes(found)));
  return value;
}

long GmshReader::integer(std::string_view what, long least, long most, Width width) {
  const long value = whole(what, width);
  if (value < least || value > most)
    refuse(fmt::format("{} = {} is out of range; allowed is {} to {}", what, value, least, most));
  return value;
}

long GmshReader::count(std::string_view what, Width width, std::size_t least_bytes) {
  const std::size_t each = in_bytes_ ? least_bytes : 2;
  const auto most = static_cast<long>(rest_.size() / each);
  long value = 0;
  if (in_bytes_) {
    value = whole(what, width);
  } else {
    const std::string_view found = item(what);
    if (!read(found, value) || value < 0)
      refuse(fmt::format("{} = {} is not a count", what, scene::in_quotes(found)));
  }
  if (value < 0 || value > most)
    refuse(fmt::format("{} = {} but only {} {} follow; the file is cut off or damaged: save it again", what,
                       value, rest_.size(), in_bytes_ ? "bytes" : "characters"));
  return value;
}

std::string GmshReader::quoted(std::string_view what) {
  skip_blanks();
  const std::size_t end = rest_.starts_with('"') ? rest_.find_first_of("\"\n", 1) : std::string_view::npos;
  if (end == std::string_view::npos || rest_[end] != '"')
    refuse(fmt::format("{} is not between double quotes on one line", what));
  std::string text(rest_.substr(1, end - 1));
  rest_.remove_prefix(end + 1);
  return text;
}

}  // namespace tunica::element
