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

std::string title_of(const std::vector<report::RunSummary>& runs) {
  std::vector<std::string> names;
  for (const auto& run : runs)
    if (std::find(names.begin(), names.end(), run.name) == names.end()) names.push_back(run.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string subtitle_of(const std::vector<report::RunSummary>& runs) {
  std::vector<std::string> labels;
  std::vector<std::string> tiers;
  for (const auto& run : runs) {
    labels.push_back(run.label);
    if (std::find(tiers.begin(), tiers.end(), run.tier) == tiers.end()) tiers.push_back(run.tier);
  }
  return fmt::format("{} · {} tier", fmt::join(labels, ", "), fmt::join(tiers, ", "));
}

}  // namespace

std::string make_report(const std::vector<StoredResult>& stored, const verification::CrossTier* comparison) {
  if (stored.empty()) throw InvalidInput("a report needs at least one folder with results");
  const auto runs = report::summarize(stored);
  const report::Scene3d scene = report::scene_3d(runs);
  return report::fill(embedded::report_template(),
                      {{"title", report::escape(title_of(runs))},
                       {"subtitle", report::escape(subtitle_of(runs))},
                       {"version", report::escape(program_version())},
                       {"uplot_style", std::string(embedded::uplot_style())},
                       {"style", std::string(embedded::report_style())},
                       {"comparison", report::comparison_section(comparison)},
                       {"differences", report::comparison_data(comparison)},
                       {"viewer", report::viewer_section(scene)},
                       {"headline", report::headline_table(runs)},
                       {"claims", report::claims_section(stored)},
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
