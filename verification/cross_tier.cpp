// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/cross_tier.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>

#include "core/error.hpp"
#include "core/observables/record.hpp"

namespace tunica::verification {

namespace fs = std::filesystem;

namespace {

/// What rungs leave out, as nobody looks at it and it changes no curve.
const std::vector<std::string> lean{"output.field_interval=0", "sensitivity.parameters=[]"};

std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Makes the runs of a verification and keeps them in `found`.
class Maker {
 public:
  Maker(const run::Door& door, const fs::path& folder, const VerifyControl& control, CrossTier& found)
      : door_(door), folder_(folder), control_(control), found_(found) {}

  /// The scene as it is, with each tier. All are set up before the first is computed.
  void make_tiers(const std::vector<const Tier*>& tiers) {
    const Scene& scene = door_.source().scene();
    std::vector<std::unique_ptr<run::Prepared>> runs;
    for (const Tier* tier : tiers) {
      if (const std::string reason = tier->refusal(scene); !reason.empty())
        throw InvalidInput(fmt::format("{}: tier {}: {}", scene.name(), tier->name(), reason));
      runs.push_back(door_.prepare(*tier, {}, keep(std::string(tier->name()))));
    }
    for (std::size_t k = 0; k < tiers.size() && !found_.interrupted; ++k)
      found_.tiers.push_back(execute(*runs[k], std::string(tiers[k]->name()), "as the scene says"));
  }

  /// Rungs of one tier, with what each measures, from the scene as it is on.
  struct Step {
    std::size_t run;
    std::string effect;
  };
  std::vector<Step> make_rungs(const Tier& tier, const std::vector<Rung>& rungs, TierComparison& comparison) {
    std::vector<Step> steps;
    std::vector<std::string> taken;
    for (const Rung& rung : rungs) {
      if (found_.interrupted) break;
      const std::string name = fmt::format("{}, {}", tier.name(), fmt::join(rung.overrides, ", "));
      const std::vector<std::string> overrides = joined(taken, rung.overrides);
      try {
        const Scene before = door_.source().with(joined(taken, lean));
        const Scene scene = door_.source().with(joined(overrides, lean));
        if (rung.is_there(before) || scene.values() == before.values()) {
          comparison.left_out.push_back(fmt::format("{}: no change to this scene", name));
          continue;
        }
        if (const std::string reason = tier.refusal(scene); !reason.empty()) throw InvalidInput(reason);
        const std::size_t run = rung_run(tier, rung, overrides);
        if (found_.interrupted) break;
        if (!found_.runs[run].is_comparable()) {
          comparison.rung_gave_up = true;
          comparison.left_out.push_back(fmt::format("{}: {}", name, found_.runs[run].trouble));
          continue;
        }
        steps.push_back({run, rung.effect});
        taken = overrides;
      } catch (const InvalidInput& reason) {
        comparison.left_out.push_back(fmt::format("{}: {}", name, reason.what()));
      }
    }
    return steps;
  }

 private:
  run::Keep keep(const std::string& id) const {
    run::Keep all;
    all.folder = folder_ / id;
    all.earlier = control_.replace ? Earlier::replace : Earlier::keep_stopped;
    return all;
  }

  std::size_t rung_run(const Tier& tier, const Rung& rung, const std::vector<std::string>& overrides) {
    const std::string id = fmt::format("{}-{}", tier.name(), rung.id);
    const std::string how = fmt::format("{}", fmt::join(overrides, ", "));
    // Ladders to different tiers may share a rung.
    const auto made = std::find_if(found_.runs.begin(), found_.runs.end(), [&](const VerifiedRun& run) {
      return run.id == id && run.label == fmt::format("{}, {}", tier.name(), how);
    });
    if (made != found_.runs.end()) return static_cast<std::size_t>(made - found_.runs.begin());
    return execute(*door_.prepare(tier, joined(overrides, lean), keep(id)), id, how);
  }

  std::size_t execute(run::Prepared& computation, std::string id, const std::string& how) {
    VerifiedRun run;
    run.id = std::move(id);
    run.tier = computation.tier().name();
    run.label = fmt::format("{}, {}", run.tier, how);
    control_.begin(run.label);
    RunControl control;
    control.report = control_.report;
    control.interrupted = control_.interrupted;
    warn_once(computation.warnings());
    run::Outcome outcome = computation.execute(control);
    run.stored = std::move(*outcome.stored);
    warn_once(run.stored.record.at("findings"));
    found_.interrupted = outcome.ending == run::Ending::interrupted;
    if (outcome.ending == run::Ending::gave_up)
      run.trouble = fmt::format("the solver gave up {}", outcome.reason);
    else if (found_.interrupted)
      run.trouble = "interrupted";
    else if (!(run.beat = observables::last_beat(run.stored)).whole)
      run.trouble = "the run is shorter than a beat";
    found_.runs.push_back(std::move(run));
    return found_.runs.size() - 1;
  }

  void warn_once(const std::vector<std::string>& lines) {
    for (const std::string& line : lines)
      if (told_.insert(line).second) control_.warn(line);
  }

