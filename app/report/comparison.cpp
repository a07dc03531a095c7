// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "app/report/html.hpp"
#include "app/report/sections.hpp"

namespace tunica::report {

namespace {

using namespace verification;

const char* css_class(Agreement verdict) {
  return verdict == Agreement::agrees ? "agrees" : verdict == Agreement::disagrees ? "disagrees" : "open";
}

std::string look(Agreement verdict) {
  const char* mark = verdict == Agreement::agrees        ? "✓"
                     : verdict == Agreement::explained   ? "≈"
                     : verdict == Agreement::unexplained ? "?"
                                                         : "✗";
  return fmt::format("<td class=\"verdict {}\"><span aria-hidden=\"true\">{}</span> ", css_class(verdict),
                     mark);
}

std::string shown_unit(const Quantity& quantity) {
  return quantity.norm == Norm::relative ? "%" : quantity.norm == Norm::angle ? "°" : "ms";
}

double shown(const Quantity& quantity, double value) {
  return quantity.norm == Norm::relative ? 100 * value : value;
}

std::string cell(const Quantity& quantity, double value) {
  return fmt::format("<td>{}</td>", number(shown(quantity, value), quantity.norm == Norm::angle ? 3 : 2));
}

/// What the difference of two neighbours measures.
std::string effect_name(const Link& link) {
  return link.effect.empty() ? "what is left" : link.effect;
}

std::string quantity_row(const QuantityRow& row) {
  const Quantity& quantity = row.quantity;
  std::string cells =
      fmt::format("<th scope=\"row\">{}, {}</th>", escape(quantity.label), shown_unit(quantity));
  for (const double value : {row.yardstick.limit, row.raw.largest, row.raw.rms})
    cells += cell(quantity, value);
  for (const Difference& effect : row.effects) cells += cell(quantity, effect.largest);
  return fmt::format("<tr>{}{}{}{}</td></tr>", cells, look(row.verdict), escape(to_text(row.verdict)),
                     row.note.empty() ? "" : fmt::format("<br><small>{}</small>", escape(row.note)));
}

std::string comparison_table(const TierComparison& comparison, const std::vector<VerifiedRun>& runs) {
  std::string head =
      "<tr><th scope=\"col\">Quantity</th><th scope=\"col\">Limit</th><th "
      "scope=\"col\">Largest<br>difference</th>"
      "<th scope=\"col\">RMS</th>";
  for (const Link& link : comparison.links)
    head += fmt::format("<th scope=\"col\"><small>{}</small></th>", escape(effect_name(link)));
  head += "<th scope=\"col\" class=\"verdict\">Verdict</th></tr>";
  std::string body;
  for (const QuantityRow& row : comparison.rows) body += quantity_row(row);
  const std::string& reference = runs[comparison.reference].tier;
  return table(fmt::format("Over the last beat, at the same places and times; % are of the range of {}. "
                           "Recruitment: time in which fibres are recruited in one run and not in the other. "
                           "Columns behind RMS: the largest differences of neighbouring runs, listed below.",
                           escape(reference)),
               head, body);
}

std::string ladder_list(const TierComparison& comparison, const std::vector<VerifiedRun>& runs) {
  std::string items;
  for (const Link& link : comparison.links)
    items += fmt::format("<li><b>{}</b>: {} → {}</li>", escape(effect_name(link)),
                         escape(runs[link.from].label), escape(runs[link.to].label));
  for (const std::string& line : comparison.left_out)
    items += fmt::format("<li class=\"note\">Left out: {}</li>", escape(line));
  return fmt::format("<ul class=\"ladder\">{}</ul>\n", items);
}

std::string recruitment_table(const CrossTier& found) {
  std::string body;
  for (int point = 1; point <= observables::wall_points; ++point)
    for (const std::size_t index : found.tiers) {
      const VerifiedRun& run = found.runs[index];
      if (!run.is_comparable() || !has_fibers(run.beat_run())) continue;
      std::string intervals;
      for (const auto& [from, to] : recruited_in_beat(run.beat_run(), point))
        intervals += fmt::format("{}{} to {}", intervals.empty() ? "" : "; ", number(1e3 * from, 2),
                                 number(1e3 * to, 2));
      body += fmt::format(
          "<tr><th scope=\"row\">P{}</th><td class=\"text\">{}</td><td class=\"text\">{}</td></tr>", point,
          escape(run.tier), intervals.empty() ? "never" : intervals);
    }
  if (body.empty()) return body;
  return table("When fibres are recruited in the last beat, ms from its start.",
               "<tr><th scope=\"col\">Point</th><th scope=\"col\" class=\"verdict\">Tier</th>"
               "<th scope=\"col\" class=\"verdict\">Recruited</th></tr>",
               body);
}

}  // namespace

std::string comparison_section(const CrossTier* found) {
  if (!found) return {};
  std::string text = "<section aria-labelledby=\"compared\">\n<h2 id=\"compared\">Tiers compared</h2>\n";
  if (const std::string failure = found->failure(); !failure.empty())
    text += fmt::format("<p class=\"banner\">Not compared: {}</p>\n", escape(failure));
  std::string verdicts;
  for (const TierComparison& comparison : found->comparisons)
    verdicts += fmt::format("<li class=\"{}\">{}.</li>", css_class(comparison.verdict()),
                            escape(verdict_sentence(*found, comparison)));
  if (!verdicts.empty()) text += fmt::format("<ul class=\"verdicts\">{}</ul>\n", verdicts);
  for (const TierComparison& comparison : found->comparisons) {
    text +=
        fmt::format("<h3>{} against {}: {}</h3>\n", escape(found->runs[comparison.run].tier),
                    escape(found->runs[comparison.reference].tier), escape(to_text(comparison.verdict())));
    text += comparison_table(comparison, found->runs) + ladder_list(comparison, found->runs);
  }
  text += recruitment_table(*found);
  if (!found->comparisons.empty())
    text +=
        "<div class=\"toolbar\"><label>Quantity <select id=\"compared-quantity\"></select></label></div>\n"
        "<div class=\"charts wide\" id=\"comparison-charts\"></div>\n";
  return text + "</section>\n";
}

std::string comparison_data(const CrossTier* found) {
  constexpr int digits = 6, time_digits = 10;
  std::string json = "{\"comparisons\":[";
  if (found)
    for (const TierComparison& comparison : found->comparisons) {
      if (json.back() == '}') json += ',';
      const VerifiedRun& run = found->runs[comparison.run];
      const VerifiedRun& reference = found->runs[comparison.reference];
      std::vector<std::pair<const VerifiedRun*, const VerifiedRun*>> pairs{{&run, &reference}};
      nlohmann::ordered_json labels{"difference"};
      if (comparison.links.size() > 1)
        for (const Link& link : comparison.links) {
          pairs.emplace_back(&found->runs[link.from], &found->runs[link.to]);
          labels.push_back(effect_name(link));
        }
      json += fmt::format("{{\"tier\":{},\"reference\":{},\"labels\":{},\"time\":", script_string(run.tier),
                          script_string(reference.tier), script_json(labels));
      // Neighbours may have other output times than the reference, whose are used for all.
      const std::vector<double> times = times_in_beat(reference.beat_run());
      append_array(json, times, 1, time_digits);
      json += ",\"quantities\":{";
      for (const QuantityRow& row : comparison.rows) {
        const Quantity& quantity = row.quantity;
        if (quantity.norm != Norm::relative && quantity.norm != Norm::angle) continue;
        if (json.back() == '}') json += ',';
        json += fmt::format("{}:{{\"unit\":{},\"limit\":{},\"lines\":[", script_string(quantity.label),
                            script_string(quantity.norm == Norm::relative ? "% of the range" : "°"),
                            shown(quantity, row.yardstick.limit));
        for (const auto& [from, to] : pairs) {
          if (json.back() == ']') json += ',';
          append_array(json, difference_at(quantity.column, from->beat_run(), to->beat_run(), times),
                       shown(quantity, 1 / row.yardstick.scale), digits);
        }
        json += "]}";
      }
      json += "}}";
    }
  return json + "]}";
}

}  // namespace tunica::report
