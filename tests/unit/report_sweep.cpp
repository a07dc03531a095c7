// SPDX-License-Identifier: GPL-3.0-or-later
// What goes into the page of a sweep, against the formulas that the sweep is made of.
#include <gtest/gtest.h>

#include <cmath>

#include "app/report/sweep_page.hpp"
#include "app/report/sweep_table.hpp"
#include "core/error.hpp"
#include "core/observables/result.hpp"
#include "tests/support/made_sweep.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using namespace tunica::report;

namespace {

class ReportSweep : public testing::Test {
 protected:
  std::filesystem::path made(const test_support::MadeSweep& how = {}) const {
    test_support::make_sweep(folder_.path() / "sweep", how);
    return folder_.path() / "sweep";
  }
  test_support::TemporaryFolder folder_;
};

/// Numbers pass through a database and a factor for mmHg.
constexpr double rounding = 1e-9;

}  // namespace

TEST_F(ReportSweep, KeysHaveTheLevelsOfTheirValues) {
  const SweepTable table = read_sweep(made());
  ASSERT_EQ(table.keys.size(), 3U);
  EXPECT_TRUE(table.keys[0].is_log);  // equal ratios
  EXPECT_FALSE(table.keys[2].is_log);
  EXPECT_EQ(table.keys[0].places.size(), 5U);
  EXPECT_EQ(table.keys[1].texts, (std::vector<std::string>{"EXP1", "EXP2"}));
  EXPECT_EQ(table.ended, 30U);
  EXPECT_EQ(table.done, 29U);
  // Fibres' angles, which no point has, are no choice; pressures are in mmHg.
  ASSERT_EQ(table.quantities.size(), 2U);
  EXPECT_EQ(table.quantities[0].unit, "mmHg");
  EXPECT_NEAR(table.values[0][0], 60, rounding);
}

TEST_F(ReportSweep, SpreadIsThatOfTheOtherKeys) {
  const SweepTable table = read_sweep(made());
  const LevelSpread by_resistance = spread(table, 0, 0);
  // 60 + 10 i + k, k = 0, 1, 2 twice each.
  EXPECT_NEAR(by_resistance.mean[1], 71, rounding);
  EXPECT_NEAR(by_resistance.q50[1], 71, rounding);
  EXPECT_NEAR(by_resistance.q05[1], 70, rounding);
  EXPECT_NEAR(by_resistance.q95[1], 72, rounding);
  EXPECT_NEAR(by_resistance.q25[1], 70.25, rounding);  // 0, 0, 1, 1, 2, 2 at place 1.25
  // The last point has no value: 0, 0, 1, 1, 2 remain.
  EXPECT_EQ(by_resistance.count[4], 5);
  EXPECT_NEAR(by_resistance.mean[4], 100.8, rounding);
}

TEST_F(ReportSweep, CellsAreMeansAndEmptyOnesAreNone) {
  SweepTable table = read_sweep(made());
  const auto cells = cell_means(table, 0, 2, 0);
  ASSERT_EQ(cells.size(), 15U);
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(cells[3 * i + k], 60 + 10 * i + k, rounding) << i << " " << k;
  for (double& value : table.values[0]) value = observables::none;
  for (const double mean : cell_means(table, 0, 2, 0)) EXPECT_TRUE(observables::is_none(mean));
}

TEST_F(ReportSweep, ManyValuesFallIntoEqualPartsOfTheRange) {
  const SweepTable table = read_sweep(made({.many = 101}));
  const SweepKey& key = table.keys[0];
  ASSERT_TRUE(key.is_binned);
  EXPECT_FALSE(key.is_log);  // a range of 4 in many values, which nothing calls logarithmic
  EXPECT_EQ(key.level(key.lowest), 0U);
  EXPECT_EQ(key.level(key.highest), key.places.size() - 1);
  for (std::size_t k = 0; k < key.places.size(); ++k) EXPECT_EQ(key.level(key.places[k]), k);
  const LevelSpread found = spread(table, 0, 0);
  double count = 0;
  for (const double one : found.count) count += one;
  EXPECT_EQ(count, 605);
}

TEST_F(ReportSweep, ManyPointsAreThinnedAndSaySo) {
  // 24000 points, of which a share of 5/6 is kept: 20000 within five standard deviations of 58.
  const auto folder = made({.many = 4000});
  const SweepTable table = read_sweep(folder);
  EXPECT_EQ(table.ended, 24000U);
  EXPECT_NEAR(static_cast<double>(table.numbers.size()), 20000, 290);
  const std::string page = make_sweep_report(folder);
  EXPECT_NE(page.find(" of the 24000 points, taken as by chance"), std::string::npos);
  EXPECT_NE(page.find("2000 points are drawn one by one"), std::string::npos);
  EXPECT_LT(page.size(), 2'000'000U);
}

TEST_F(ReportSweep, FailuresAreToldWithTheirReason) {
  const std::string page = make_sweep_report(made({.reason = "</script><b>torn & \"split\""}));
  EXPECT_NE(page.find("<td class=\"text\">&lt;/script&gt;&lt;b&gt;torn &amp; &quot;split&quot;</td><td>1</td>"
                      "<td class=\"text\">29</td>"),
            std::string::npos);
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
}

TEST_F(ReportSweep, IndicesThatAreNoNumbersAreRefused) {
  const auto folder = made({.with_indices = true});
  EXPECT_NE(make_sweep_report(folder).find("\"first_low\":[0.85,-0.02,0.05]"), std::string::npos);
  write_whole(folder / "indices.csv",
              "quantity,parameter,first,first_low,first_high,total,total_low,total_high\na,b,x,0,0,0,0,0\n");
  try {
    make_sweep_report(folder);
    FAIL() << "no refusal";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("x is no number, in column first"), std::string::npos);
  }
}

TEST_F(ReportSweep, AskedForAPointThatIsNotThere) {
  const auto folder = made();
  EXPECT_EQ(read_point(folder, 29).status, "gave-up");
  EXPECT_THROW(read_point(folder, 30), InvalidInput);
  EXPECT_THROW(make_sweep_report(folder_.path()), InvalidInput);
}
