// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace tunica::report {

/// indices.csv of a sweep's folder as a JSON object of columns, with "surrogates" where sweep.json tells of
/// them: kind, held-out Q2, points and what is wrong with it, by quantity. "null" without indices.csv.
void append_indices(std::string& json, const std::filesystem::path& folder,
                    const nlohmann::ordered_json& campaign);

/// Where the tiers of a sweep at several differ: fidelities.csv as an HTML section; empty without one.
std::string tiers_section(const std::filesystem::path& folder, const nlohmann::ordered_json& campaign);

}  // namespace tunica::report
