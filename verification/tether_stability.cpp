// SPDX-License-Identifier: GPL-3.0-or-later
// tunica_tether_stability PAGE [FOLDER]: writes the tables of docs/verification/tether-stability.md between
// its marks, and with FOLDER each as FOLDER/NAME.csv beside the growth rates over pressure and wave length.
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "core/observables/result.hpp"
#include "verification/ripple_tables.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

constexpr std::string_view first_mark = "<!-- tables: written by tunica_tether_stability, do not edit -->\n";
constexpr std::string_view last_mark = "<!-- end of tables -->\n";

std::string markdown(const RippleTable& table) {
  std::string text =
      fmt::format("### {}\n\n{}\n\n| {} |\n|", table.title, table.text, fmt::join(table.header, " | "));
  for (std::size_t k = 0; k < table.header.size(); ++k) text += "---|";
  text += "\n";
  for (const auto& row : table.rows) text += fmt::format("| {} |\n", fmt::join(row, " | "));
  return text + "\n";
}

/// Fields that hold a comma are quoted.
std::string csv(const RippleTable& table) {
  const auto line = [](const std::vector<std::string>& fields) {
    std::string text;
    for (const std::string& field : fields) {
      if (&field != &fields.front()) text += ',';
      text += field.find(',') == std::string::npos ? field : '"' + field + '"';
    }
    return text + '\n';
  };
  std::string text = line(table.header);
  for (const auto& row : table.rows) text += line(row);
  return text;
}

std::string with_tables(const std::string& page, const std::vector<RippleTable>& tables) {
  const std::size_t begin = page.find(first_mark), end = page.find(last_mark);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw std::runtime_error(fmt::format("the page lacks the marks {} and {}", first_mark, last_mark));
  std::string text = page.substr(0, begin + first_mark.size()) + "\n";
  for (const RippleTable& table : tables) text += markdown(table);
  return text + page.substr(end);
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2 || count > 3) {
    fmt::print(stderr, "usage: tunica_tether_stability PAGE [FOLDER]\n");
    return 2;
  }
  try {
    std::ifstream file(arguments[1]);
    if (!file) throw std::runtime_error(fmt::format("{} cannot be read", arguments[1]));
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    const auto tables = ripple_tables();
    write_whole(arguments[1], with_tables(page, tables));
    if (count == 2) return 0;
    const std::filesystem::path folder = arguments[2];
    std::filesystem::create_directories(folder);
    for (const RippleTable& table : tables) write_whole(folder / (table.name + ".csv"), csv(table));
    const RippleTable map = growth_map();
    write_whole(folder / (map.name + ".csv"), csv(map));
  } catch (const std::exception& error) {
    fmt::print(stderr, "tunica_tether_stability: {}\n", error.what());
    return 2;
  }
  return 0;
}
