// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

#include "app/report/html.hpp"
#include "app/report/labels.hpp"
#include "app/report/sections.hpp"
#include "core/observables/record.hpp"
#include "core/units.hpp"
#include "verification/claims.hpp"

namespace tunica::report {

namespace {

using namespace observables;
using verification::ClaimRow;
using verification::Verdict;

std::string range_text(const Range& range, int decimals) {
  if (is_none(range.lowest)) return "–";
  const std::string lowest = number(range.lowest, decimals);
  const std::string highest = number(range.highest, decimals);
  return lowest == highest ? lowest : fmt::format("{} to {}", lowest, highest);
}

std::string run_header(const RunSummary& run, std::size_t index, const char* rest = "") {
  return fmt::format("<th scope=\"row\" class=\"run\">{}{}{}</th>", swatch(index), escape(run.label), rest);
}

std::string shares(const RunSummary& run) {
  if (is_none(run.recruited_share[0])) return "<td class=\"none\" colspan=\"4\">no fibres</td>";
  std::string cells;
  for (const double share : run.recruited_share)
    cells += fmt::format("<td>{}</td>", run.is_state ? (share > 0 ? "on" : "off") : number(100 * share, 1));
  return cells;
}

struct VerdictLook {
  const char* css_class;
  const char* mark;
  const char* plural;
};
VerdictLook look(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return {"agrees", "✓", "agree"};
    case Verdict::disagrees:
      return {"disagrees", "✗", "disagree"};
    case Verdict::qualitative_agreement:
      return {"agrees", "✓", "agree qualitatively"};
    case Verdict::not_answered_by_tier:
      return {"open", "○", "are not answered by this tier"};
    case Verdict::not_answered_by_results:
      return {"open", "○", "are not answered by these results"};
  }
  throw std::logic_error("a verdict without a look");
}

std::string verdict_counts(const std::vector<ClaimRow>& rows) {
  std::map<Verdict, int> counts;
  for (const ClaimRow& row : rows) ++counts[row.verdict];
  std::string text;
  for (const auto& [verdict, count] : counts)
    text += fmt::format("<li class=\"{}\"><b>{}</b> {}</li>", look(verdict).css_class, count,
                        look(verdict).plural);
  return fmt::format("<ul class=\"counts\">{}</ul>\n", text);
}

/// What the verdicts stand on: how these runs read the paper, and where all readings are.
std::string readings_sentence(const std::vector<ClaimRow>& rows) {
  // Of each tier and tether the longest, which names what the readings of other claims leave out.
  std::map<std::string, std::string> readings;
  for (const ClaimRow& row : rows) {
    if (row.verdict == Verdict::not_answered_by_tier) continue;
    const std::size_t end = std::min(row.reading.find(", a²"), row.reading.find(", exponent"));
    std::string& longest = readings[row.reading.substr(0, end)];
    if (row.reading.size() > longest.size()) longest = row.reading;
  }
  std::string list;
  for (const auto& [start, reading] : readings)
    list += fmt::format("{}<b>{}</b>", list.empty() ? "" : "; ", escape(reading));
  const auto wrong = std::count_if(rows.begin(), rows.end(),
                                   [](const ClaimRow& row) { return row.verdict == Verdict::disagrees; });
  std::string text =
      "<p>The paper leaves open how its tether presses, where collagen is recruited (a²) and which exponent "
      "its fibre law has. ";
  if (!list.empty()) text += fmt::format("These runs read it so: {}. ", list);
  if (wrong > 0)
    text += fmt::format("{} under {}; no reading makes all of them agree, and nothing is tuned to. ",
                        wrong == 1 ? "One answer disagrees" : fmt::format("{} answers disagree", wrong),
                        readings.size() == 1 ? "this reading" : "these readings");
  return text +
         "The page docs/reproduction.md of Tunica sets every claim beside every reading and explains "
         "them.</p>\n";
}

std::string claim_cells(const ClaimRow& row, std::size_t span) {
  const auto small = [](const std::string& text) {
    return text.empty() ? text : fmt::format("<br><small>{}</small>", escape(text));
  };
  return fmt::format(
      "<th scope=\"rowgroup\" rowspan=\"{0}\">{1}<br><small>{2} · {3}</small>{4}</th>"
      "<td class=\"paper\" rowspan=\"{0}\">{5}{6}</td>",
      span, escape(row.quantity), escape(row.where), escape(row.law), small(row.about),
      row.paper.empty() ? "in words" : escape(row.paper), small(row.tolerance));
}

}  // namespace

