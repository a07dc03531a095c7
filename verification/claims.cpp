// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "verification/answers.hpp"

namespace tunica::embedded {
std::string_view paper_claims();
}

namespace tunica::verification {

namespace {

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

std::string joined(const std::string& first, const std::string& second) {
  return first.empty() || second.empty() ? first + second : first + "; " + second;
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

Comparison compare_with_paper(const std::vector<StoredResult>& runs) {
  Comparison comparison;
  const std::vector<ReadingGroup> groups = group_by_reading(runs, comparison.left_out);
  for (const Claim& claim : read_claims())
    for (const ReadingGroup& group : groups) {
      const Answer found = answer(claim, group);
      ClaimRow row;
      row.id = claim.id;
      row.where = claim.where;
      row.law = claim.law;
      row.quantity = claim.quantity;
      row.paper = with_unit(claim.value, claim.unit);
      row.ours = found.ours;
      if (!claim.tolerance.empty()) row.tolerance = "± " + with_unit(claim.tolerance, claim.unit);
      row.reading = to_text(group.reading, found.uses_activation, found.uses_exponent);
      row.verdict = found.verdict;
      row.note = joined(claim.note, found.note);
      const bool is_known =
          std::any_of(comparison.rows.begin(), comparison.rows.end(), [&](const ClaimRow& other) {
            return other.id == row.id && other.reading == row.reading && other.ours == row.ours;
          });
      if (!is_known) comparison.rows.push_back(std::move(row));
    }
  return comparison;
}

std::string to_markdown(const Comparison& comparison) {
  std::string text =
      "| Claim | Law | Paper | Ours | Reading | Verdict | Remarks |\n|---|---|---|---|---|---|---|\n";
  for (const ClaimRow& row : comparison.rows)
    text += fmt::format("| {} ({}) | {} | {} | {} | {} | **{}** | {} |\n", cell(row.quantity),
                        cell(row.where), cell(row.law), cell(joined(row.paper, row.tolerance)),
                        cell(row.ours), cell(row.reading), to_text(row.verdict), cell(row.note));
  for (const std::string& line : comparison.left_out) text += fmt::format("\nNot compared: {}\n", cell(line));
  return text;
}

}  // namespace tunica::verification
