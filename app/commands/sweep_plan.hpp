// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "app/commands/commands.hpp"
#include "core/run/door.hpp"
#include "verification/sweep/points.hpp"

namespace tunica {

/// What the options of a sweep ask for.
struct SweepPlan {
  std::string tier;          ///< for sweep.json; of several tiers their names
  bool all_compute = true;   ///< every tier is computed by this process
  bool surrogates = false;   ///< indices come from surrogates of the points
  bool pick_freeze = false;  ///< or from a sample that is made for them
  run::Question question;
};

/// Throws InvalidInput for options that do not go together, tiers that do not suit the scene, and unknown
/// quantities and tiers.
SweepPlan plan_sweep(const SweepArguments& arguments, const TierList& tiers, const Scene& scene,
                     const sweep::Points& points);

/// Whether indices are to come from surrogates: where runs are dear, where points are listed, or where it is
/// asked for.
bool wants_surrogates(const SweepArguments& arguments, const TierList& tiers, const Scene& scene);

/// The points; of a sample `times` as many as --sample says. Throws InvalidInput.
std::unique_ptr<sweep::Points> points_of(const SweepArguments& arguments, bool surrogates,
                                         std::uint64_t times = 1);

}  // namespace tunica
