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

/// The unit that people read a column in, as a number of the column's own: mmHg, 1e5 dyn/cm2 for stresses.
double display_unit(const observables::Column& column);

/// What a verification found, and the curves of its differences as JSON for a <script> element. Empty, and
/// "[]", for null.
std::string comparison_section(const verification::CrossTier* found);
std::string comparison_data(const verification::CrossTier* found);

/// The square of a run's colour, which the charts give it too.
std::string swatch(std::size_t run);

/// Values of runs that have a single state, and a place for the charts of them. Empty without such runs.
std::string states_section(const std::vector<RunSummary>& runs);

std::string headline_table(const std::vector<RunSummary>& runs);
/// What the runs found out and remark on, each line once.
std::string remarks_section(const std::vector<RunSummary>& runs);
std::string claims_section(const std::vector<StoredResult>& stored, const std::vector<RunSummary>& runs);
std::string events_section(const std::vector<RunSummary>& runs);
std::string runs_section(const std::vector<RunSummary>& runs);

}  // namespace tunica::report
