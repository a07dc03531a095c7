// SPDX-License-Identifier: GPL-3.0-or-later
// Sobol' indices from surrogates, and sweeps at several tiers, as users ask for them.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "core/observables/result.hpp"
#include "core/observables/table.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace tunica;
using test_support::Ended;
using test_support::is_one_line;
using test_support::read_text;
using test_support::TemporaryFolder;
using Json = nlohmann::ordered_json;

namespace {

using Texts = std::vector<std::string>;

/// A row of indices.csv: first, first_low, first_high, total, total_low, total_high; none for empty cells.
using Indices = std::map<std::string, std::vector<double>>;  ///< by "quantity,parameter"

const Texts varied{"--vary", "outlet.resistance=5e5:2e6", "--vary", "tether.stiffness=3e6:3e7"};

class SweepSurrogates : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  Ended sweep(const std::string& out, const Texts& more) const {
    Texts all{"sweep",
              std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml",
              "--quiet",
              "--quantity",
              "pressure.max",
              "--quantity",
              "radial_displacement.P1.max",
              "--out",
              path(out)};
    all.insert(all.end(), more.begin(), more.end());
    return test_support::tunica(all, folder_.path());
  }
  Ended varied_sweep(const std::string& out, const Texts& more) const {
    Texts all = varied;
    all.insert(all.end(), more.begin(), more.end());
    return sweep(out, all);
  }
  Json campaign(const std::string& name) const { return Json::parse(read_text(path(name + "/sweep.json"))); }
  Indices indices(const std::string& name) const {
    std::istringstream lines(read_text(path(name + "/indices.csv")));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "quantity,parameter,first,first_low,first_high,total,total_low,total_high");
    Indices all;
    while (std::getline(lines, line)) {
      std::vector<std::string> cells;
      std::istringstream rest(line);
      for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
      cells.resize(8);
      auto& row = all[cells[0] + "," + cells[1]];
      for (std::size_t k = 2; k < 8; ++k)
        row.push_back(cells[k].empty() ? observables::none : std::stod(cells[k]));
    }
    return all;
  }

  TemporaryFolder folder_;
};

}  // namespace

// 40 points by a surrogate and 4,096 by a pick-freeze sample say the same: the latter's values, whose own
// errors are some 0.01 with Sobol's points, lie in the former's intervals widened by that.
TEST_F(SweepSurrogates, SayWhatManyPointsSay) {
  ASSERT_EQ(
      varied_sweep("few", {"--tier", "lumped", "--sample", "sobol:40", "--indices", "--surrogate"}).code, 0);
  ASSERT_EQ(varied_sweep("many", {"--tier", "lumped", "--sample", "sobol:1024", "--indices"}).code, 0);
  const Indices few = indices("few"), many = indices("many");
  ASSERT_EQ(few.size(), 4U);
  constexpr double of_many = 0.015;
  for (const auto& [row, values] : few) {
    for (const std::size_t at : {std::size_t{0}, std::size_t{3}}) {
      EXPECT_GE(many.at(row)[at], values[at + 1] - of_many) << row;
      EXPECT_LE(many.at(row)[at], values[at + 2] + of_many) << row;
    }
    EXPECT_LT(values[2] - values[1], 0.2) << row;
  }
  const Json told = campaign("few");
  EXPECT_EQ(told.at("points"), 40);
  for (const Json& surrogate : told.at("surrogates")) {
    EXPECT_GT(surrogate.at("q2"), 0.95);
    EXPECT_EQ(surrogate.at("points"), 40);
    EXPECT_LT(surrogate.at("mean").at("low"), surrogate.at("mean").at("high"));
  }
  EXPECT_EQ(told.at("intervals"), "95 %, with what the surrogates miss");
  EXPECT_FALSE(campaign("many").contains("surrogates"));
  EXPECT_NE(read_text(path("few/report.html")).find("\"q2\":"), std::string::npos);
}

TEST_F(SweepSurrogates, ShardsMakeTheSame) {
  const Texts sample{"--tier", "lumped", "--sample", "lhs:30", "--indices", "--surrogate"};
  ASSERT_EQ(varied_sweep("whole", sample).code, 0);
  for (const std::string part : {"1", "2"}) {
    Texts all = sample;
    all.insert(all.end(), {"--shard", part + "/2"});
    ASSERT_EQ(varied_sweep("part" + part, all).code, 0);
    EXPECT_FALSE(std::filesystem::exists(path("part" + part + "/indices.csv")));
  }
  ASSERT_EQ(test_support::tunica(
                {"sweep", "--quiet", "--out", path("merged"), "--merge", path("part1"), path("part2")})
                .code,
            0);
  EXPECT_EQ(read_text(path("merged/indices.csv")), read_text(path("whole/indices.csv")));
  EXPECT_EQ(campaign("merged").at("surrogates"), campaign("whole").at("surrogates"));
}

