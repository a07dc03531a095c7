// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/observables/table.hpp"

namespace tunica::observables {

/// Looks into a record.json, which may be of any version or edited by hand: what is missing, or is of
/// another type, comes back empty.
std::string record_text(const nlohmann::ordered_json& record, std::string_view key);
bool record_flag(const nlohmann::ordered_json& record, std::string_view key);
/// Values of the run's scene by key; an empty object when there is none.
const nlohmann::ordered_json& recorded_scene(const nlohmann::ordered_json& record);
std::string scene_text(const nlohmann::ordered_json& record, std::string_view key);
/// `none` when missing.
double scene_number(const nlohmann::ordered_json& record, std::string_view key);

}  // namespace tunica::observables
