// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "verification/sweep/row.hpp"

namespace tunica::report {

/// A key of a sweep as the page shows it: values fall into levels, one for each value where there are few,
/// otherwise equal parts of the range, or of its logarithm.
struct SweepKey {
  std::string name, unit;  ///< unit for people: "mmHg"; empty for texts
  double factor = 1;       ///< from the table's numbers to those shown
  bool is_log = false;
  std::vector<std::string> texts;  ///< of a key that holds texts: its values
  std::vector<double> places;      ///< of the levels, in the shown unit; 0, 1, 2 ... for texts
  bool is_binned = false;          ///< places are middles of parts of the range
  double lowest = 0, highest = 0;  ///< shown unit

  bool is_text() const { return !texts.empty(); }
  std::size_t level(double shown) const;
};

struct SweepQuantity {
  std::string name, unit;
  double factor = 1;
};

/// Points of one reason, as many of them as a table bears.
struct SweepFailure {
  std::string status, reason;
  std::uint64_t count = 0;
  std::vector<std::uint64_t> points;  ///< the first ones
};

/// What the page is made of. Of more than `most_rows` points a share is kept, which the points' own numbers
/// decide as by chance, so that memory and time are bounded and the same table gives the same page.
struct SweepTable {
  static constexpr std::uint64_t most_rows = 20000;

  std::vector<SweepKey> keys;
  std::vector<SweepQuantity> quantities;
  std::uint64_t planned = 0, ended = 0, done = 0;
  std::vector<SweepFailure> failures;

  /// Rows kept, done or failed; columns are shown units, texts by their index, none where there is no value.
  std::vector<std::uint64_t> numbers;
  std::vector<char> is_done;
  std::vector<std::vector<double>> key_values;  ///< by key and row
  std::vector<std::vector<double>> values;      ///< by quantity and row
};

/// Reads sweep.json and sweep.db, also of a sweep that is still growing. Throws InvalidInput for a folder
/// without a sweep and for one without rows.
SweepTable read_sweep(const std::filesystem::path& folder);

/// One row of the sweep in the folder. Throws InvalidInput naming the points there are.
sweep::Row read_point(const std::filesystem::path& folder, std::uint64_t point);

/// Quantiles over the rows of one level of a key: the spread over the other keys.
struct LevelSpread {
  std::vector<double> count, mean, q05, q25, q50, q75, q95;  ///< by level; none for a level without rows
};
LevelSpread spread(const SweepTable& table, std::size_t key, std::size_t quantity);

/// Mean of a quantity by the levels of two keys, the second fastest; none for cells without rows.
std::vector<double> cell_means(const SweepTable& table, std::size_t first, std::size_t second,
                               std::size_t quantity);

/// A number that orders points as by chance (splitmix64 of the point's number).
std::uint64_t lot_of(std::uint64_t point);

}  // namespace tunica::report
