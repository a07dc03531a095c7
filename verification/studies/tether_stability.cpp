// SPDX-License-Identifier: GPL-3.0-or-later
// Growth rates of ripples about the smooth state under the printed tether: tables of
// docs/verification/tether-stability.md, each also as CSV beside the growth rates over pressure and wave
// length.
#include <fmt/format.h>

#include <string>

#include "core/observables/result.hpp"
#include "verification/page.hpp"
#include "verification/studies/ripple_tables.hpp"
#include "verification/studies/study.hpp"

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

void tunica::verification::tether_stability(const Study& study) {
  const Page page(study.out("docs/verification/tether-stability.md"), "tables",
                  "tools/study tether-stability");
  const auto tables = ripple_tables();
  std::string text;
  for (const RippleTable& table : tables) text += markdown(table);
  page.write(text);
  for (const RippleTable& table : tables) write_whole(study.kept(table.name + ".csv"), csv(table));
  const RippleTable map = growth_map();
  write_whole(study.kept(map.name + ".csv"), csv(map));
}
