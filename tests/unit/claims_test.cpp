// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/claims.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/support/synthetic.hpp"

using namespace tunica;
using namespace tunica::verification;
using test_support::synthetic_run;

namespace {

std::vector<StoredResult> four_laws(const std::string& tether = "normal") {
  return {synthetic_run({.law = "EXP1", .tether = tether, .displacement_scale = 0.0200}),
          synthetic_run({.law = "EXP2", .tether = tether, .displacement_scale = 0.0212}),
          synthetic_run({.law = "EXP1+EXP2-ZS", .tether = tether}),
          synthetic_run({.law = "EXP1+EXP2-FS", .tether = tether})};
}

ClaimRow row_of(const Comparison& comparison, const std::string& id) {
  for (const ClaimRow& row : comparison.rows)
    if (row.id == id) return row;
  ADD_FAILURE() << "no claim " << id;
  return {};
}

Verdict verdict_of(const std::vector<StoredResult>& runs, const std::string& id) {
  return row_of(compare_with_paper(runs), id).verdict;
}

/// A made-up run of the paper's bent artery, whose sides move apart by a share of the displacement.
StoredResult torus(const std::string& law, double scale, double apart = 0) {
  StoredResult run = synthetic_run({.law = law, .displacement_scale = scale});
  run.record["tier"] = "full3d";
  run.record["scene"]["geometry.kind"] = "torus";
  run.record["scene"]["geometry.bend_angle"] = 120.0;
  run.record["scene"]["mesh.symmetry"] = "full";
  run.record["scene_set"] = {"wall.law", "geometry.kind", "geometry.bend_angle", "mesh.symmetry"};
  auto& table = run.result.observables;
  const std::vector<double> outside = table.find("radial_displacement.P1")->values;
  for (const auto& [name, factor] :
       {std::pair{"radial_displacement.P1.90deg", 1.0}, {"radial_displacement.P1.270deg", 1 - apart}}) {
    auto& values = table[table.add(name, "cm")].values;
    for (const double value : outside) values.push_back(factor * value);
  }
  return run;
}

void set_column(StoredResult& run, const std::string& name, double factor) {
  const auto& columns = run.result.observables.columns();
  for (std::size_t index = 0; index < columns.size(); ++index)
    if (columns[index].name == name)
      for (double& value : run.result.observables[index].values) value *= factor;
}

}  // namespace

TEST(Claims, EveryClaimHasOneRowForOneReading) {
  const Comparison comparison = compare_with_paper(four_laws());
  std::set<std::string> ids;
  for (const ClaimRow& row : comparison.rows) EXPECT_TRUE(ids.insert(row.id).second) << row.id;
  EXPECT_EQ(ids.size(), 32u);
  EXPECT_TRUE(comparison.left_out.empty());
  for (const ClaimRow& row : comparison.rows)
    EXPECT_NE(row.verdict, Verdict::not_answered_by_results) << row.id;
}

TEST(Claims, OnlyWhatTheTierCannotTellIsLeftOpen) {
  std::set<std::string> open;
  for (const ClaimRow& row : compare_with_paper(four_laws()).rows)
    if (row.verdict == Verdict::not_answered_by_tier) open.insert(row.id);
  EXPECT_EQ(open, (std::set<std::string>{"radial_dominates", "no_wave", "parabolic", "dofs_cylinder",
                                         "dofs_torus", "torus_exp2_sym", "torus_zs_asym", "torus_zs_smaller",
                                         "torus_fs_not_run"}));
}

TEST(Claims, NumbersOfMadeUpRunsAreThoseTheyWereMadeWith) {
  const Comparison comparison = compare_with_paper(four_laws());
  EXPECT_EQ(row_of(comparison, "p_min").ours,
            "EXP1\u00a075.0, EXP2\u00a075.0, ZS\u00a075.0, FS\u00a075.0 mmHg");
  EXPECT_EQ(row_of(comparison, "p_min").paper, "75 mmHg");
  EXPECT_EQ(row_of(comparison, "p_min").tolerance, "± 5 mmHg");
  EXPECT_EQ(row_of(comparison, "t_systole").ours,
            "EXP1\u00a00.2112, EXP2\u00a00.2112, ZS\u00a00.2112, FS\u00a00.2112 s");
  EXPECT_EQ(row_of(comparison, "exp2_over_exp1").ours, "1.060 (1.060 to 1.060 through the beat)");
  // (0.6 + 0.4) - 0.6 of 0.020 cm over 0.033 cm.
  EXPECT_NE(row_of(comparison, "du_over_R0").ours.find("EXP1\u00a00.242"), std::string::npos);
  EXPECT_NE(row_of(comparison, "du_over_R0").note.find("EXP1\u00a00.606"), std::string::npos);
  EXPECT_EQ(row_of(comparison, "fs_angle_ref").ours, "42.82 deg");
  // acos(2 * 0.9 - 1)/pi of the beat.
  EXPECT_EQ(row_of(comparison, "fs_P4").ours, "P4 20.5 % of the beat");
  EXPECT_EQ(row_of(comparison, "fs_P4").reading,
            "lumped, tether\u00a0normal, a²\u00a0=\u00a01.6740, exponent\u00a02");
  EXPECT_EQ(row_of(comparison, "zs_angle_hb").reading, "lumped, tether\u00a0normal, exponent\u00a02");
  EXPECT_EQ(row_of(comparison, "exp2_over_exp1").reading, "lumped, tether\u00a0normal");
}

