// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace tunica::element {

/// Words and numbers of a Gmsh file, one after the other; every failure is an InvalidInput that names file
/// and line.
class GmshText {
 public:
  GmshText(std::string_view text, std::string label) : rest_(text), label_(std::move(label)) {}

  /// The next word, empty at the end of the text.
  std::string_view word();
  /// True if nothing but blanks is left.
  bool at_end();
  /// Goes to the section's own end, past all that it holds.
  void skip_section(std::string_view section);
  /// Begins a section, which messages then name.
  void enter(std::string_view section) { section_ = section; }
  /// Expects the line that ends the section.
  void leave();

  double real(std::string_view what);
  long integer(std::string_view what, long least, long most);
  /// A number of things that follow, each of which takes at least one character and a blank.
  long count(std::string_view what);
  /// Text between double quotes on the same line.
  std::string quoted(std::string_view what);

  /// Passes over a number that does not matter.
  void skip(std::string_view what) { item(what); }

  [[noreturn]] void refuse(const std::string& why) const;

 private:
  void skip_blanks();
  std::string_view item(std::string_view what);

  std::string_view rest_;
  std::string label_;
  std::string section_;
  long line_ = 1;
};

}  // namespace tunica::element
