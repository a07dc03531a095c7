// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/run/scene_source.hpp"
#include "verification/calibration/calibrate.hpp"

namespace tunica::verification::calibration {

/// calibration.csv: parameter, value, low, high, standard_deviation, unit; empty cells for what is not known.
std::string parameters_csv(const Task& task, const Calibration& found);
/// targets.csv: quantity, target, reached, unit.
std::string targets_csv(const Task& task, const Calibration& found);
/// calibration.json.
nlohmann::ordered_json to_json(const Task& task, const Calibration& found, const Scene& scene);

/// The scene with the values that were found, as a file that runs from any folder: files that it names have
/// their whole path.
std::string calibrated_scene(const run::SceneSource& source, const Task& task, const Calibration& found);

/// What a user has to know about the answer, one line each: conflicting targets and by how much each is
/// missed, keys without influence or determined together only, keys at a bound, starts that end elsewhere.
std::vector<std::string> findings(const Task& task, const Calibration& found);

}  // namespace tunica::verification::calibration