TEST(Claims, ANumberOutsideTheToleranceDisagrees) {
  std::vector<StoredResult> runs = four_laws();
  EXPECT_EQ(verdict_of(runs, "p_max"), Verdict::agrees);
  EXPECT_EQ(verdict_of(runs, "p_same_for_laws"), Verdict::qualitative_agreement);
  EXPECT_EQ(verdict_of(runs, "transmural_range"), Verdict::agrees);
  // One law of four is enough.
  set_column(runs[2], "pressure", 1.05);
  set_column(runs[2], "transmural_pressure", 1.1);
  EXPECT_EQ(verdict_of(runs, "p_max"), Verdict::disagrees);
  EXPECT_EQ(verdict_of(runs, "p_same_for_laws"), Verdict::disagrees);
  EXPECT_EQ(verdict_of(runs, "transmural_range"), Verdict::disagrees);
}

TEST(Claims, AnglesAgreeWhenThePaperLiesWithinTheWall) {
  std::vector<StoredResult> runs = four_laws();
  const Comparison comparison = compare_with_paper(runs);
  EXPECT_EQ(row_of(comparison, "fs_angle_hb").verdict, Verdict::agrees);
  EXPECT_EQ(row_of(comparison, "zs_angle_hb").verdict, Verdict::disagrees);
  for (const char* point : {"P1", "P2", "P3", "P4"})
    set_column(runs[3], std::string("fiber_angle.") + point, 1.1);
  EXPECT_EQ(verdict_of(runs, "fs_angle_hb"), Verdict::disagrees);
}

TEST(Claims, StatementsAreTestedByTheirCriterion) {
  std::vector<StoredResult> runs = four_laws();
  EXPECT_EQ(verdict_of(runs, "fs_P1"), Verdict::qualitative_agreement);
  EXPECT_EQ(verdict_of(runs, "fs_P23"), Verdict::qualitative_agreement);
  EXPECT_EQ(verdict_of(runs, "fs_P4"), Verdict::qualitative_agreement);
  EXPECT_EQ(verdict_of(runs, "zs_always"), Verdict::disagrees);
  EXPECT_EQ(verdict_of(runs, "displacement_decreases"), Verdict::qualitative_agreement);
  EXPECT_EQ(verdict_of(runs, "fiber_stretch_inner"), Verdict::qualitative_agreement);
  set_column(runs[3], "radial_displacement.P3", 1.2);
  EXPECT_EQ(verdict_of(runs, "displacement_decreases"), Verdict::disagrees);
  set_column(runs[3], "fiber_stretch.P4", 2);
  EXPECT_EQ(verdict_of(runs, "fiber_stretch_inner"), Verdict::disagrees);

  EXPECT_EQ(verdict_of(runs, "vm_fs_lowest"), Verdict::disagrees);  // as low as ZS, not lower
  for (const auto& [point, factor] :
       std::map<std::string, double>{{"P1", 0.99}, {"P2", 0.9}, {"P3", 0.8}, {"P4", 0.7}})
    set_column(runs[3], "von_mises." + point, factor);
  EXPECT_EQ(verdict_of(runs, "vm_fs_lowest"), Verdict::qualitative_agreement);
  set_column(runs[3], "von_mises.P4", 1.2);
  EXPECT_EQ(verdict_of(runs, "vm_fs_lowest"), Verdict::disagrees);
}

TEST(Claims, EachReadingHasItsRows) {
  std::vector<StoredResult> runs = four_laws();
  for (StoredResult& run : four_laws("reference")) runs.push_back(std::move(run));
  StoredResult other = synthetic_run({.law = "EXP1+EXP2-FS"});
  other.record["scene"]["wall.activation_squared"] = 1.52;
  runs.push_back(other);
  const Comparison comparison = compare_with_paper(runs);
  std::multiset<std::string> readings;
  for (const ClaimRow& row : comparison.rows)
    if (row.id == "fs_P1") readings.insert(row.reading);
  EXPECT_EQ(readings, (std::multiset<std::string>{
                          "lumped, tether\u00a0normal, a²\u00a0=\u00a01.5200, exponent\u00a02",
                          "lumped, tether\u00a0normal, a²\u00a0=\u00a01.6740, exponent\u00a02",
                          "lumped, tether\u00a0reference, a²\u00a0=\u00a01.6740, exponent\u00a02"}));
  // What knows no fibres is not said twice.
  EXPECT_EQ(std::count_if(comparison.rows.begin(), comparison.rows.end(),
                          [](const ClaimRow& row) { return row.id == "exp2_over_exp1"; }),
            2);
}

