// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "core/observables/build_info.hpp"
#include "verification/cross_tier.hpp"

namespace tunica::verification {

namespace {

using namespace observables;
using Json = nlohmann::ordered_json;

Json to_json(const Quantity& quantity, const Difference& difference) {
  Json json;
  json["largest"] = difference.largest;
  if (quantity.norm == Norm::relative || quantity.norm == Norm::angle) {
    json["rms"] = difference.rms;
    json["at[s]"] = difference.at;
  }
  return json;
}

Json to_json(const TierComparison& comparison, const std::vector<VerifiedRun>& runs) {
  Json json = {{"tier", runs[comparison.run].id},
               {"reference", runs[comparison.reference].id},
               {"verdict", to_text(comparison.verdict())}};
  for (const Link& link : comparison.links)
    json["links"].push_back({{"from", runs[link.from].id},
                             {"to", runs[link.to].id},
                             {"effect", link.effect.empty() ? Json() : Json(link.effect)}});
  json["left_out"] = comparison.left_out;
  json["quantities"] = Json::array();
  for (const QuantityRow& row : comparison.rows) {
    const Quantity& quantity = row.quantity;
    const Column* column = runs[comparison.reference].stored.result.observables.find(quantity.column);
    Json one = {{"quantity", quantity.label},
                {"column", quantity.column},
                {"unit", quantity.norm == Norm::relative ? "of the scale" : quantity.unit()},
                {"verdict", to_text(row.verdict)},
                {"limit", row.yardstick.limit},
                {"difference", to_json(quantity, row.raw)},
                {"left", to_json(quantity, row.remainder)}};
    if (quantity.norm == Norm::relative) one[fmt::format("scale[{}]", column->unit)] = row.yardstick.scale;
    for (const Difference& effect : row.effects) one["links"].push_back(to_json(quantity, effect));
    if (!row.note.empty()) one["note"] = row.note;
    json["quantities"].push_back(std::move(one));
  }
  return json;
}

Json to_json(const VerifiedRun& run) {
  Json json = {{"id", run.id}, {"tier", run.tier}, {"scene", run.label}};
  for (const char* key : {"resolution", "unknowns", "steps", "seconds"})
    if (const auto value = run.stored.record.find(key); value != run.stored.record.end()) json[key] = *value;
  if (!run.is_comparable()) json["not_compared"] = run.trouble;
  if (run.is_comparable() && has_fibers(run.beat_run()))
    for (int point = 1; point <= wall_points; ++point)
      json["recruited[s]"][fmt::format("P{}", point)] = recruited_in_beat(run.beat_run(), point);
  return json;
}

}  // namespace

nlohmann::ordered_json to_json(const CrossTier& found) {
  Json json = {{"program", "tunica"},  {"version", program_version()}, {"commit", program_commit()},
               {"scene", found.scene}, {"tolerance", found.tolerance}, {"failure", found.failure()}};
  json["runs"] = Json::array();
  for (const VerifiedRun& run : found.runs) json["runs"].push_back(to_json(run));
  json["comparisons"] = Json::array();
  for (const TierComparison& comparison : found.comparisons)
    json["comparisons"].push_back(to_json(comparison, found.runs));
  json["claims"] = Json::array();
  for (const ClaimRow& row : found.claims.rows)
    json["claims"].push_back({{"id", row.id},
                              {"where", row.where},
                              {"law", row.law},
                              {"claim", row.quantity},
                              {"paper", row.paper},
                              {"tolerance", row.tolerance},
                              {"reading", row.reading},
                              {"ours", row.ours},
                              {"verdict", to_text(row.verdict)}});
  json["claims_left_out"] = found.claims.left_out;
  return json;
}

}  // namespace tunica::verification
