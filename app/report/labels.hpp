// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/observables/result.hpp"

namespace tunica::report {

/// A scene key in which runs differ.
struct Difference {
  std::string key;                  ///< "wall.law", "tier", "outlet.resistance"
  std::vector<std::string> values;  ///< of each run, with unit: "80 mmHg"; "–" where the run has no such key
};

/// Whether people read a key's numbers, given in `unit`, in mmHg: pressures, but not moduli.
bool is_read_in_mmhg(std::string_view key, std::string_view unit);

/// What tells runs apart: the law, the tier, and the keys that one of their scenes sets and whose values
/// differ, those that change the physics before those that change the numbers; what only concerns the output
/// is none.
std::vector<Difference> differences_of(const std::vector<StoredResult>& runs);

/// A short name for each run, all of them different, from the keys that differ: "EXP1", "EXP1, axisym",
/// "resistance 1.2e6 dyn s/cm5". Where scenes of other names differ in many keys, the scene's name stands for
/// those; the folder comes in where nothing else tells runs apart. A single run is named by its law.
std::vector<std::string> labels_of(const std::vector<StoredResult>& runs);

}  // namespace tunica::report
