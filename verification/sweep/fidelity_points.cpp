// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/sweep/fidelity_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/error.hpp"
#include "core/scene/message.hpp"

namespace tunica::sweep {

namespace {

using Json = nlohmann::ordered_json;

class FidelityPoints final : public Points {
 public:
  FidelityPoints(std::unique_ptr<Points> sample, std::vector<Fidelity> fidelities)
      : sample_(std::move(sample)), fidelities_(std::move(fidelities)) {}
  const std::vector<Varied>& keys() const override { return sample_->keys(); }
  std::uint64_t count() const override {
    std::uint64_t all = 0;
    for (const Fidelity& fidelity : fidelities_) all += fidelity.points;
    return all;
  }
  std::vector<std::string> values(std::uint64_t point) override {
    return sample_->values(standing_of(fidelities_, point).point);
  }
  std::string tier(std::uint64_t point) const override {
    return fidelities_[standing_of(fidelities_, point).level].tier;
  }
  Json describe() const override {
    Json all = sample_->describe();
    for (const Fidelity& fidelity : fidelities_)
      all["fidelities"].push_back({{"tier", fidelity.tier}, {"points", fidelity.points}});
    return all;
  }

 private:
  std::unique_ptr<Points> sample_;
  std::vector<Fidelity> fidelities_;
};

}  // namespace

std::vector<Fidelity> parse_fidelities(const std::vector<std::string>& texts, std::uint64_t count,
                                       std::uint64_t fewest) {
  if (texts.size() < 2)
    throw InvalidInput("--fidelities: name two tiers or more, from cheap to dear, as in lumped,axisym");
  std::vector<Fidelity> all;
  constexpr std::uint64_t share = 16;
  for (const std::string& text : texts) {
    const std::size_t colon = text.find(':');
    Fidelity fidelity{text.substr(0, colon), all.empty() ? count : all.back().points};
    const std::uint64_t most = fidelity.points;
    if (!all.empty()) fidelity.points = std::min(most, std::max(2 * fewest, most / share));
    if (colon != std::string::npos) {
      const char *begin = text.data() + colon + 1, *back = text.data() + text.size();
      const auto [end, error] = std::from_chars(begin, back, fidelity.points);
      if (error != std::errc{} || end != back)
        throw InvalidInput(fmt::format("--fidelities {}: write TIER or TIER:N with a number of points",
                                       scene::one_line(text)));
    }
    if (fidelity.points > most)
      throw InvalidInput(
          fmt::format("--fidelities {}: there are {} points {}; a dearer tier computes some of "
                      "those of the cheaper one",
                      scene::one_line(text), most, all.empty() ? "in the sample" : "before it"));
    if (fidelity.points < fewest)
      throw InvalidInput(
          fmt::format("--fidelities {}: {} points are too few for a surrogate; take {} or more",
                      scene::one_line(text), fidelity.points, fewest));
    if (std::any_of(all.begin(), all.end(), [&](const Fidelity& one) { return one.tier == fidelity.tier; }))
      throw InvalidInput(fmt::format("--fidelities: {} is there twice", scene::one_line(fidelity.tier)));
    all.push_back(std::move(fidelity));
  }
  return all;
}

std::unique_ptr<Points> fidelity_points(std::unique_ptr<Points> sample, std::vector<Fidelity> fidelities) {
  return std::make_unique<FidelityPoints>(std::move(sample), std::move(fidelities));
}

std::vector<Fidelity> fidelities_of(const Json& design, const std::string& tier, std::uint64_t count) {
  if (!design.contains("fidelities")) return {{tier, count}};
  std::vector<Fidelity> all;
  for (const Json& one : design.at("fidelities")) all.push_back({one.at("tier"), one.at("points")});
  return all;
}

Standing standing_of(const std::vector<Fidelity>& fidelities, std::uint64_t point) {
  Standing standing{0, point};
  while (standing.level + 1 < fidelities.size() && standing.point >= fidelities[standing.level].points)
    standing.point -= fidelities[standing.level++].points;
  return standing;
}

}  // namespace tunica::sweep
