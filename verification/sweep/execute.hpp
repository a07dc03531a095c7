// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "verification/sweep/campaign.hpp"

namespace tunica::sweep {

/// Those of the question's keys by which a point with these overrides has derivatives: where one key chooses
/// which others count, not all of them act on every point. All of them where the overrides make no scene.
std::vector<std::string> offered_keys(const Campaign& campaign, const std::vector<std::string>& overrides);

/// Computes the points of a campaign's shard that have no row, on its jobs' threads, and inserts each as it
/// ends. True when it was interrupted: points that were under way then have no row. Throws OutputFailure when
/// a row cannot be written.
bool execute(const Campaign& campaign, const std::filesystem::path& folder, Table& table,
             const SweepControl& control);

}  // namespace tunica::sweep