TEST(Claims, WithoutTheLawsAClaimStaysOpen) {
  const Comparison comparison = compare_with_paper({synthetic_run({.law = "EXP1"})});
  for (const char* id : {"exp2_over_exp1", "fs_P1", "zs_angle_hb", "vm_fs_lowest", "p_same_for_laws"}) {
    EXPECT_EQ(row_of(comparison, id).verdict, Verdict::not_answered_by_results) << id;
    EXPECT_NE(row_of(comparison, id).note.find("needs"), std::string::npos) << id;
  }
  EXPECT_EQ(row_of(comparison, "p_min").verdict, Verdict::agrees);
}

TEST(Claims, ColumnsThatATierLacksLeaveAClaimOpen) {
  std::vector<StoredResult> runs = four_laws();
  for (StoredResult& run : runs) {
    for (const char* name : {"pressure", "transmural_pressure", "inflow"})
      set_column(run, name, observables::none);
    run.result.profiles = {};
  }
  const Comparison comparison = compare_with_paper(runs);
  for (const char* id : {"p_min", "transmural_range", "t_systole", "j_margin"})
    EXPECT_EQ(row_of(comparison, id).verdict, Verdict::not_answered_by_results) << id;
}

TEST(Claims, OtherScenesAreLeftOutWithTheReason) {
  std::vector<StoredResult> runs;
  const auto add = [&](auto change) {
    runs.push_back(synthetic_run({.law = "EXP1"}));
    change(runs.back());
  };
  add([](StoredResult& run) {
    run.record["scene"]["outlet.resistance"] = 5e5;
    run.record["scene_set"].push_back("outlet.resistance");
  });
  add([](StoredResult& run) { run.record["scene"]["wall.law"] = "neo-Hookean"; });
  add([](StoredResult& run) {
    run.record["scene"]["wall.stiffness"] = 8e4;
    run.record["scene_set"].push_back("wall.stiffness");
  });
  add([](StoredResult& run) {
    run.record["interrupted"] = true;
    for (std::size_t column = 0; column < run.result.observables.columns().size(); ++column)
      run.result.observables[column].values.resize(100);
  });
  const Comparison none = compare_with_paper(runs);
  EXPECT_TRUE(none.rows.empty());
  ASSERT_EQ(none.left_out.size(), 4u);
  EXPECT_NE(none.left_out[0].find("outlet.resistance = 500000.0 (paper: 1032000.0)"), std::string::npos);
  EXPECT_NE(none.left_out[1].find("not one of the paper's laws"), std::string::npos);
  EXPECT_NE(none.left_out[2].find("wall.stiffness = 80000.0 (paper: 76350.0)"), std::string::npos);
  EXPECT_NE(none.left_out[3].find("ended before its first beat was over"), std::string::npos);
}

TEST(Claims, ATorusIsHeldAgainstThePapersNumbersForIt) {
  std::vector<StoredResult> runs{torus("EXP2", 0.0212), torus("EXP1+EXP2-ZS", 0.0190)};
  const Comparison comparison = compare_with_paper(runs);
  EXPECT_TRUE(comparison.left_out.empty());
  std::set<std::string> ids;
  for (const ClaimRow& row : comparison.rows) ids.insert(row.id);
  EXPECT_EQ(ids, (std::set<std::string>{"p_min", "p_max", "dofs_torus", "torus_exp2_sym", "torus_zs_asym",
                                        "torus_zs_smaller", "torus_fs_not_run"}));
  EXPECT_EQ(row_of(comparison, "p_min").ours, "EXP2\u00a075.0, ZS\u00a075.0 mmHg");
  EXPECT_EQ(row_of(comparison, "p_max").ours, "EXP2\u00a0130.0, ZS\u00a0130.0 mmHg");
  EXPECT_EQ(row_of(comparison, "p_max").reading, "full3d, torus, tether\u00a0normal, exponent\u00a02");
  for (const char* id : {"p_min", "p_max"}) EXPECT_EQ(row_of(comparison, id).verdict, Verdict::agrees) << id;
  for (const char* id : {"torus_exp2_sym", "torus_zs_smaller"})
    EXPECT_EQ(row_of(comparison, id).verdict, Verdict::qualitative_agreement) << id;
  // 0.0190 of 0.0212 cm.
  EXPECT_NE(row_of(comparison, "torus_zs_smaller").ours.find("0.896 (0.896 to 0.896"), std::string::npos);
  EXPECT_EQ(row_of(comparison, "torus_zs_asym").verdict, Verdict::not_answered_by_results);

  set_column(runs[1], "pressure", 1.05);
  EXPECT_EQ(verdict_of(runs, "p_max"), Verdict::disagrees);
  runs = {torus("EXP2", 0.0190, 0.02), torus("EXP1+EXP2-ZS", 0.0212)};
  EXPECT_EQ(row_of(compare_with_paper(runs), "torus_exp2_sym").ours,
            "sides differ by 2.00 % of the displacement");
  EXPECT_EQ(verdict_of(runs, "torus_exp2_sym"), Verdict::disagrees);
  EXPECT_EQ(verdict_of(runs, "torus_zs_smaller"), Verdict::disagrees);
}

