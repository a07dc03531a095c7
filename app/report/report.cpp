// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/report/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/report/html.hpp"
#include "app/report/scene_3d.hpp"
#include "app/report/sections.hpp"
#include "core/error.hpp"
#include "core/observables/build_info.hpp"

namespace tunica::embedded {
std::string_view report_template();
std::string_view report_style();
std::string_view report_chart_script();
std::string_view report_script();
std::string_view uplot_style();
std::string_view uplot_script();
}  // namespace tunica::embedded

namespace tunica {

namespace {

/// Each name once, and no more of them than a heading bears.
std::string list_of(const std::vector<report::RunSummary>& runs, std::string report::RunSummary::*name,
                    const char* separator) {
  constexpr std::size_t most = 4;
  std::vector<std::string> names;
  for (const auto& run : runs)
    if (std::find(names.begin(), names.end(), run.*name) == names.end()) names.push_back(run.*name);
  const std::size_t more = names.size() > most ? names.size() - most + 1 : 0;
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, separator), more > 0 ? fmt::format(" and {} more", more) : "");
}

std::string subtitle_of(const std::vector<report::RunSummary>& runs) {
  using Run = report::RunSummary;
  return fmt::format("{}{} · {} tier", runs.size() > 1 ? fmt::format("{} runs · ", runs.size()) : "",
                     list_of(runs, &Run::law, ", "), list_of(runs, &Run::tier, ", "));
}

}  // namespace

std::string make_report(const std::vector<StoredResult>& stored, const verification::CrossTier* comparison) {
  if (stored.empty()) throw InvalidInput("a report needs at least one folder with results");
  const auto runs = report::summarize(stored);
  const report::Scene3d scene = report::scene_3d(runs);
  return report::fill(embedded::report_template(),
                      {{"title", report::escape(list_of(runs, &report::RunSummary::name, ", "))},
                       {"subtitle", report::escape(subtitle_of(runs))},
                       {"version", report::escape(program_version())},
                       {"uplot_style", std::string(embedded::uplot_style())},
                       {"style", std::string(embedded::report_style())},
                       {"comparison", report::comparison_section(comparison)},
                       {"differences", report::comparison_data(comparison)},
                       {"viewer", report::viewer_section(scene)},
                       {"headline", report::headline_table(runs)},
                       {"remarks", report::remarks_section(runs)},
                       {"states", report::states_section(runs)},
                       {"claims", report::claims_section(stored, runs)},
                       {"events", report::events_section(runs)},
                       {"runs", report::runs_section(runs)},
                       {"data", report::chart_data(runs)},
                       {"uplot_script", std::string(embedded::uplot_script())},
                       {"chart_script", std::string(embedded::report_chart_script())},
                       {"script", std::string(embedded::report_script())},
                       {"viewer_scripts", report::viewer_scripts(scene)},
                       {"viewer_credit", report::viewer_credit(scene)}});
}

}  // namespace tunica
