// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tier.hpp"

namespace tunica::lumped {

/// The 0D tier: nonlinear Windkessel of the thick ring, solved in milliseconds (see Network).
class LumpedTier final : public Tier {
 public:
  std::string_view name() const override { return "lumped"; }
  std::string refusal(const Scene& scene) const override;
  bool suits(const Scene& scene) const override;
  std::unique_ptr<TierRun> prepare(const Scene& scene) const override;
  /// From some hundred rows of the last beat; nullopt where derivatives are asked for.
  std::optional<run::Answer> answer(const Scene& scene, const run::Question& question,
                                    const RunControl& control) const override;
};

}  // namespace tunica::lumped
