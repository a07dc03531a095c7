// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/observables/result.hpp"

namespace tunica {

/// One HTML file, complete in itself, that shows runs side by side: key numbers, charts, the paper's
/// claims, recruitment events, scenes and records. It opens offline and asks nothing of the network.
///
/// <html data-status> is "ok" when all charts are drawn, then data-charts is their number; it is "error",
/// with data-message, when the page's script failed.
/// Throws InvalidInput when there is no run, or a run without rows.
std::string make_report(const std::vector<StoredResult>& runs);

}  // namespace tunica
