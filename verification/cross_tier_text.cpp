// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "verification/cross_tier.hpp"

namespace tunica::verification {

namespace {

using namespace observables;

/// In the unit that people read: per cent of the range, degrees, milliseconds.
double shown(const Quantity& quantity, double value) {
  return quantity.norm == Norm::relative ? 100 * value : value;
}

const char* shown_unit(const Quantity& quantity) {
  return quantity.norm == Norm::relative ? "%" : quantity.unit();
}

/// Three digits, as far as two decimals go.
std::string short_number(double value) {
  if (is_none(value)) return "-";
  const double size = std::abs(value);
  return fmt::format("{:.{}f}", value, size < 9.995 ? 2 : size < 99.95 ? 1 : 0);
}

std::string number_of(const Quantity& quantity, double value) {
  return short_number(shown(quantity, value));
}

/// "a", "b", ... for the rungs of a comparison.
char letter(std::size_t rung) {
  return static_cast<char>('a' + rung);
}

std::string link_name(std::size_t link) {
  return fmt::format("{}-{}", letter(link), letter(link + 1));
}

/// Broken between words, further lines indented.
std::string wrapped(const std::string& text, std::size_t indent) {
  constexpr std::size_t width = 80;
  std::string lines, line;
  std::size_t from = 0;
  while (from < text.size()) {
    const std::size_t space = std::min(text.find(' ', from + 1), text.size());
    const std::string word = text.substr(from, space - from);
    if (!line.empty() && line.size() + word.size() > width) {
      lines += line + "\n";
      line = std::string(indent, ' ') + word.substr(word.find_first_not_of(' '));
    } else {
      line += word;
    }
    from = space;
  }
  return lines + line + "\n";
}

std::string difference_table(const TierComparison& comparison) {
  std::string text =
      fmt::format("{:<19}{:>9}{:>6}{:>6}{:>6}  {}\n", "quantity", "limit", "max", "rms", "left", "verdict");
  for (const QuantityRow& row : comparison.rows) {
    const Quantity& quantity = row.quantity;
    const std::string limit =
        fmt::format("{} {:<3}", number_of(quantity, row.yardstick.limit), shown_unit(quantity));
    text += fmt::format("{:<19}{:>9}{:>6}{:>6}{:>6}  {}\n", quantity.label, limit,
                        number_of(quantity, row.raw.largest), number_of(quantity, row.raw.rms),
                        number_of(quantity, row.remainder.largest), to_text(row.verdict));
    if (!row.note.empty()) text += fmt::format("    {}\n", row.note);
  }
  return text;
}

/// P2 to P4 behave like P1 unless they are in trouble.
bool is_told(const QuantityRow& row) {
  return row.quantity.point <= 1 || row.verdict != Agreement::agrees;
}

std::string effect_table(const TierComparison& comparison, const std::vector<VerifiedRun>& runs) {
  std::string text = "What the difference is made of: the largest difference of neighbouring runs\n";
  text += fmt::format("{:<19}{:<4}", "quantity", "");
  for (std::size_t link = 0; link < comparison.links.size(); ++link)
    text += fmt::format("{:>8}", link_name(link));
  text += "\n";
  for (const QuantityRow& row : comparison.rows) {
    if (!is_told(row)) continue;
    text += fmt::format("{:<19}{:<4}", row.quantity.label, shown_unit(row.quantity));
    for (const Difference& effect : row.effects)
      text += fmt::format("{:>8}", number_of(row.quantity, effect.largest));
    text += "\n";
  }
  for (std::size_t rung = 0; rung < comparison.rungs.size(); ++rung)
    text += wrapped(fmt::format("  {}    {}", letter(rung), runs[comparison.rungs[rung]].label), 7);
  for (std::size_t link = 0; link < comparison.links.size(); ++link) {
    const std::string& effect = comparison.links[link].effect;
    text += wrapped(fmt::format("  {}  {}", link_name(link),
                                effect.empty() ? "what is left: both models mean the same artery" : effect),
                    7);
  }
  return text;
}

std::string recruitment_table(const CrossTier& found) {
  std::string text;
  for (int point = 1; point <= wall_points; ++point)
    for (const std::size_t index : found.tiers) {
      const VerifiedRun& run = found.runs[index];
      if (!run.is_comparable() || !has_fibers(run.beat_run())) continue;
      std::vector<std::string> parts;
      for (const auto& [from, to] : recruited_in_beat(run.beat_run(), point))
        parts.push_back(fmt::format("{:.2f} to {:.2f}", 1e3 * from, 1e3 * to));
      text += fmt::format("  P{}  {:<10} {}\n", point, run.tier,
                          parts.empty() ? "never" : fmt::format("{}", fmt::join(parts, " and ")));
    }
  return text.empty() ? text
                      : fmt::format("Fibres are recruited in the last beat, ms from its start\n{}\n", text);
}

/// "lumped", which the reading of a claim's row begins with.
std::string tier_of(const ClaimRow& row) {
  return row.reading.substr(0, row.reading.find(','));
}

std::string claims_table(const Comparison& claims) {
  std::string text;
  for (std::size_t k = 0; k < claims.rows.size(); ++k) {
    const ClaimRow& row = claims.rows[k];
    if (k == 0 || claims.rows[k - 1].id != row.id) {
      text += wrapped(fmt::format("{} ({}, {}): {} {}", row.quantity, row.law, row.where,
                                  row.paper.empty() ? "in words" : row.paper, row.tolerance),
                      2);
    }
    text += wrapped(fmt::format("    {}: {}: {}", tier_of(row), to_text(row.verdict), row.ours), 6);
  }
  std::string head;
  if (!text.empty()) {
    std::vector<std::string> readings;
    for (const ClaimRow& row : claims.rows) {
      const std::string reading = row.reading.substr(std::min(row.reading.size(), tier_of(row).size() + 2));
      if (std::find(readings.begin(), readings.end(), reading) == readings.end()) readings.push_back(reading);
    }
    const auto longest = std::max_element(readings.begin(), readings.end(),
                                          [](const auto& a, const auto& b) { return a.size() < b.size(); });
    head = wrapped(fmt::format("\nThe paper beside these runs, read with {}", *longest), 2);
  }
  for (const std::string& line : claims.left_out)
    text += wrapped(fmt::format("Not compared with the paper: {}", line), 2);
  return fmt::format("{}{}", head, text);
}

}  // namespace

std::string verdict_sentence(const CrossTier& found, const TierComparison& comparison) {
  const auto count = [&](Agreement verdict) {
    return std::count_if(comparison.rows.begin(), comparison.rows.end(),
                         [&](const QuantityRow& row) { return row.verdict == verdict; });
  };
  const auto unexplained = count(Agreement::unexplained);
  return fmt::format("{} against {} {}: {} quantities agree, {} differ by the model, {} disagree{}",
                     found.runs[comparison.run].tier, found.runs[comparison.reference].tier,
                     to_text(comparison.verdict()), count(Agreement::agrees), count(Agreement::explained),
                     count(Agreement::disagrees),
                     unexplained > 0 ? fmt::format(", {} are not explained", unexplained) : "");
}

std::string to_text(const CrossTier& found) {
  std::string text;
  for (const TierComparison& comparison : found.comparisons)
    text += wrapped(fmt::format("{}: {}", found.scene, verdict_sentence(found, comparison)), 2);
  if (!text.empty()) text += "\n";
  for (const TierComparison& comparison : found.comparisons) {
    const auto& [tier, reference] =
        std::pair(found.runs[comparison.run].tier, found.runs[comparison.reference].tier);
    text += fmt::format("{} against {}, last beat; % are of the range of {}\n\n", tier, reference, reference);
    text += difference_table(comparison);
    text += fmt::format("\n{}", effect_table(comparison, found.runs));
    for (const std::string& line : comparison.left_out) text += wrapped(fmt::format("Left out: {}", line), 2);
    text += "\n";
  }
  text += recruitment_table(found);
  text += claims_table(found.claims);
  return text;
}

}  // namespace tunica::verification
