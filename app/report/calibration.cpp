// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/calibration.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/report/html.hpp"
#include "core/observables/build_info.hpp"
#include "verification/calibration/result.hpp"

namespace tunica::embedded {
std::string_view calibration_template();
std::string_view report_style();
}  // namespace tunica::embedded

namespace tunica {

namespace {

using namespace verification::calibration;
using report::escape;

std::string shown(double value) {
  return std::isfinite(value) ? fmt::format("{:.5g}", value) : "–";
}

std::string row(const std::string& head, const std::vector<std::string>& cells) {
  std::string html = fmt::format("<tr><th scope=\"row\">{}</th>", escape(head));
  for (const std::string& cell : cells) html += fmt::format("<td>{}</td>", escape(cell));
  return html + "</tr>";
}

std::string head(const std::vector<std::string>& names) {
  std::string html = "<tr>";
  for (const std::string& name : names) html += fmt::format("<th scope=\"col\">{}</th>", escape(name));
  return html + "</tr>";
}

std::string named(const std::string& name, const std::string& unit) {
  return unit == "1" ? name : fmt::format("{} [{}]", name, unit);
}

std::string keys_table(const Task& task, const Calibration& found) {
  std::string body;
  for (std::size_t k = 0; k < task.free.size(); ++k) {
    const FreeKey& free = task.free[k];
    const FreeResult result = found.has_answer() ? found.free[k] : FreeResult{};
    body += row(named(free.key, free.unit),
                {shown(result.value), shown(result.standard_deviation), shown(free.low), shown(free.high)});
  }
  return report::table("", head({"Key", "Value", "Standard deviation", "From", "To"}), body);
}

std::string targets_table(const Task& task, const Calibration& found) {
  std::string body;
  for (std::size_t i = 0; i < task.targets.size(); ++i) {
    const Target& target = task.targets[i];
    const double reached = found.has_answer() ? found.reached[i] : observables::none;
    body += row(named(target.quantity.name(), target.quantity.unit()),
                {target.asked.substr(target.asked.find('=') + 1), shown(target.value),
                 shown(target.standard_deviation), shown(reached),
                 shown((reached - target.value) / target.standard_deviation)});
  }
  return report::table(
      "", head({"Quantity", "Asked", "Target", "Standard deviation", "Reached", "Missed by (deviations)"}),
      body);
}

std::string starts_table(const Task& task, const Calibration& found) {
  std::vector<std::string> names{"Search"};
  for (const char* end : {"from", "to"})
    for (const FreeKey& free : task.free) names.push_back(fmt::format("{}, {}", free.key, end));
  names.insert(names.end(), {"Misfit", "End"});
  std::string body;
  for (std::size_t i = 0; i < found.starts.size(); ++i) {
    const Start& start = found.starts[i];
    std::vector<std::string> cells;
    for (const auto* values : {&start.from, &start.to})
      for (std::size_t k = 0; k < task.free.size(); ++k)
        cells.push_back(k < values->size() ? shown((*values)[k]) : "–");
    cells.push_back(shown(start.misfit));
    cells.push_back(start.agrees ? "this answer" : start.converged ? "another answer" : start.reason);
    body += row(fmt::format("{}", i + 1), cells);
  }
  return report::table(fmt::format("{} runs", found.runs), head(names), body);
}

std::string findings_section(const Task& task, const Calibration& found) {
  std::string items;
  if (!found.converged)
    items += fmt::format("<p class=\"banner\">Not converged: {}</p>\n",
                         escape(found.interrupted ? "interrupted" : found.reason));
  for (const std::string& line : findings(task, found))
    items += fmt::format("<p class=\"banner\">{}</p>\n", escape(line));
  return items;
}

}  // namespace

std::string make_calibration_report(const std::string& scene, const Task& task, const Calibration& found) {
  return report::fill(embedded::calibration_template(),
                      {{"title", escape(fmt::format("{}, calibrated", scene))},
                       {"subtitle", escape(fmt::format("{} tier · {} of {} searches agree", task.tier,
                                                       found.agreeing(), found.starts.size()))},
                       {"version", escape(program_version())},
                       {"style", std::string(embedded::report_style())},
                       {"findings", findings_section(task, found)},
                       {"keys", keys_table(task, found)},
                       {"targets", targets_table(task, found)},
                       {"starts", starts_table(task, found)}});
}

}  // namespace tunica
