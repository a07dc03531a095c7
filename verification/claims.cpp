// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/observables/record.hpp"
#include "verification/answers.hpp"

namespace tunica::embedded {
std::string_view paper_claims();
}

namespace tunica::verification {

namespace {

using observables::scene_text;

std::vector<Claim> read_claims() {
  const auto table = observables::parse_csv(embedded::paper_claims(), "paper_claims.csv");
  constexpr std::pair<const char*, std::string Claim::*> fields[] = {
      {"id", &Claim::id},     {"where", &Claim::where},         {"geometry", &Claim::geometry},
      {"law", &Claim::law},   {"quantity", &Claim::quantity},   {"value", &Claim::value},
      {"unit", &Claim::unit}, {"tolerance", &Claim::tolerance}, {"note", &Claim::note}};
  std::vector<Claim> claims(table.rows());
  for (const auto& [name, field] : fields) {
    const auto* column = table.find(name);
    if (!column || !column->is_text())
      throw std::logic_error(fmt::format("paper_claims.csv has no text column {}", name));
    for (std::size_t row = 0; row < table.rows(); ++row) claims[row].*field = column->labels[row];
  }
  return claims;
}

constexpr const char* from_rest = "this beat begins at rest, the paper's does not";

/// Whether the beat that is compared is the first one of a run without load at its beginning.
bool begins_at_rest(const ComparedRun& run) {
  return scene_text(run.stored->record, "time.start") == "rest" &&
         run.beat.start <= run.table().find("time")->values.front();
}

/// A cell of a Markdown table: '|' would end it, '<' could start HTML.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char character : text) {
    if (character == '|')
      escaped += "\\|";
    else if (character == '<')
      escaped += "&lt;";
    else if (character == '\n')
      escaped += ' ';
    else
      escaped += character;
  }
  return escaped.empty() ? "–" : escaped;
}

}  // namespace

std::string_view to_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::disagrees:
      return "disagrees";
    case Verdict::qualitative_agreement:
      return "qualitative agreement";
    case Verdict::not_answered_by_tier:
      return "not answered by this tier";
    case Verdict::not_answered_by_results:
      return "not answered by these results";
  }
  throw std::logic_error("a verdict without text");
}

Comparison compare_with_paper(const std::vector<StoredResult>& runs, std::vector<std::string> names) {
  if (names.empty())
    for (const StoredResult& run : runs)
      names.push_back(fmt::format("{} ({})", (run.folder / "").parent_path().filename().string(),
                                  scene_text(run.record, "wall.law")));
  Comparison comparison;
  const std::vector<ReadingGroup> groups = group_by_reading(runs, names, comparison.left_out);
  for (const Claim& claim : read_claims())
    for (const ReadingGroup& group : groups) {
      // Runs of the bent artery say nothing of the straight one.
      if (group.reading.geometry == "torus" && !is_about(claim, "torus")) continue;
      const Answer found = answer(claim, group);
      ClaimRow row;
      row.id = claim.id;
      row.where = claim.where;
      row.law = claim.law;
      row.quantity = claim.quantity;
      row.paper = with_unit(claim.value, claim.unit);
      row.ours = found.ours;
      if (!claim.tolerance.empty()) row.tolerance = "± " + with_unit(claim.tolerance, claim.unit);
      // What a tier cannot tell it cannot tell under any reading.
      row.reading = found.verdict == Verdict::not_answered_by_tier
                        ? group.reading.tier
                        : to_text(group.reading, found.uses_activation, found.uses_exponent);
      row.verdict = found.verdict;
      row.about = claim.note;
      row.note = found.note;
      if (row.verdict == Verdict::disagrees &&
          std::any_of(group.runs.begin(), group.runs.end(), begins_at_rest))
        row.note += row.note.empty() ? from_rest : fmt::format("; {}", from_rest);
      const bool is_known =
          std::any_of(comparison.rows.begin(), comparison.rows.end(), [&](const ClaimRow& other) {
            return other.id == row.id && other.reading == row.reading && other.ours == row.ours;
          });
      if (!is_known) comparison.rows.push_back(std::move(row));
    }
  return comparison;
}

std::string to_markdown(const Comparison& comparison) {
  std::string text = "| Claim | Paper | Ours | Verdict | Reading | Remarks |\n|---|---|---|---|---|---|\n";
  const auto& rows = comparison.rows;
  std::vector<bool> done(rows.size());
  std::string_view last_claim;
  for (std::size_t index = 0; index < rows.size(); ++index) {
    if (done[index]) continue;
    const ClaimRow& row = rows[index];
    // Readings with the same answer share a line.
    std::string readings;
    for (std::size_t other = index; other < rows.size(); ++other) {
      const ClaimRow& same = rows[other];
      if (same.id != row.id || same.ours != row.ours || same.verdict != row.verdict || same.note != row.note)
        continue;
      readings += (readings.empty() ? "" : "<br>") + cell(same.reading);
      done[other] = true;
    }
    std::string claim = "〃";
    std::string paper = "〃";
    if (row.id != last_claim) {
      claim = fmt::format("{}<br>*{}; {}{}*", cell(row.quantity), cell(row.where), cell(row.law),
                          row.about.empty() ? "" : "; " + cell(row.about));
      paper = row.paper.empty() ? "in words" : cell(row.paper);
      if (!row.tolerance.empty()) paper += "<br>" + cell(row.tolerance);
    }
    last_claim = row.id;
    text += fmt::format("| {} | {} | {} | **{}** | {} | {} |\n", claim, paper, cell(row.ours),
                        to_text(row.verdict), readings, cell(row.note));
  }
  for (const std::string& line : comparison.left_out) text += fmt::format("\nNot compared: {}\n", cell(line));
  return text;
}

}  // namespace tunica::verification
