// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/choose_tier.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace tunica::run {

namespace {

std::string names(const TierList& tiers) {
  std::vector<std::string_view> all;
  for (const auto& tier : tiers) all.push_back(tier->name());
  return fmt::format("{}", fmt::join(all, ", "));
}

}  // namespace

const Tier& choose_tier(const TierList& tiers, const std::string& name, const Scene& scene) {
  if (name == "auto") {
    const auto tier =
        std::find_if(tiers.begin(), tiers.end(), [&](const auto& t) { return t->suits(scene); });
    if (tier != tiers.end()) return **tier;
    throw InvalidInput(fmt::format(
        "{}: geometry.kind = \"{}\" is not a shape that a tier of this program is meant for; name a tier to "
        "compute it with what that tier leaves out: --tier {}",
        scene.name(), scene.text("geometry.kind"), names(tiers)));
  }
  const auto tier =
      std::find_if(tiers.begin(), tiers.end(), [&](const auto& t) { return t->name() == name; });
  if (tier == tiers.end())
    throw InvalidInput(
        fmt::format("--tier {}: not a tier of this program; choose one of: auto, {}", name, names(tiers)));
  if (const std::string reason = (*tier)->refusal(scene); !reason.empty())
    throw InvalidInput(fmt::format("{}: tier {}: {}", scene.name(), name, reason));
  return **tier;
}

}  // namespace tunica::run
