// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/message.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

namespace tunica::scene {

namespace {

/// Bytes of the UTF-8 character at the start of `text`, 0 when there is none.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead < 0x80             ? 1
                             : (lead & 0xe0) == 0xc0 ? 2
                             : (lead & 0xf0) == 0xe0 ? 3
                             : (lead & 0xf8) == 0xf0 ? 4
                                                     : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return 0;
  return length;
}

/// U+0080 to U+009F control terminals, and U+2028 and U+2029 break lines in some of them.
bool breaks_lines(std::string_view character) {
  if (character.size() == 1) return std::iscntrl(static_cast<unsigned char>(character.front())) != 0;
  if (character.size() == 2) return character[0] == '\xc2' && static_cast<unsigned char>(character[1]) < 0xa0;
  return character == "\xe2\x80\xa8" || character == "\xe2\x80\xa9";
}

char lower(char letter) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

}  // namespace

std::string one_line(std::string_view text, std::size_t longest) {
  std::string line;
  std::size_t characters = 0;
  while (!text.empty()) {
    if (characters++ == longest) return line + "...";
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    if (length == 0 || breaks_lines(character)) {
      for (const char byte : character) line += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    } else {
      line += character;
    }
    text.remove_prefix(character.size());
  }
  return line;
}

std::string in_quotes(std::string_view text) {
  return fmt::format("\"{}\"", one_line(text));
}

std::size_t edit_distance(std::string_view left, std::string_view right) {
  std::vector<std::size_t> before(right.size() + 1), last(right.size() + 1), row(right.size() + 1);
  for (std::size_t j = 0; j <= right.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= left.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= right.size(); ++j) {
      const bool same = lower(left[i - 1]) == lower(right[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(left[i - 1]) == lower(right[j - 2]) &&
                           lower(left[i - 2]) == lower(right[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[right.size()];
}

std::string nearest(std::string_view word, std::span<const std::string> known) {
  constexpr std::size_t longest_word = 200;
  if (word.empty() || word.size() > longest_word) return {};
  std::string best;
  std::size_t best_distance = longest_word;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(word, candidate);
    const std::size_t limit = std::max<std::size_t>(1, std::max(word.size(), candidate.size()) / 3);
    if (distance <= limit && distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view suggestion) {
  return suggestion.empty() ? std::string{} : fmt::format("; did you mean {}?", suggestion);
}

std::string shown(const Value& value) {
  struct Show {
    std::string operator()(double number) const { return fmt::format("{:.10g}", number); }
    std::string operator()(long number) const { return fmt::format("{}", number); }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(const std::string& text) const { return in_quotes(text); }
    std::string operator()(const std::vector<double>& numbers) const {
      return one_line(fmt::format("[{:.10g}]", fmt::join(numbers, ", ")));
    }
    std::string operator()(const std::vector<std::string>& texts) const {
      std::vector<std::string> each;
      for (const std::string& text : texts) each.push_back(in_quotes(text));
      return one_line(fmt::format("[{}]", fmt::join(each, ", ")));
    }
  };
  return std::visit(Show{}, value);
}

std::string with_unit(double value, std::string_view unit) {
  if (unit.empty() || unit == "1") return fmt::format("{:.10g}", value);
  return fmt::format("{:.10g} {}", value, unit);
}

}  // namespace tunica::scene
