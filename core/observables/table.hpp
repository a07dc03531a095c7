// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::observables {

/// Stands for a quantity that a law or a tier has not: an empty cell on disk, never 0.
inline constexpr double none = std::numeric_limits<double>::quiet_NaN();
inline bool is_none(double value) {
  return std::isnan(value);
}

/// A named column with its unit; text columns (names of points) hold `labels` instead of numbers.
struct Column {
  std::string name;
  std::string unit;  ///< as in the header: "dyn/cm2", "1", "deg"; empty for a text column
  std::vector<double> values;
  std::vector<std::string> labels;

  bool is_text() const { return unit.empty(); }
  std::size_t size() const { return is_text() ? labels.size() : values.size(); }
};

/// Columns of equal length; one row per output time (or per event, per place).
class Table {
 public:
  /// Adds an empty column and returns its index.
  std::size_t add(std::string name, std::string unit);
  std::size_t rows() const { return columns_.empty() ? 0 : columns_.front().size(); }
  const std::vector<Column>& columns() const { return columns_; }
  Column& operator[](std::size_t index) { return columns_[index]; }
  const Column& operator[](std::size_t index) const { return columns_[index]; }
  /// Null when there is no such column.
  const Column* find(std::string_view name) const;

 private:
  std::vector<Column> columns_;
};

/// CSV text (RFC 4180 quoting, "\n" line ends): header "name[unit]" (a text column: "name"), numbers as
/// the shortest text that reads back to the same double, empty cells for `none`. Empty text for a
/// table without columns. Throws std::logic_error when columns differ in length.
std::string to_csv(const Table& table);

/// Reads what to_csv wrote. Throws InvalidInput naming file, line and column.
Table read_csv(const std::string& path);

/// The same from text; `name` stands for the file in messages.
Table parse_csv(std::string_view text, std::string_view name);

}  // namespace tunica::observables
