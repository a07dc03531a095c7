// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

namespace tunica::sweep {

inline constexpr const char* indices_file = "indices.csv";

/// What the indices of a sweep come to.
struct IndexSummary {
  double widest = 0;  ///< of all intervals; 0 where no quantity varies
  std::uint64_t groups = 0,
                lost = 0;  ///< points of a group count together: those without all results are lost
};

/// Writes indices.csv of a sweep whose points are a pick-freeze sample: first and total Sobol' indices of
/// each quantity by each key, with 95 % intervals (uncertainty::sobol_indices); empty cells for quantities
/// that the law or tier has not or that do not vary. Throws InvalidInput for other sweeps, OutputFailure.
IndexSummary write_indices(const std::filesystem::path& folder);

/// Whether a folder's sweep is of that kind.
bool has_indices(const std::filesystem::path& folder);

}  // namespace tunica::sweep
