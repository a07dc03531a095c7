// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "app/report/summary.hpp"
#include "verification/cross_tier.hpp"

namespace tunica::report {

/// What the page's script draws, as JSON for a <script> element: every row of the runs in mmHg, cm3/s, cm,
/// deg and 1e5 dyn/cm2, rounded to 7 digits.
std::string chart_data(const std::vector<RunSummary>& runs);

/// What a verification found, and the curves of its differences as JSON for a <script> element. Empty, and
/// "[]", for null.
std::string comparison_section(const verification::CrossTier* found);
std::string comparison_data(const verification::CrossTier* found);

std::string headline_table(const std::vector<RunSummary>& runs);
std::string claims_section(const std::vector<StoredResult>& runs);
std::string events_section(const std::vector<RunSummary>& runs);
std::string runs_section(const std::vector<RunSummary>& runs);

}  // namespace tunica::report
