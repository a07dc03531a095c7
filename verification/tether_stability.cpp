// SPDX-License-Identifier: GPL-3.0-or-later
// tunica_tether_stability PAGE [FOLDER]: writes the tables of docs/verification/tether-stability.md between
// its marks, and with FOLDER each as FOLDER/NAME.csv beside the growth rates over pressure and wave length.
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <string>

#include "core/observables/result.hpp"
#include "verification/page.hpp"
#include "verification/ripple_tables.hpp"

using namespace tunica;
using namespace tunica::verification;

namespace {

std::string markdown(const RippleTable& table) {
  return fmt::format("### {}\n\n{}\n\n", table.title, table.text) + markdown_table(table.header, table.rows);
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

}  // namespace

int main(int count, char** arguments) {
  if (count < 2 || count > 3) {
    fmt::print(stderr, "usage: tunica_tether_stability PAGE [FOLDER]\n");
    return 2;
  }
  try {
    const Page page(arguments[1], "tables", "tunica_tether_stability");
    const auto tables = ripple_tables();
    std::string text;
    for (const RippleTable& table : tables) text += markdown(table);
    page.write(text);
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
