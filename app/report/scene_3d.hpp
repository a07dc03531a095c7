// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/report/summary.hpp"

namespace tunica::report {

/// Bytes of text that pictures in space may add to a report, over all its runs.
inline constexpr std::size_t scene_budget = 12'500'000;

/// Runs whose fields are on cells in space, for the page's viewer: the surface and a lengthwise section of
/// each part, with values quantised. What would be larger than the budget is made coarser: values with 8 in
/// place of 16 bits, then only every second, third, ... time.
struct Scene3d {
  std::string json;   ///< for a <script> element; empty when no run has such fields
  std::string notes;  ///< HTML that tells what was left out, empty when nothing was
};

/// Takes a run's fields from memory, or else, as it does not hold them after read_result, from its folder.
/// Throws InvalidInput when that has a broken file.
Scene3d scene_3d(const std::vector<RunSummary>& runs, std::size_t budget = scene_budget);

/// The page's section with the viewer, its scripts with the library, and whose that is; all are empty without
/// fields, so that reports without them stay small.
std::string viewer_section(const Scene3d& scene);
std::string viewer_scripts(const Scene3d& scene);
std::string viewer_credit(const Scene3d& scene);

}  // namespace tunica::report