TEST(Claims, ADisagreementOfAFirstBeatFromRestIsToldAsSuch) {
  std::vector<StoredResult> runs{synthetic_run({.law = "EXP1", .beats = 1})};
  runs[0].record["scene"]["time.start"] = "rest";
  const ClaimRow row = row_of(compare_with_paper(runs), "p_min");
  EXPECT_EQ(row.verdict, Verdict::disagrees);
  EXPECT_EQ(row.note, "this beat begins at rest, the paper's does not");
  runs = {synthetic_run({.law = "EXP1", .beats = 2, .lowest_pressure = 50})};
  runs[0].record["scene"]["time.start"] = "rest";
  EXPECT_EQ(row_of(compare_with_paper(runs), "p_min").note, "");
}

TEST(Claims, ArteriesAreNotMixed) {
  std::vector<StoredResult> runs{torus("EXP2", 0.0212),
                                 synthetic_run({.law = "EXP2", .highest_pressure = 140})};
  const Comparison comparison = compare_with_paper(runs);
  std::map<std::string, std::string> ours;
  for (const ClaimRow& row : comparison.rows)
    if (row.id == "p_max") ours[row.reading] = row.ours;
  EXPECT_EQ(ours,
            (std::map<std::string, std::string>{{"full3d, torus, tether\u00a0normal", "EXP2\u00a0130.0 mmHg"},
                                                {"lumped, tether\u00a0normal", "EXP2\u00a0140.0 mmHg"}}));
  // For a straight artery in 3D, the tier is not what is missing.
  runs = {synthetic_run({.law = "EXP2"})};
  runs[0].record["tier"] = "full3d";
  EXPECT_EQ(verdict_of(runs, "torus_exp2_sym"), Verdict::not_answered_by_results);
  // A torus of another section is none of the paper's.
  runs = {torus("EXP2", 0.0212)};
  runs[0].record["scene"]["geometry.radius"] = 0.2;
  runs[0].record["scene_set"].push_back("geometry.radius");
  const Comparison other = compare_with_paper(runs, {"the bend"});
  EXPECT_TRUE(other.rows.empty());
  ASSERT_EQ(other.left_out.size(), 1u);
  EXPECT_EQ(other.left_out[0],
            "the bend: not one of the paper's arteries: geometry.radius = 0.2 (paper: 0.033)");
}

TEST(Claims, WhatDoesNotChangeThePhysicsIsNoDifference) {
  StoredResult run = synthetic_run({.law = "EXP1"});
  for (const char* key :
       {"accuracy.tolerance", "output.interval", "time.beats", "geometry.radius", "wall.law"})
    run.record["scene_set"].push_back(key);
  run.record["scene"]["accuracy.tolerance"] = 1e-6;
  EXPECT_TRUE(differences_from_paper(run).empty());
}

TEST(Claims, ASecondRunOfALawAndReadingIsToldNotMixedIn) {
  std::vector<StoredResult> runs = four_laws();
  runs.push_back(synthetic_run({.law = "EXP1", .highest_pressure = 170}));
  const Comparison comparison = compare_with_paper(runs);
  EXPECT_EQ(row_of(comparison, "p_max").verdict, Verdict::agrees);
  ASSERT_EQ(comparison.left_out.size(), 1u);
  EXPECT_NE(comparison.left_out[0].find("another run of this law and reading"), std::string::npos);
}

TEST(Claims, MarkdownKeepsTextInItsCells) {
  Comparison comparison;
  ClaimRow row;
  row.id = "one";
  row.quantity = "a|b <i>";
  comparison.rows.push_back(row);
  const std::string text = to_markdown(comparison);
  EXPECT_NE(text.find("| a\\|b &lt;i><br>"), std::string::npos) << text;
}
