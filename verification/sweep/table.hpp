// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "verification/sweep/points.hpp"
#include "verification/sweep/row.hpp"

namespace tunica::sweep {

/// sweep.db: an SQLite database with a table "sweep", whose columns are those of sweep.csv. A row is on its
/// way to the disk when insert() returns: a process that is killed loses none, and others may read while it
/// grows (write-ahead log).
class Table {
 public:
  enum class Mode {
    create,
    open,  ///< one that is there, or an empty file that a kill at the very beginning has left
    read   ///< one that is there, to take from
  };
  /// Throws InvalidInput when the file is none of these tables, has other columns, or another program keeps
  /// it locked; OutputFailure when it cannot be written.
  Table(const std::filesystem::path& file, Mode mode, std::vector<Varied> keys,
        std::vector<NumberColumn> numbers);
  ~Table();
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  /// A row for a point that has none. Throws OutputFailure; the rows before stay. One thread at a time.
  void insert(const Row& row);
  /// Numbers of the points that have a row, ascending.
  std::vector<std::uint64_t> points() const;
  /// Hands over all rows in the order of points.
  void each(const std::function<void(const Row&)>& use) const { each(use, numbers_.size()); }
  /// The same with no more than the first of their numbers, such as quantities without gradients.
  void each(const std::function<void(const Row&)>& use, std::size_t numbers) const;
  std::uint64_t count(const std::string& status) const;
  double seconds() const;  ///< of all rows together
  /// Adds the rows of another table of the same columns, all or none.
  void take(const Table& other);

  const std::vector<Varied>& keys() const { return keys_; }
  const std::vector<NumberColumn>& numbers() const { return numbers_; }

 private:
  struct Database;
  std::vector<Varied> keys_;
  std::vector<NumberColumn> numbers_;
  std::unique_ptr<Database> database_;
};

/// Writes the rows as CSV in the order of points, whole or not at all. `timings` fills seconds[s], which
/// stays empty else: the same sweep then gives the same file, whatever computed it.
void write_csv(const Table& table, const std::filesystem::path& file, bool timings);

}  // namespace tunica::sweep
