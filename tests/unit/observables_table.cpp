// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "core/observables/result.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using namespace tunica::observables;

namespace {

Table random_table(std::size_t rows, std::size_t columns) {
  std::mt19937_64 random(7);
  Table table;
  for (std::size_t index = 0; index < columns; ++index) {
    const std::size_t column = table.add(fmt::format("c{}", index), "1");
    for (std::size_t row = 0; row < rows; ++row) {
      const std::uint64_t bits = random();
      double value;
      std::memcpy(&value, &bits, sizeof value);
      table[column].values.push_back(value);
    }
  }
  return table;
}

std::string error_of(const std::string& text) {
  try {
    parse_csv(text, "f.csv");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST(Table, AnyNumberReadsBackBitForBit) {
  const Table written = random_table(2000, 9);
  const Table read = parse_csv(to_csv(written), "memory");
  ASSERT_EQ(read.rows(), written.rows());
  for (std::size_t column = 0; column < 9; ++column)
    for (std::size_t row = 0; row < written.rows(); ++row) {
      const double a = written[column].values[row];
      const double b = read[column].values[row];
      ASSERT_TRUE((std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0) << a << " " << b;
    }
}

TEST(Table, NoneIsAnEmptyCellAndNotZero) {
  Table table;
  table.add("a", "cm");
  table.add("b", "1");
  table[0].values = {1.5, none, 0};
  table[1].values = {none, none, -0.0};
  EXPECT_EQ(to_csv(table), "a[cm],b[1]\n1.5,\n,\n0,-0\n");
  const Table read = parse_csv(to_csv(table), "memory");
  EXPECT_TRUE(is_none(read[0].values[1]));
  EXPECT_TRUE(is_none(read[1].values[0]));
  EXPECT_EQ(read[0].values[2], 0);
}

TEST(Table, ASingleColumnKeepsItsEmptyRows) {
  Table table;
  table.add("a", "1");
  table[0].values = {none, 2, none};
  EXPECT_EQ(parse_csv(to_csv(table), "memory").rows(), 3u);
}

TEST(Table, LabelsWithQuotesCommasAndLineEndsReadBack) {
  Table table;
  table.add("point", "");
  table.add("x", "d[1]/s");
  table[0].labels = {"P1", "a,b", "say \"hi\"", "two\nlines", ""};
  table[1].values = {1, 2, 3, 4, 5};
  const Table read = parse_csv(to_csv(table), "memory");
  EXPECT_EQ(read[0].labels, table[0].labels);
  EXPECT_TRUE(read[0].is_text());
}

TEST(Table, ANameMayHoldBracketsOfItsOwn) {
  const Table read = parse_csv("d(x)/d(wall.layers[0].fraction)[cm/(1)]\n4\n", "memory");
  EXPECT_EQ(read[0].name, "d(x)/d(wall.layers[0].fraction)");
  EXPECT_EQ(read[0].unit, "cm/(1)");
}

TEST(Table, LinesOfOtherSystemsAreRead) {
  const Table read = parse_csv("a[1],p\r\n1,x\r\n2,y", "memory");
  EXPECT_EQ(read[0].values, (std::vector<double>{1, 2}));
  EXPECT_EQ(read[1].labels, (std::vector<std::string>{"x", "y"}));
}

TEST(Table, ErrorsNameFileLineAndColumn) {
  EXPECT_EQ(error_of("a[1],b[1]\n1,2\n3,four\n"), "f.csv: line 3, column 2: \"four\" is not a number");
  EXPECT_EQ(error_of("a[1],b[1]\n1\n"),
            "f.csv: line 2, column 1: the header has 2 columns, this line has fewer");
  EXPECT_EQ(error_of("a[1],b[1]\n1,2,3\n"),
            "f.csv: line 2, column 2: the header has 2 columns, this line has more");
  EXPECT_EQ(error_of("a[1],a[1]\n"), "f.csv: line 1, column 2: there are two columns \"a\"");
  EXPECT_EQ(error_of("a[1],\n"), "f.csv: line 1, column 2: a column has no name");
  EXPECT_EQ(error_of("a[]\n"), "f.csv: line 1, column 1: \"a[]\" has an empty unit");
  EXPECT_EQ(error_of("a\n\"x\n"), "f.csv: line 2, column 1: a quote is not closed");
  EXPECT_EQ(error_of("a\n\"x\"y\n"), "f.csv: line 2, column 1: text after a closing quote");
  EXPECT_EQ(error_of(""), "f.csv: the file is empty");
  EXPECT_EQ(error_of("a[1]\n1.5 \n"), "f.csv: line 2, column 1: \"1.5 \" is not a number");
}

TEST(Table, AFileThatIsMissingOrAFolderIsNamed) {
  const test_support::TemporaryFolder folder;
  for (const auto& path : {folder.path() / "missing.csv", folder.path()}) {
    try {
      read_csv(path.string());
      FAIL() << path;
    } catch (const InvalidInput& error) {
      EXPECT_EQ(error.what(), path.string() + ": the file cannot be read");
    }
  }
}

TEST(Table, ColumnsOfDifferentLengthAreAProgrammingError) {
  Table table;
  table.add("a", "1");
  table.add("b", "1");
  table[0].values = {1};
  EXPECT_THROW(to_csv(table), std::logic_error);
}

TEST(Table, StandardColumnsAreThoseOfTheContract) {
  Table table = standard_table();
  Sample sample;
  sample.time = 0.5;
  sample.wall[3].von_mises = 7;
  append(table, sample);
  std::string header =
      "time[s],inflow[cm3/s],outflow[cm3/s],pressure[dyn/cm2],outlet_pressure[dyn/cm2],"
      "transmural_pressure[dyn/cm2]";
  for (const char* point : {"P1", "P2", "P3", "P4"})
    for (const auto& [name, unit] : {std::pair{"radial_displacement", "cm"},
                                     {"fiber_angle", "deg"},
                                     {"fiber_stretch", "1"},
                                     {"recruitment", "1"},
                                     {"von_mises", "dyn/cm2"}})
      header += fmt::format(",{}.{}[{}]", name, point, unit);
  EXPECT_EQ(to_csv(table), header + "\n0.5" + std::string(25, ',') + "7\n");
}

TEST(Table, AppendRefusesTheTableOfAnotherFile) {
  Table events = event_table();
  EXPECT_THROW(append(events, Sample{}), std::logic_error);
  EXPECT_THROW(append(events, ProfilePoint{}), std::logic_error);
  Table standard = standard_table();
  EXPECT_THROW(append(standard, Event{}), std::logic_error);
}

TEST(Table, AWholeRunIsFormattedInMilliseconds) {
  const Table table = random_table(1600, 26);
  double best = 1;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    const std::string text = to_csv(table);
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    EXPECT_GT(text.size(), 100000u);
  }
  RecordProperty("milliseconds", std::to_string(best * 1e3));
  EXPECT_LT(best, 0.1) << "an order of magnitude above what an optimised build needs";
}
