// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tunica {

/// One HTML file, complete in itself, that shows a sweep: each quantity against each key with the spread over
/// the other keys, heat maps over two keys, the reach of each key, Sobol' indices where the folder has them,
/// parallel coordinates, points without a result and why, and the curves of points whose whole results are
/// in FOLDER/points: those in `chosen` first, and no more of them than charts bear.
///
/// Bounds: SweepTable::most_rows rows enter curves and maps, `most_drawn` are drawn one by one, and tell so.
/// <html data-status> is as of make_report; data-points is the number of points drawn.
/// Throws InvalidInput for a folder without a sweep, without rows, or with results that cannot be read.
std::string make_sweep_report(const std::filesystem::path& folder,
                              const std::vector<std::uint64_t>& chosen = {});

}  // namespace tunica
