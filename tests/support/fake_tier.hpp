// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/tier.hpp"

namespace tunica::test_support {

/// A tier that is a function of the scene, for tests of what stands above the tiers.
class FakeTier final : public Tier {
 public:
  using Answer = std::function<Result(const Scene&, const RunControl&)>;
  using Refusal = std::function<std::string(const Scene&)>;

  FakeTier(
      std::string name, Answer answer, Refusal refusal = [](const Scene&) { return std::string(); })
      : name_(std::move(name)), answer_(std::move(answer)), refusal_(std::move(refusal)) {}

  std::string_view name() const override { return name_; }
  std::string refusal(const Scene& scene) const override { return refusal_(scene); }
  std::vector<std::string> warnings;  ///< of each of its runs
  bool suits(const Scene& scene) const override { return refusal_(scene).empty(); }
  std::unique_ptr<TierRun> prepare(const Scene& scene) const override {
    return std::make_unique<Run>(*this, scene);
  }

 private:
  class Run final : public TierRun {
   public:
    Run(const FakeTier& tier, const Scene& scene) : tier_(tier), scene_(scene) {}
    std::vector<std::string> warnings() const override { return tier_.warnings; }
    Result execute(const RunControl& control) override {
      Result result = tier_.answer_(scene_, control);
      result.record.tier = tier_.name_;
      return result;
    }

   private:
    const FakeTier& tier_;
    const Scene& scene_;
  };

  std::string name_;
  Answer answer_;
  Refusal refusal_;
};

}  // namespace tunica::test_support
