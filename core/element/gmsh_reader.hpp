// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace tunica::element {

/// Words and numbers of a Gmsh file, one after the other; every failure is an InvalidInput that names file
/// and line, or byte of a binary file. Binary files keep their words and the sections that hold names as
/// text, and have the numbers of other sections as bytes.
class GmshReader {
 public:
  /// Bytes of a whole number in binary files.
  enum class Width { four = 4, eight = 8 };

  GmshReader(std::string_view text, std::string label)
      : rest_(text), size_(text.size()), label_(std::move(label)) {}

  /// The next word, empty at the end of the text.
  std::string_view word();
  /// True if nothing but blanks is left.
  bool at_end();
  /// Goes to the section's own end, past all that it holds.
  void skip_section(std::string_view section);
  /// Goes past the line that ends another section, which is left unread; false if there is none.
  bool skip_past(std::string_view line);
  /// Begins a section, which messages then name.
  void enter(std::string_view section) { section_ = section; }
  /// Expects the line that ends the section.
  void leave();

  /// Numbers are bytes in this machine's order from the next line to leave().
  void bytes_follow();

  double real(std::string_view what);
  long integer(std::string_view what, long least, long most, Width width = Width::four);
  /// A number of things that follow, each of which takes at least one character and a blank, or in binary
  /// files so many bytes.
  long count(std::string_view what, Width width = Width::eight, std::size_t least_bytes = 4);
  /// Text between double quotes on the same line.
  std::string quoted(std::string_view what);

  /// Passes over a number with a fraction that does not matter.
  void skip(std::string_view what);

  [[noreturn]] void refuse(const std::string& why) const;

 private:
  void skip_blanks();
  std::string_view item(std::string_view what);
  /// The next bytes as they stand in memory.
  template <class Number>
  Number bytes(std::string_view what);
  long whole(std::string_view what, Width width);

  std::string_view rest_;
  std::size_t size_;
  std::string label_;
  std::string section_;
  long line_ = 1;
  bool in_bytes_ = false;   ///< numbers are, here
  bool has_bytes_ = false;  ///< somewhere before
};

}  // namespace tunica::element
