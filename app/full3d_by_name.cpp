// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/full3d_by_name.hpp"

#include <stdexcept>

#include "full3d/refusal.hpp"

namespace tunica {

namespace {

class Full3dByName final : public Tier {
 public:
  std::string_view name() const override { return full3d::tier_name; }
  bool computes() const override { return false; }
  std::string refusal(const Scene& scene) const override { return full3d::refusal(scene); }
  bool suits(const Scene& scene) const override { return full3d::suits(scene); }
  std::unique_ptr<TierRun> prepare(const Scene&) const override {
    throw std::logic_error("the 3D tier is computed by tunica-full3d");
  }
};

}  // namespace

std::unique_ptr<Tier> full3d_by_name() {
  return std::make_unique<Full3dByName>();
}

}  // namespace tunica