  const run::Door& door_;
  const fs::path& folder_;
  const VerifyControl& control_;
  CrossTier& found_;
  std::set<std::string> told_;
};

const Tier& tier_named(const std::vector<const Tier*>& tiers, const std::string& name) {
  const auto tier =
      std::find_if(tiers.begin(), tiers.end(), [&](const Tier* one) { return one->name() == name; });
  if (tier == tiers.end()) throw std::logic_error("a run of a tier that is not there");
  return **tier;
}

/// From `run` over the rungs of both tiers to `reference`.
void climb(TierComparison& comparison, const std::vector<Maker::Step>& added,
           const std::vector<Maker::Step>& removed) {
  comparison.rungs = {comparison.run};
  const auto climb_to = [&](std::size_t run, std::string effect) {
    comparison.links.push_back({comparison.rungs.back(), run, std::move(effect)});
    comparison.rungs.push_back(run);
  };
  for (const auto& step : added) climb_to(step.run, step.effect);
  std::string effect;  // none between the tiers
  for (auto step = removed.rbegin(); step != removed.rend(); ++step) {
    climb_to(step->run, std::exchange(effect, step->effect));
  }
  climb_to(comparison.reference, effect);
}

/// What the paper says of this law on its own, as far as these tiers can tell.
Comparison claims_of_law(const std::vector<StoredResult>& results) {
  Comparison claims = compare_with_paper(results);
  std::erase_if(claims.rows, [](const ClaimRow& row) {
    return row.verdict == Verdict::not_answered_by_tier || row.verdict == Verdict::not_answered_by_results;
  });
  return claims;
}

}  // namespace

std::string_view to_text(Agreement agreement) {
  switch (agreement) {
    case Agreement::agrees:
      return "agrees";
    case Agreement::explained:
      return "differs by the model (explained)";
    case Agreement::unexplained:
      return "not explained: a rung gave up";
    case Agreement::disagrees:
      return "disagrees";
  }
  throw std::logic_error("an agreement without text");
}

Agreement TierComparison::verdict() const {
  Agreement worst = Agreement::agrees;
  for (const QuantityRow& row : rows) worst = std::max(worst, row.verdict);
  return worst;
}

std::vector<StoredResult> CrossTier::tier_results() const {
  std::vector<StoredResult> results;
  for (const std::size_t run : tiers)
    if (runs[run].stored.result.observables.rows() > 0) results.push_back(runs[run].stored);
  return results;
}

std::string CrossTier::failure() const {
  std::vector<std::string> failures;
  for (const std::size_t run : tiers)
    if (!runs[run].is_comparable())
      failures.push_back(fmt::format("{}: {}", runs[run].tier, runs[run].trouble));
  return fmt::format("{}", fmt::join(failures, "; "));
}

void compare(TierComparison& comparison, const std::vector<VerifiedRun>& runs, double tolerance) {
  const BeatRun run = runs[comparison.run].beat_run(), reference = runs[comparison.reference].beat_run();
  for (const Quantity& quantity : compared_quantities()) {
    QuantityRow row;
    row.quantity = quantity;
    row.range = observables::range(reference.table(), quantity.column, reference.beat);
    row.yardstick = yardstick(quantity, reference, run, tolerance);
    if (observables::is_none(row.yardstick.limit)) continue;
    const double scale = row.yardstick.scale;
    row.raw = difference(quantity, run, reference, scale);
    if (observables::is_none(row.raw.largest)) {
      comparison.left_out.push_back(
          fmt::format("{}: {} has none", quantity.label, runs[comparison.run].tier));
      continue;
    }
    for (const Link& link : comparison.links) {
      row.effects.push_back(
          difference(quantity, runs[link.from].beat_run(), runs[link.to].beat_run(), scale));
      if (link.effect.empty()) row.remainder = row.effects.back();
    }
    const bool remainder_fits = row.remainder.largest <= row.yardstick.limit;
    row.verdict = row.raw.largest <= row.yardstick.limit ? Agreement::agrees
                  : remainder_fits                       ? Agreement::explained
                  : comparison.rung_gave_up              ? Agreement::unexplained
                                                         : Agreement::disagrees;
    if (row.verdict == Agreement::agrees && !remainder_fits)
      row.note = "what is left is larger: effects cancel each other";
    comparison.rows.push_back(std::move(row));
  }
}

CrossTier verify(const run::Door& door, const std::vector<const Tier*>& tiers, const fs::path& folder,
                 const VerifyControl& control, const std::vector<Ladder>& between) {
  if (tiers.size() < 2) throw std::logic_error("a verification needs two tiers");
  CrossTier found;
  const Scene& as_it_is = door.source().scene();
  found.scene = as_it_is.name();
  found.tolerance = as_it_is.number("accuracy.tolerance");
  Maker maker(door, folder, control, found);
  maker.make_tiers(tiers);
  if (found.interrupted) return found;

  const std::size_t reference = found.tiers.back();
  for (const std::size_t run : found.tiers) {
    if (run == reference || !found.runs[reference].is_comparable() || !found.runs[run].is_comparable())
      continue;
    TierComparison comparison;
    comparison.run = run;
    comparison.reference = reference;
    std::vector<Maker::Step> added, removed;
    for (const Ladder& ladder : between) {
      if (ladder.lower != found.runs[run].tier || ladder.upper != found.runs[reference].tier) continue;
      added = maker.make_rungs(tier_named(tiers, ladder.lower), ladder.added, comparison);
      removed = maker.make_rungs(tier_named(tiers, ladder.upper), ladder.removed, comparison);
    }
    if (found.interrupted) return found;
    climb(comparison, added, removed);
    compare(comparison, found.runs, found.tolerance);
    found.comparisons.push_back(std::move(comparison));
  }
  found.claims = claims_of_law(found.tier_results());
  return found;
}

}  // namespace tunica::verification
