// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/door.hpp"
#include "core/tier.hpp"
#include "verification/claims.hpp"
#include "verification/difference.hpp"
#include "verification/ladder.hpp"

namespace tunica::verification {

/// A run of a verification, kept in a folder of its own.
struct VerifiedRun {
  std::string id;  ///< name of its folder: the tier's, with the rung's behind it: "lumped-inertance"
  std::string tier;
  std::string label;    ///< "lumped, lumped.compartments=21"; "lumped, as the scene says"
  std::string trouble;  ///< why it cannot be compared; empty when it can
  StoredResult stored;
  observables::Beat beat;

  bool is_comparable() const { return trouble.empty(); }
  BeatRun beat_run() const { return {&stored, beat}; }
};

/// The difference of two neighbours on the way from a tier to the reference.
struct Link {
  std::size_t from, to;  ///< runs of the verification
  std::string effect;    ///< what it measures; empty between the tiers, where the models mean the same
};

/// `unexplained` where a rung that would have told an effect of the model gave up: what is left may be that
/// effect.
enum class Agreement { agrees, explained, unexplained, disagrees };
std::string_view to_text(Agreement agreement);

struct QuantityRow {
  Quantity quantity;
  observables::Range range;  ///< of the reference over its beat, in the column's unit
  Yardstick yardstick;
  Difference raw;                   ///< as the scene says, tier against reference
  Difference remainder;             ///< where the models mean the same artery
  std::vector<Difference> effects;  ///< of each link
  Agreement verdict = Agreement::disagrees;
  std::string note;
};

/// One tier against the reference.
struct TierComparison {
  std::size_t run, reference;      ///< runs of the verification
  std::vector<std::size_t> rungs;  ///< from `run` to `reference`, both included
  std::vector<Link> links;         ///< between neighbours of `rungs`
  /// Rungs that could not be taken and why; things that cannot be compared.
  std::vector<std::string> left_out;
  bool rung_gave_up = false;  ///< one of them
  std::vector<QuantityRow> rows;

  Agreement verdict() const;
};

struct CrossTier {
  std::string scene;     ///< name
  double tolerance = 0;  ///< accuracy.tolerance
  std::vector<VerifiedRun> runs;
  std::vector<std::size_t> tiers;  ///< runs of the scene as it is, the reference last
  std::vector<TierComparison> comparisons;
  Comparison claims;  ///< of the paper, of the law of the scene, with answers of `tiers`
  bool interrupted = false;

  /// Of the tiers' own runs, in the order of `tiers`, those that have rows.
  std::vector<StoredResult> tier_results() const;
  /// Why a run of the scene as it is did not come to its end; empty when all did.
  std::string failure() const;
};

/// What a verification tells while it runs.
struct VerifyControl {
  std::function<void(const std::string& label)> begin = [](const std::string&) {};  ///< before each run
  /// Warnings before a run and what it found out, each line once.
  std::function<void(const std::string& line)> warn = [](const std::string&) {};
  std::function<void(const Progress&)> report = [](const Progress&) {};
  std::function<bool()> interrupted = [] { return false; };
  bool replace = false;  ///< also runs of other scenes that were stopped and could be resumed
};

/// Computes the door's scene with every tier (the reference last) and with the rungs of the ladders
/// between them, each into a folder below `folder`, and compares what they found over the last whole
/// beat, at the same places and times. Verdicts: a quantity agrees when the largest difference is within
/// its limit (see yardstick). Beyond, it differs by the model when it is within the limit where the two
/// models mean the same artery: then the difference comes from the effects that the links measure.
/// Otherwise it disagrees or, where a rung gave up, is not explained. Throws InvalidInput when a tier
/// cannot compute the scene, before anything is computed. A rung that cannot be taken is left out and
/// named. A tier that gives up is named in failure(); what can be compared still is.
CrossTier verify(const run::Door& door, const std::vector<const Tier*>& tiers,
                 const std::filesystem::path& folder, const VerifyControl& control = {},
                 const std::vector<Ladder>& between = ladders());

/// Comparison of runs that have been made, for the tiers and links given.
void compare(TierComparison& comparison, const std::vector<VerifiedRun>& runs, double tolerance);

/// "lumped against axisym disagrees: 8 quantities agree, 18 differ by the model, 2 disagree".
std::string verdict_sentence(const CrossTier& found, const TierComparison& comparison);

/// Text for a terminal of 80 columns, the verdicts first.
std::string to_text(const CrossTier& found);
/// verify.json.
nlohmann::ordered_json to_json(const CrossTier& found);

}  // namespace tunica::verification