std::string swatch(std::size_t run) {
  constexpr std::size_t colours = 12;  // of report.css
  return fmt::format("<span class=\"swatch\" style=\"background:var(--c{})\"></span>", run % colours);
}

std::string headline_table(const std::vector<RunSummary>& runs) {
  std::string body;
  for (std::size_t index = 0; index < runs.size(); ++index) {
    const RunSummary& run = runs[index];
    const std::string state = fmt::format("<br><small class=\"{}\">{}</small>",
                                          run.is_complete ? "" : "stopped", escape(run.state));
    body += fmt::format("<tr>{}<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>{}</tr>",
                        run_header(run, index, state.c_str()), range_text(run.pressure, 1),
                        range_text(run.transmural_pressure, 1),
                        run.is_state ? "–" : number(100 * run.radius_change, 1),
                        number(100 * run.largest_radius, 1), range_text(run.angle_at_start, 2),
                        run.is_state ? "–" : range_text(run.angle_at_systole, 2), shares(run));
  }
  const char* head =
      "<tr><th scope=\"col\" rowspan=\"2\">Run</th><th scope=\"col\" rowspan=\"2\">Pressure<br>mmHg</th>"
      "<th scope=\"col\" rowspan=\"2\">Transmural<br>mmHg</th>"
      "<th scope=\"colgroup\" colspan=\"2\">Inner radius, % of R<sub>0</sub></th>"
      "<th scope=\"colgroup\" colspan=\"2\">Fibre angle P1 to P4, °</th>"
      "<th scope=\"colgroup\" colspan=\"4\">Fibres recruited, % of the beat</th></tr><tr>"
      "<th scope=\"col\">change</th><th scope=\"col\">largest rise</th><th scope=\"col\">start of beat</th>"
      "<th scope=\"col\">systole</th><th scope=\"col\">P1</th><th scope=\"col\">P2</th>"
      "<th scope=\"col\">P3</th><th scope=\"col\">P4</th></tr>";
  std::string caption =
      "Over the last whole beat. Pressure is the mean over the section at mid-length; change is the largest "
      "minus the smallest inner radius; systole is the peak of the inflow; P1 lies on the inner, P4 on the "
      "outer surface.";
  if (std::any_of(runs.begin(), runs.end(), [](const RunSummary& run) { return run.is_state; }))
    caption += " Of a static state: its values, and whether fibres are recruited.";
  return table(caption, head, body);
}

std::string claims_section(const std::vector<StoredResult>& stored, const std::vector<RunSummary>& runs) {
  std::vector<std::string> names;
  for (const RunSummary& run : runs) names.push_back(run.label);
  const verification::Comparison comparison = verification::compare_with_paper(stored, names);
  std::string text;
  if (!comparison.rows.empty()) {
    std::string body;
    const auto& rows = comparison.rows;
    for (std::size_t index = 0; index < rows.size(); ++index) {
      const ClaimRow& row = rows[index];
      std::size_t span = 0;
      if (index == 0 || rows[index - 1].id != row.id)
        for (std::size_t next = index; next < rows.size() && rows[next].id == row.id; ++next) ++span;
      body += "<tr>" + (span > 0 ? claim_cells(row, span) : std::string());
      body += fmt::format(
          "<td class=\"text\">{}</td><td class=\"verdict {}\"><span aria-hidden=\"true\">{}</span> "
          "{}</td><td class=\"text\">{}</td><td class=\"text\">{}</td></tr>",
          row.ours.empty() ? "–" : escape(row.ours), look(row.verdict).css_class, look(row.verdict).mark,
          escape(verification::to_text(row.verdict)), escape(row.reading),
          row.note.empty() ? "" : fmt::format("<small>{}</small>", escape(row.note)));
    }
    text += readings_sentence(rows) + verdict_counts(rows);
    text += table(
        "Each claim on the paper's arteries beside these runs, with the reading of what the paper misprints "
        "or leaves open. A number agrees when it lies within the tolerance printed below the paper's.",
        "<tr><th scope=\"col\">Claim</th><th scope=\"col\">Paper</th><th scope=\"col\">Ours</th>"
        "<th scope=\"col\">Verdict</th><th scope=\"col\">Reading</th><th scope=\"col\">Remarks</th></tr>",
        body);
  }
  std::string items;
  for (const std::string& line : comparison.left_out) items += fmt::format("<li>{}</li>", escape(line));
  if (!items.empty())
    text += fmt::format("<p class=\"note\">Not compared:</p>\n<ul class=\"note\">{}</ul>\n", items);
  return text;
}

