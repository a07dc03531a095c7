// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/report/html.hpp"
#include "app/report/sections.hpp"
#include "core/observables/record.hpp"
#include "core/units.hpp"

namespace tunica::report {

namespace {

using namespace observables;

struct ShownColumn {
  const char* name;  ///< in observables.csv, without its point
  const char* head;  ///< HTML
  double unit;
  int decimals;
};

constexpr ShownColumn of_state[] = {{"pressure", "Pressure<br>mmHg", mmhg, 2},
                                    {"transmural_pressure", "Transmural<br>mmHg", mmhg, 2},
                                    {"inflow", "Inflow<br>cm³/s", 1, 4}};
constexpr ShownColumn of_point[] = {{"radial_displacement", "Displacement<br>cm", 1, 6},
                                    {"fiber_angle", "Fibre angle<br>°", 1, 2},
                                    {"fiber_stretch", "Fibre<br>stretch", 1, 4},
                                    {"recruitment", "Recruitment<br>H", 1, 3},
                                    {"von_mises", "Von Mises<br>10⁵ dyn/cm²", 1e5, 3}};

double first_value(const Table& table, const std::string& name) {
  const Column* column = table.find(name);
  return column && !column->is_text() && !column->values.empty() ? column->values.front() : none;
}

/// What no law or tier of these runs has is left out.
template <std::size_t N>
std::vector<ShownColumn> known(const ShownColumn (&columns)[N], const std::vector<RunSummary>& runs,
                               const char* point) {
  std::vector<ShownColumn> found;
  for (const ShownColumn& column : columns)
    if (std::any_of(runs.begin(), runs.end(), [&](const RunSummary& run) {
          return run.is_state &&
                 !is_none(first_value(run.stored->result.observables, std::string(column.name) + point));
        }))
      found.push_back(column);
  return found;
}

std::string cell(const Table& table, const std::string& name, const ShownColumn& column) {
  return number(first_value(table, name) / column.unit, column.decimals);
}

}  // namespace

std::string states_section(const std::vector<RunSummary>& runs) {
  if (std::none_of(runs.begin(), runs.end(), [](const RunSummary& run) { return run.is_state; })) return {};
  const auto whole = known(of_state, runs, ""), points = known(of_point, runs, ".P1");
  std::string head = "<tr><th scope=\"col\">Run</th>";
  for (const ShownColumn& column : whole) head += fmt::format("<th scope=\"col\">{}</th>", column.head);
  head += "<th scope=\"col\">Point</th>";
  for (const ShownColumn& column : points) head += fmt::format("<th scope=\"col\">{}</th>", column.head);
  head += "</tr>";
  std::string body;
  for (std::size_t index = 0; index < runs.size(); ++index) {
    if (!runs[index].is_state) continue;
    const Table& table = runs[index].stored->result.observables;
    for (int point = 1; point <= wall_points; ++point) {
      body += "<tr>";
      if (point == 1) {
        body += fmt::format("<th scope=\"rowgroup\" class=\"run\" rowspan=\"{}\">{}{}</th>", wall_points,
                            swatch(index), escape(runs[index].label));
        for (const ShownColumn& column : whole)
          body += fmt::format("<td rowspan=\"{}\">{}</td>", wall_points, cell(table, column.name, column));
      }
      body += fmt::format("<td>P{}</td>", point);
      for (const ShownColumn& column : points)
        body += fmt::format("<td>{}</td>", cell(table, fmt::format("{}.P{}", column.name, point), column));
      body += "</tr>";
    }
  }
  return fmt::format(
      "<section aria-labelledby=\"states\">\n  <h2 id=\"states\">Static states</h2>\n  {}"
      "  <div class=\"charts\" id=\"state-charts\"></div>\n</section>\n",
      table("Runs of a single state have these values in place of curves over time. Fibres are recruited "
            "where H is above 1/2; P1 lies on the inner, P4 on the outer surface.",
            head, body));
}

}  // namespace tunica::report
