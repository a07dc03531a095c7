// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/observables/result.hpp"

namespace tunica {

namespace verification {
struct CrossTier;
}

/// One HTML file, complete in itself, that shows runs side by side: key numbers, charts, the paper's
/// claims, recruitment events, scenes and records. It opens offline and asks nothing of the network.
///
/// <html data-status> is "ok" when all charts are drawn, then data-charts is their number; it is "error",
/// with data-message, when the page's script failed.
/// With fields on cells in space, among the results or in the run's folder, it has a viewer of the artery;
/// then <html data-viewer> is "ok", or "missing" in a browser without WebGL.
/// With `comparison`, the runs are its tiers' and the page begins with what it found.
/// Throws InvalidInput when there is no run, or a run without rows, or fields that cannot be read.
std::string make_report(const std::vector<StoredResult>& runs,
                        const verification::CrossTier* comparison = nullptr);

}  // namespace tunica