std::string events_section(const std::vector<RunSummary>& runs) {
  std::string body;
  for (std::size_t index = 0; index < runs.size(); ++index) {
    const StoredResult& stored = *runs[index].stored;
    const Table& events = stored.result.events;
    const Column* time = events.find("time");
    const Column* point = events.find("point");
    const Column* family = events.find("family");
    const Column* change = events.find("change");
    if (!time || !point || !family || !change || !point->is_text() || !change->is_text()) continue;
    for (std::size_t row = 0; row < events.rows(); ++row) {
      const double at = time->values[row];
      const double in_beat = at - runs[index].beat.start;
      body += fmt::format(
          "<tr>{}<td class=\"text\">{}</td><td>{}</td><td class=\"text\">{}</td><td>{}</td><td>{}</td>"
          "<td>{}</td></tr>",
          run_header(runs[index], index), escape(point->labels[row]), number(family->values[row], 0),
          escape(change->labels[row]), number(at, 5), in_beat >= 0 ? number(in_beat, 5) : "–",
          number(value_at(stored.result.observables, "pressure", at) / mmhg, 2));
    }
  }
  if (body.empty()) return "<p class=\"note\">No fibres were recruited or released.</p>\n";
  return table(
      "Instants at which the fibres of a point are recruited or released.",
      "<tr><th scope=\"col\">Run</th><th scope=\"col\">Point</th><th scope=\"col\">Family</th>"
      "<th scope=\"col\">Change</th><th scope=\"col\">Time, s</th><th scope=\"col\">In the last beat, s"
      "</th><th scope=\"col\">Pressure, mmHg</th></tr>",
      body);
}

namespace {

/// The lines that records hold at a key, each once, with the names of the runs that have it unless all do.
std::string lines_of_runs(const std::vector<RunSummary>& runs, const char* key) {
  std::vector<std::pair<std::string, std::vector<std::string>>> lines;
  for (const RunSummary& run : runs) {
    const auto own = run.stored->record.find(key);
    if (own == run.stored->record.end() || !own->is_array()) continue;
    for (const auto& entry : *own) {
      if (!entry.is_string()) continue;
      const auto line = entry.get<std::string>();
      auto known =
          std::find_if(lines.begin(), lines.end(), [&](const auto& one) { return one.first == line; });
      if (known == lines.end()) known = lines.insert(lines.end(), {line, {}});
      known->second.push_back(run.label);
    }
  }
  std::string items;
  for (const auto& [line, names] : lines)
    items += fmt::format(
        "<li>{}{}</li>", escape(line),
        names.size() == runs.size()
            ? ""
            : fmt::format(" <small>({})</small>", escape(fmt::format("{}", fmt::join(names, "; ")))));
  return items;
}

}  // namespace

