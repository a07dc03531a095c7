// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tier.hpp"
#include "full3d/team.hpp"

namespace tunica::full3d {

/// Monolithic fluid-structure interaction of blood and wall in three dimensions. Lives on the leader of a
/// team, which must outlive it.
class Full3dTier final : public Tier {
 public:
  explicit Full3dTier(Team& team) : team_(team) {}
  std::string_view name() const override;
  std::string refusal(const Scene& scene) const override;
  bool suits(const Scene& scene) const override;
  std::unique_ptr<TierRun> prepare(const Scene& scene) const override;

 private:
  Team& team_;
};

}  // namespace tunica::full3d