// Batches are added, each of as many points as the first, and what they come to is the same as at once.
TEST_F(SweepSurrogates, GrowByBatches) {
  ASSERT_EQ(varied_sweep("until", {"--tier", "lumped", "--sample", "sobol:16", "--indices", "--surrogate",
                                   "--until", "0.01"})
                .code,
            0);
  const std::uint64_t grown = campaign("until").at("points");
  EXPECT_GT(grown, 16U);
  EXPECT_EQ(grown % 16, 0U);
  EXPECT_LT(grown, 2000U);
  for (const auto& [row, values] : indices("until"))
    for (const std::size_t at : {std::size_t{0}, std::size_t{3}})
      EXPECT_LE(values[at + 2] - values[at + 1], 0.01) << row;
  ASSERT_EQ(varied_sweep("once", {"--tier", "lumped", "--sample", "sobol:" + std::to_string(grown),
                                  "--indices", "--surrogate"})
                .code,
            0);
  EXPECT_EQ(read_text(path("until/indices.csv")), read_text(path("once/indices.csv")));
}

// A listed point that makes no scene is left out, and the others' surrogate stands.
TEST_F(SweepSurrogates, TakeListedPointsAndLeaveOutThoseWithoutAResult) {
  std::string text = "outlet.resistance,tether.stiffness\n";
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k)
      text += std::to_string(500000 + 300000 * i) + "," + std::to_string(3000000 + 5400000 * k) + "\n";
  write_whole(path("points.csv"), text);
  Texts listed{"--tier", "lumped", "--points", path("points.csv"), "--indices"};
  ASSERT_EQ(varied_sweep("listed", listed).code, 0);
  EXPECT_GT(indices("listed").at("pressure.max,outlet.resistance")[0], 0.9);
  ASSERT_EQ(
      varied_sweep("drawn", {"--tier", "lumped", "--sample", "sobol:36", "--indices", "--surrogate"}).code,
      0);
  const double drawn = indices("drawn").at("pressure.max,outlet.resistance")[3];
  EXPECT_NEAR(indices("listed").at("pressure.max,outlet.resistance")[3], drawn, 0.02);

  // A wall more than ten times as thick as the lumen is wide is refused.
  std::string faulty = "outlet.resistance,tether.stiffness,geometry.thickness\n";
  for (int i = 0; i < 32; ++i)
    faulty += std::to_string(500000 + 48000 * i) + "," +
              std::to_string(3000000 + 27000000 * (i * 7 % 32) / 32) + "," +
              (i == 9 ? "0.5" : std::to_string(0.008 + 0.0001 * (i * 11 % 32))) + "\n";
  write_whole(path("faulty.csv"), faulty);
  listed[3] = path("faulty.csv");
  listed.insert(listed.end(), {"--vary", "geometry.thickness=0.008:0.6"});
  ASSERT_EQ(varied_sweep("faulty", listed).code, 0);
  EXPECT_EQ(campaign("faulty").at("counts").at("done"), 31);
  EXPECT_EQ(campaign("faulty").at("surrogates").at(0).at("points"), 31);
}

