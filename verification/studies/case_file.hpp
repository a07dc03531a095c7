// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::verification {

/// One computation of a study.
struct StudyCase {
  std::string series;  ///< that it belongs to in tables and charts; may be empty
  std::string scene;   ///< name of one of the scenes that come with Tunica
  std::string tier;
  std::vector<std::string> overrides;         ///< "key=value"
  std::map<std::string, std::string> values;  ///< of the names that its entry varies or defines

  /// Throws std::logic_error when the case file gives the name no value for this case.
  const std::string& value(std::string_view name) const;
  double number(std::string_view name) const;
};

/// The cases of a study, from a TOML file. Every table of an array [[GROUP]] stands for one case or more:
///   scene, tier: names
///   series:      text
///   set:         overrides
///   vary:        [["name", "value", ...], ...]: a case for each combination, the last name fastest
///   with:        {name = "value"}: names that have one value in all cases of the table
/// "{name}" in scene, tier, series and set stands for the value.
class CaseFile {
 public:
  /// Without cases.
  CaseFile() = default;
  /// Throws InvalidInput naming file and line, or what a table lacks or has too much.
  explicit CaseFile(const std::filesystem::path& file);

  std::vector<std::string> groups() const;
  /// Throws std::logic_error when there is no such group.
  const std::vector<StudyCase>& group(std::string_view name) const;

 private:
  std::map<std::string, std::vector<StudyCase>, std::less<>> groups_;
};

}  // namespace tunica::verification
