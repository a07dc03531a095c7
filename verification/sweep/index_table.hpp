// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "verification/uncertainty/indices.hpp"

namespace tunica::sweep {

inline constexpr const char* indices_file = "indices.csv";

/// What the indices of a sweep come to.
struct IndexSummary {
  double widest = 0;         ///< of all intervals; 0 where no quantity varies
  std::uint64_t groups = 0;  ///< of a pick-freeze sample; the points of one count together; else 0
  std::uint64_t lost = 0;    ///< of them, or of the points, those without all results
  std::uint64_t points = 0;  ///< of the dearest tier that surrogates are made of
  /// Quantities whose surrogate misses much, or that have none, with the reason; one line each.
  std::vector<std::string> poor = {};
  bool interrupted = false;  ///< while surrogates were made: nothing is written
};

/// Writes indices.csv of a sweep that is for them: first and total Sobol' indices of each quantity by each
/// key, with 95 % intervals; of a pick-freeze sample by uncertainty::sobol_indices, else by write_surrogates.
/// Empty cells for quantities that the law or tier has not or that do not vary. `interrupted` is asked by all
/// threads. Throws InvalidInput for other sweeps, OutputFailure.
IndexSummary write_indices(
    const std::filesystem::path& folder, const std::function<bool()>& interrupted = [] { return false; });

/// Whether a folder's sweep is of that kind.
bool has_indices(const std::filesystem::path& folder);

/// The lines of one quantity by one key, and the head of them all.
std::string index_head();
std::string index_line(const std::string& quantity, const std::string& key,
                       const uncertainty::SobolIndices& indices);

}  // namespace tunica::sweep