// At two tiers: the same points by both, the columns of sweep.csv tell which, and the comparison is theirs.
TEST_F(SweepSurrogates, AtTwoTiersTellWhereTheyDiffer) {
  const Texts both{"--sample",         "sobol:40", "--fidelities",
                   "lumped,axisym:18", "--set",    "mesh.motion=sectional"};
  ASSERT_EQ(varied_sweep("both", both).code, 0);
  const auto rows = observables::parse_csv(read_text(path("both/sweep.csv")), "sweep.csv");
  ASSERT_EQ(rows.rows(), 58U);
  const auto& tier = rows.find("tier")->labels;
  const auto &resistance = rows.find("outlet.resistance")->values,
             &pressure = rows.find("pressure.max")->values;
  double sum = 0, lowest = pressure[0], highest = pressure[0];
  for (std::size_t i = 0; i < 18; ++i) {
    EXPECT_EQ(tier[i], "lumped");
    EXPECT_EQ(tier[40 + i], "axisym");
    EXPECT_EQ(resistance[40 + i], resistance[i]);
    sum += pressure[40 + i] - pressure[i];
    for (const double value : {pressure[i], pressure[40 + i]}) {
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  const std::string text = read_text(path("both/fidelities.csv"));
  EXPECT_EQ(
      text.substr(0, text.find('\n')),
      "quantity,unit,cheap,dear,points,range,mean_difference,largest_difference,largest_at,beyond_5_percent");
  std::istringstream line(text.substr(text.find("\npressure.max") + 1));
  std::vector<std::string> cells;
  for (std::string cell; cells.size() < 10 && std::getline(line, cell, ',');) cells.push_back(cell);
  EXPECT_EQ(cells[1] + cells[2] + cells[3] + cells[4], "dyn/cm2lumpedaxisym18");
  EXPECT_NEAR(std::stod(cells[5]), highest - lowest, 1e-9 * highest);
  EXPECT_NEAR(std::stod(cells[6]), sum / 18, 1e-9 * highest);

  // The mean of the 2D tier is known better than 18 points tell.
  const Json surrogate = campaign("both").at("surrogates").at(0);
  EXPECT_EQ(surrogate.at("quantity"), "pressure.max");
  EXPECT_EQ(surrogate.at("tiers"), "all");
  EXPECT_GT(surrogate.at("q2"), 0.99);
  EXPECT_GT(indices("both").at("pressure.max,outlet.resistance")[1], 0.9);
  EXPECT_NE(read_text(path("both/report.html")).find("Where tiers differ"), std::string::npos);
}

// Surrogates of all quantities of 200 points take some ten seconds; nobody waits for those.
TEST_F(SweepSurrogates, AreLeftWhenInterrupted) {
  Texts all{TUNICA_PROGRAM, "sweep", std::string(TUNICA_SOURCE_DIR) + "/scenes/cylinder.toml", "--quiet"};
  all.insert(all.end(), varied.begin(), varied.end());
  all.insert(all.end(), {"--tier", "lumped", "--sample", "sobol:200", "--indices", "--surrogate", "--out",
                         path("stopped")});
  test_support::Program program(all, folder_.path());
  for (int k = 0; k < 60'000 && !std::filesystem::exists(path("stopped/sweep.csv")); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  program.send(SIGINT);
  EXPECT_EQ(program.wait(), 130);
  EXPECT_NE(program.errors().find("200 of 200 points"), std::string::npos) << program.errors();
  EXPECT_NE(program.errors().find("--resume goes on"), std::string::npos) << program.errors();
  EXPECT_FALSE(std::filesystem::exists(path("stopped/indices.csv")));
}

TEST_F(SweepSurrogates, RefuseWhatMakesNoSense) {
  write_whole(path("outside.csv"), "outlet.resistance,tether.stiffness\n1e6,1e7\n3e6,1e7\n");
  write_whole(path("other.csv"), "outlet.resistance,wall.activation_stretch\n1e6,1.5\n");
  write_whole(path("words.csv"), "outlet.resistance,tether.stiffness,wall.law\n1e6,1e7,EXP1\n");
  for (const auto& [more, why] : std::vector<std::pair<Texts, std::string>>{
           {{"--sample", "sobol:8", "--indices", "--surrogate"}, "needs 16 points"},
           // Of a dear tier without being asked.
           {{"--tier", "axisym", "--sample", "sobol:8", "--indices"}, "needs 16 points"},
           {{"--sample", "sobol:32", "--surrogate"}, "--indices"},
           {{"--points", path("outside.csv"), "--indices"},
            "outlet.resistance = 3000000 of point 1 is outside"},
           {{"--points", path("other.csv"), "--indices"}, "wall.activation_stretch varies"},
           {{"--points", path("outside.csv"), "--indices", "--no-surrogate"}, "--no-surrogate"},
           {{"--sample", "sobol:99", "--fidelities", "lumped"}, "two tiers or more"},
           {{"--sample", "sobol:99", "--fidelities", "lumped,axisim"}, "axisym"},
           {{"--sample", "sobol:99", "--fidelities", "lumped,lumped"}, "lumped is there twice"},
           {{"--sample", "sobol:99", "--fidelities", "axisym,lumped"}, "from cheap to dear"},
           {{"--points", path("words.csv"), "--indices"}, "wall.law holds words"},
           {{"--sample", "sobol:99", "--fidelities", "lumped,axisym:100"}, "there are 99 points"},
           {{"--sample", "sobol:99", "--fidelities", "lumped,axisym:3"}, "take 16 or more"},
           {{"--sample", "sobol:99", "--fidelities", "lumped,axisym:x"}, "TIER:N"},
           {{"--sample", "sobol:99", "--fidelities", "lumped,axisym", "--tier", "axisym"},
            "leave out --tier"},
           {{"--sample", "sobol:99", "--fidelities", "lumped,axisym", "--indices", "--until", "0.1"},
            "which tier's points"}}) {
    const Ended refused = varied_sweep("refused", more);
    EXPECT_EQ(refused.code, 2) << refused.errors;
    EXPECT_NE(refused.errors.find(why), std::string::npos) << refused.errors;
    EXPECT_FALSE(std::filesystem::exists(path("refused"))) << why;
  }
  const Ended no_law = sweep("refused", {"--points", path("outside.csv"), "--indices"});
  EXPECT_EQ(no_law.code, 2);
  EXPECT_TRUE(is_one_line(no_law.errors)) << no_law.errors;
}
