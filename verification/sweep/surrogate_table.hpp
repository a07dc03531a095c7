// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "verification/sweep/index_table.hpp"

namespace tunica::sweep {

inline constexpr const char* fidelities_file = "fidelities.csv";

/// Whether a sweep.json asks for surrogates of its points.
bool makes_surrogates(const nlohmann::ordered_json& campaign);

/// Makes a surrogate of each quantity from the points of a sample that are done, at most the first
/// uncertainty::most_points of them, and writes
///   indices.csv     Sobol' indices of the surrogates, whose intervals hold what the surrogates miss;
///   sweep.json      "surrogates": for each quantity its kind, its held-out Q2, how many points it is made
///                   of, the mean with its interval and the standard deviation, or why there is none;
///   fidelities.csv  of a sweep at several tiers, how far the values of each dearer tier are from the first
///                   one's: `quantity,unit,cheap,dear,points,range,mean_difference,largest_difference,
///                   largest_at,beyond_5_percent`; the range is that of both over the points that they share,
///                   the last two are the number of a point of the sample and a count of points.
/// A quantity has no surrogate where it is known at fewer than 9 in 10 of the points that are done, or where
/// the surrogate misses more than half of the variance. `interrupted` is asked before each quantity, by all
/// threads. Throws InvalidInput, OutputFailure.
IndexSummary write_surrogates(const std::filesystem::path& folder, const std::function<bool()>& interrupted);

}  // namespace tunica::sweep
