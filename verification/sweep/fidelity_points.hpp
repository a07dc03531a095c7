// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "verification/sweep/points.hpp"

namespace tunica::sweep {

/// A tier and how many points it computes.
struct Fidelity {
  std::string tier;
  std::uint64_t points = 0;
};

/// Reads "TIER" or "TIER:N" of each; without N the first computes all `count` points, and each other one a
/// sixteenth of those before it, twice `fewest` at least. Throws InvalidInput for fewer than two, a tier that
/// is there twice, and numbers that are none, below `fewest` or above those of the tier before.
std::vector<Fidelity> parse_fidelities(const std::vector<std::string>& texts, std::uint64_t count,
                                       std::uint64_t fewest);

/// The same sample at several tiers: all its points by the first, then its first ones by the second, and so
/// on. describe() has the tiers as "fidelities".
std::unique_ptr<Points> fidelity_points(std::unique_ptr<Points> sample, std::vector<Fidelity> fidelities);

/// Those of a sweep's design; a design without any is one tier's with `count` points.
std::vector<Fidelity> fidelities_of(const nlohmann::ordered_json& design, const std::string& tier,
                                    std::uint64_t count);

/// Where a point of a sweep stands: the number of its tier and that in the sample.
struct Standing {
  std::size_t level = 0;
  std::uint64_t point = 0;
};
Standing standing_of(const std::vector<Fidelity>& fidelities, std::uint64_t point);

}  // namespace tunica::sweep