std::string remarks_section(const std::vector<RunSummary>& runs) {
  std::string text;
  if (const std::string findings = lines_of_runs(runs, "findings"); !findings.empty())
    text += fmt::format("<ul class=\"findings\">{}</ul>\n", findings);
  if (const std::string remarks = lines_of_runs(runs, "remarks"); !remarks.empty())
    text += fmt::format("<details><summary>Remarks</summary><ul class=\"note\">{}</ul></details>\n", remarks);
  return text;
}

namespace {

/// Any table of the results as it is, in CGS.
std::string plain_table(const char* caption, const Table& source) {
  if (source.rows() == 0) return "";
  std::string head;
  for (const Column& column : source.columns())
    head +=
        fmt::format("<th scope=\"col\">{}{}</th>", escape(column.name),
                    column.is_text() || column.unit == "1" ? "" : fmt::format("<br>{}", escape(column.unit)));
  std::string body;
  for (std::size_t row = 0; row < source.rows(); ++row) {
    body += "<tr>";
    for (const Column& column : source.columns()) {
      if (column.is_text())
        body += fmt::format("<td class=\"text\">{}</td>", escape(column.labels[row]));
      else
        body += fmt::format("<td>{}</td>",
                            is_none(column.values[row]) ? "–" : fmt::format("{:.6g}", column.values[row]));
    }
    body += "</tr>";
  }
  return table(caption, "<tr>" + head + "</tr>", body);
}

std::string record_list(const nlohmann::ordered_json& record) {
  std::string items;
  for (const auto& [key, value] : record.items()) {
    if (key == "scene" || key == "scene_set" || key == "scene_toml") continue;
    if (key == "remarks" || key == "findings") continue;  // they stand below the key numbers
    const std::string text =
        value.is_string() ? value.get<std::string>()
                          : value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    items += fmt::format("<dt>{}</dt><dd>{}</dd>", escape(key), text.empty() ? "–" : escape(text));
  }
  return fmt::format("<dl class=\"record\">{}</dl>\n", items);
}

/// The keys in which runs differ, with their whole names and values, and each run's folder.
std::string differences_table(const std::vector<RunSummary>& runs) {
  std::vector<StoredResult> stored;
  for (const RunSummary& run : runs) stored.push_back({run.stored->folder, run.stored->record, {}});
  const std::vector<Difference> differences = differences_of(stored);
  std::string head = "<tr><th scope=\"col\">Run</th>";
  for (const Difference& difference : differences)
    head += fmt::format("<th scope=\"col\">{}</th>", escape(difference.key));
  head += "<th scope=\"col\">Scene</th><th scope=\"col\" class=\"text\">Folder</th></tr>";
  std::string body;
  for (std::size_t index = 0; index < runs.size(); ++index) {
    body += "<tr>" + run_header(runs[index], index);
    for (const Difference& difference : differences)
      body += fmt::format("<td>{}</td>", escape(difference.values[index]));
    body += fmt::format("<td>{}</td><td class=\"text\">{}</td></tr>", escape(runs[index].name),
                        escape(stored[index].folder.string()));
  }
  return table("The keys in which these scenes differ.", head, body);
}

}  // namespace

std::string runs_section(const std::vector<RunSummary>& runs) {
  std::string text = runs.size() > 1 ? differences_table(runs) : "";
  for (std::size_t index = 0; index < runs.size(); ++index) {
    const RunSummary& run = runs[index];
    const std::string scene = record_text(run.stored->record, "scene_toml");
    text += fmt::format("<details><summary><h3>{}{}</h3> <span>{} · {}</span></summary>\n", swatch(index),
                        escape(run.label), escape(run.tier), escape(run.stored->folder.string()));
    text += "<h4>Record</h4>\n" + record_list(run.stored->record);
    text += plain_table(
        "Time for which the fibres of a point are recruited in the last beat, and how it moves with the "
        "scene's parameters.",
        run.stored->result.recruited_time);
    text += plain_table("How the instants of recruitment and release move with the scene's parameters.",
                        run.stored->result.event_sensitivities);
    text += fmt::format("<h4>Scene</h4>\n<pre tabindex=\"0\">{}</pre>\n</details>\n", escape(scene));
  }
  return text;
}

}  // namespace tunica::report
