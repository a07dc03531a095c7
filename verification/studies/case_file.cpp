// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/studies/case_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/error.hpp"

namespace tunica::verification {

namespace {

using Values = std::map<std::string, std::string>;

class TableReader {
 public:
  TableReader(const toml::table& table, std::string where) : table_(table), where_(std::move(where)) {
    constexpr std::array known{"scene", "tier", "series", "set", "vary", "with"};
    for (const auto& entry : table_)
      if (std::find(known.begin(), known.end(), entry.first.str()) == known.end())
        refuse(fmt::format("{} is no entry of a case; there are: {}", std::string(entry.first.str()),
                           "scene, tier, series, set, vary, with"));
  }

  std::vector<StudyCase> cases() const {
    std::vector<Values> combinations{constants()};
    if (const toml::node* vary = table_.get("vary")) {
      for (const toml::node& axis : array(*vary, "vary")) {
        const std::vector<std::string> texts = strings(axis, "vary");
        if (texts.size() < 2) refuse("vary: each list is a name and its values");
        std::vector<Values> more;
        for (const Values& values : combinations)
          for (auto value = texts.begin() + 1; value != texts.end(); ++value) {
            more.push_back(values);
            more.back()[texts.front()] = *value;
          }
        combinations = std::move(more);
      }
    }
    std::vector<StudyCase> all;
    for (const Values& values : combinations) {
      StudyCase made{filled(text("series", ""), values),
                     filled(text("scene"), values),
                     filled(text("tier"), values),
                     {},
                     values};
      if (const toml::node* set = table_.get("set"))
        for (const std::string& one : strings(*set, "set")) made.overrides.push_back(filled(one, values));
      all.push_back(std::move(made));
    }
    return all;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InvalidInput(fmt::format("{}: {}", where_, why));
  }
  const toml::array& array(const toml::node& node, const char* name) const {
    const toml::array* found = node.as_array();
    if (!found) refuse(fmt::format("{} is no list", name));
    return *found;
  }
  std::vector<std::string> strings(const toml::node& node, const char* name) const {
    std::vector<std::string> all;
    for (const toml::node& one : array(node, name)) {
      const auto value = one.value_exact<std::string>();
      if (!value) refuse(fmt::format("{} holds something else than text", name));
      all.push_back(*value);
    }
    return all;
  }
  std::string text(const char* name, const char* otherwise = nullptr) const {
    const toml::node* node = table_.get(name);
    const auto value = node ? node->value_exact<std::string>() : std::nullopt;
    if (value) return *value;
    if (node || !otherwise) refuse(fmt::format("{} has to be there, as text", name));
    return otherwise;
  }
  Values constants() const {
    Values all;
    const toml::node* with = table_.get("with");
    if (!with) return all;
    if (!with->is_table()) refuse("with is no table");
    for (const auto& [name, node] : *with->as_table()) {
      const auto value = node.value_exact<std::string>();
      if (!value) refuse("with holds something else than text");
      all.emplace(name.str(), *value);
    }
    return all;
  }
  std::string filled(std::string text, const Values& values) const {
    for (const auto& [name, value] : values) {
      const std::string mark = '{' + name + '}';
      for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
        text.replace(at, mark.size(), value);
    }
    if (text.find('{') != std::string::npos) refuse(fmt::format("{}: a name without a value", text));
    return text;
  }

  const toml::table& table_;
  std::string where_;
};

}  // namespace

const std::string& StudyCase::value(std::string_view name) const {
  const auto found = values.find(std::string(name));
  if (found == values.end()) throw std::logic_error(fmt::format("a case without {}", name));
  return found->second;
}

double StudyCase::number(std::string_view name) const {
  return std::stod(value(name));
}

CaseFile::CaseFile(const std::filesystem::path& file) {
  toml::table root;
  try {
    root = toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    throw InvalidInput(fmt::format("{}, line {}: {}", file.string(), error.source().begin.line,
                                   std::string(error.description())));
  }
  for (const auto& [name, node] : root) {
    const std::string group(name.str());
    const toml::array* tables = node.as_array();
    if (!tables || !tables->is_array_of_tables())
      throw InvalidInput(
          fmt::format("{}: {} is no group of cases: write [[{}]]", file.string(), group, group));
    for (const toml::node& table : *tables) {
      const TableReader reader(*table.as_table(), fmt::format("{}, line {}, [[{}]]", file.string(),
                                                              table.source().begin.line, group));
      for (StudyCase& one : reader.cases()) groups_[group].push_back(std::move(one));
    }
  }
}

std::vector<std::string> CaseFile::groups() const {
  std::vector<std::string> names;
  for (const auto& [name, cases] : groups_) names.push_back(name);
  return names;
}

const std::vector<StudyCase>& CaseFile::group(std::string_view name) const {
  const auto found = groups_.find(name);
  if (found == groups_.end()) throw std::logic_error(fmt::format("a case file without [[{}]]", name));
  return found->second;
}

}  // namespace tunica::verification
