// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace tunica::verification {

/// One run on the way from a tier to the one above it: the scene of the rung before with one more thing that
/// only one of the two models has, so that the difference of the two runs measures that thing.
struct Rung {
  std::string id;                      ///< for folders, "inertance"
  std::vector<std::string> overrides;  ///< "key=value"
  std::string effect;  ///< what the difference to the rung before measures: "inertia of the blood"
  /// True for a scene that has it already. A rung that leaves the scene as it is is left out in any case.
  std::function<bool(const Scene&)> is_there = [](const Scene&) { return false; };
};

/// How two tiers are brought to the same physics. The lower tier is given what it can model as an option, a
/// rung at a time; the upper tier is relieved of what the lower one cannot model. What is left between the
/// last rungs of both, where the two models mean the same artery, is explained by no model difference.
struct Ladder {
  std::string lower, upper;   ///< names of tiers
  std::vector<Rung> added;    ///< to the lower tier, each on top of those before
  std::vector<Rung> removed;  ///< from the upper tier, likewise
};

/// The ladders between the tiers that Tunica has.
const std::vector<Ladder>& ladders();

}  // namespace tunica::verification
