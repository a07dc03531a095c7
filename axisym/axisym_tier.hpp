// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tier.hpp"

namespace tunica::axisym {

/// The 2D tier: blood and thick wall of a straight artery, coupled, in the (r, z) plane.
class AxisymTier final : public Tier {
 public:
  std::string_view name() const override { return "axisym"; }
  std::string refusal(const Scene& scene) const override;
  bool suits(const Scene& scene) const override;
  std::unique_ptr<TierRun> prepare(const Scene& scene) const override;
};

}  // namespace tunica::axisym
