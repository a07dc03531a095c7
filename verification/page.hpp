// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::verification {

/// A documentation page of which a program writes a part: what stands between the lines
/// "<!-- PART: written by PROGRAM, do not edit -->" and "<!-- end of PART -->".
class Page {
 public:
  /// Throws std::runtime_error when the file cannot be read or lacks the lines.
  Page(std::filesystem::path file, const std::string& part, const std::string& program);
  /// Throws OutputFailure.
  void write(const std::string& text) const;

 private:
  std::filesystem::path file_;
  std::string before_, after_;
};

/// A table in Markdown, with an empty line after it.
std::string markdown_table(const std::vector<std::string>& header,
                           const std::vector<std::vector<std::string>>& rows);

}  // namespace tunica::verification
