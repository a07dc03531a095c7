// SPDX-License-Identifier: GPL-3.0-or-later
// Whole verifications: with tiers whose differences are known by construction, and with the 0D tier against
// itself.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "core/observables/record.hpp"
#include "lumped/lumped_tier.hpp"
#include "tests/support/fake_tier.hpp"
#include "tests/support/made_scene.hpp"
#include "tests/support/synthetic.hpp"
#include "tests/support/temporary_folder.hpp"
#include "verification/cross_tier.hpp"

using namespace tunica;
using namespace tunica::verification;
using test_support::door_of_made_scene;
using test_support::FakeTier;
using test_support::synthetic_run;
using test_support::TemporaryFolder;

namespace {

/// Curves of 55 mmHg range whose pressure is higher by so many parts of that range.
Result higher_by(double share, const std::string& law = "EXP1+EXP2-FS") {
  Result result =
      synthetic_run({.law = law, .lowest_pressure = 75 + 55 * share, .highest_pressure = 130 + 55 * share})
          .result;
  result.record.converged = true;
  return result;
}

/// A tier that lacks three things: one it can be given, one that the tier above can be relieved of, and a
/// remainder.
struct Made {
  double loss = 0.03, inertia = 0.02, ends = 0.04, remainder = 0.002;

  FakeTier low() const {
    return {"low", [*this](const Scene& scene, const RunControl&) {
              return higher_by((scene.integer("lumped.compartments") > 1 ? loss : 0) +
                                   (scene.flag("lumped.inertance") ? inertia : 0) + remainder,
                               scene.text("wall.law"));
            }};
  }
  FakeTier high() const {
    return {"high", [*this](const Scene& scene, const RunControl&) {
              return higher_by(loss + inertia + (scene.number("wall.density") == 2 ? 0 : ends),
                               scene.text("wall.law"));
            }};
  }
};

Rung chain() {
  return {"chain", {"lumped.compartments=5"}, "loss", [](const Scene& scene) {
            return scene.integer("lumped.compartments") > 1;
          }};
}
const Rung inertance{"inertance", {"lumped.inertance=true"}, "inertia"};
const Rung free_ends{"ends", {"wall.density=2"}, "ends"};

std::vector<Ladder> ladder(std::vector<Rung> added = {chain(), inertance},
                           std::vector<Rung> removed = {free_ends}) {
  return {{"low", "high", std::move(added), std::move(removed)}};
}

const QuantityRow& row(const TierComparison& comparison, const std::string& label) {
  for (const QuantityRow& one : comparison.rows)
    if (one.quantity.label == label) return one;
  throw std::runtime_error("no row " + label);
}

CrossTier verify_made(const Made& made, const std::vector<Ladder>& between = ladder(),
                      const run::Door& door = door_of_made_scene()) {
  const TemporaryFolder folder;
  const FakeTier low = made.low(), high = made.high();
  return verify(door, {&low, &high}, folder.path(), {}, between);
}

/// The range is that of rows, which miss the peak by 0.2 ms: (pi/T 0.2 ms)^2 of it.
constexpr double exact = 6.2e-7;

std::size_t columns(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char byte) { return (byte & 0xC0) != 0x80; }));
}

}  // namespace

TEST(CrossTier, MeasuresEveryEffectByTheRunThatRemovesIt) {
  const CrossTier found = verify_made({});
  ASSERT_EQ(found.comparisons.size(), 1U);
  const TierComparison& comparison = found.comparisons.front();
  const QuantityRow& pressure = row(comparison, "pressure");
  ASSERT_EQ(comparison.links.size(), 4U);
  const std::vector<std::string> effects{"loss", "inertia", "", "ends"};
  const std::vector<double> sizes{0.03, 0.02, 0.002, 0.04};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(comparison.links[k].effect, effects[k]);
    EXPECT_NEAR(pressure.effects[k].largest, sizes[k], exact) << effects[k];
  }
  EXPECT_NEAR(pressure.raw.largest, 0.03 + 0.02 - 0.002 + 0.04, exact);
  EXPECT_NEAR(pressure.remainder.largest, 0.002, exact);
  EXPECT_EQ(pressure.verdict, Agreement::explained);
  EXPECT_EQ(row(comparison, "displacement P1").verdict, Agreement::agrees);
  EXPECT_EQ(row(comparison, "displacement P1").raw.largest, 0);
  EXPECT_EQ(comparison.verdict(), Agreement::explained);
  EXPECT_TRUE(comparison.left_out.empty());
  // The differences along the way add up to the whole.
  double sum = 0;
  for (const Link& link : comparison.links)
    sum +=
        difference_at("pressure", found.runs[link.from].beat_run(), found.runs[link.to].beat_run(), {0.3})[0];
  const double whole = difference_at("pressure", found.runs[comparison.run].beat_run(),
                                     found.runs[comparison.reference].beat_run(), {0.3})[0];
  EXPECT_NEAR(sum, whole, 1e-9 * std::abs(whole));
}

TEST(CrossTier, WhatNoRunExplainsIsADisagreement) {
  const CrossTier found = verify_made({.remainder = 0.02});
  EXPECT_EQ(row(found.comparisons.front(), "pressure").verdict, Agreement::disagrees);
  EXPECT_EQ(found.comparisons.front().verdict(), Agreement::disagrees);
  // The same numbers without a ladder: nothing is explained.
  const CrossTier bare = verify_made({.remainder = 0.002}, {});
  ASSERT_EQ(bare.comparisons.front().links.size(), 1U);
  EXPECT_EQ(row(bare.comparisons.front(), "pressure").verdict, Agreement::disagrees);
  EXPECT_EQ(bare.runs.size(), 2U);
}

TEST(CrossTier, EffectsThatCancelAreTold) {
  const CrossTier found = verify_made({.loss = 0.05, .inertia = 0, .ends = -0.02, .remainder = 0.03});
  const QuantityRow& pressure = row(found.comparisons.front(), "pressure");
  EXPECT_NEAR(pressure.raw.largest, 0, exact);
  EXPECT_NEAR(pressure.remainder.largest, 0.03, exact);
  EXPECT_EQ(pressure.verdict, Agreement::agrees);
  EXPECT_NE(pressure.note.find("cancel"), std::string::npos);
}

TEST(CrossTier, TheLimitFollowsTheScenesTolerance) {
  EXPECT_EQ(row(verify_made({}, ladder(), door_of_made_scene({"accuracy.tolerance=0.1"})).comparisons.front(),
                "pressure")
                .verdict,
            Agreement::agrees);
  EXPECT_EQ(
      row(verify_made({}, ladder(), door_of_made_scene({"accuracy.tolerance=0.001"})).comparisons.front(),
          "pressure")
          .verdict,
      Agreement::disagrees);
}

TEST(CrossTier, ARungThatASceneCannotTakeIsLeftOutAndTold) {
  const Rung no_key{"odd", {"lumped.no_such_key=1"}, "nothing"};
  const Rung no_change{"same", {"lumped.inertance=false"}, "nothing"};
  const CrossTier found = verify_made({}, ladder({no_key, no_change, chain(), inertance}),
                                      door_of_made_scene({"lumped.compartments=7"}));
  const TierComparison& comparison = found.comparisons.front();
  ASSERT_EQ(comparison.left_out.size(), 3U);
  EXPECT_NE(comparison.left_out[0].find("lumped.no_such_key"), std::string::npos) << comparison.left_out[0];
  EXPECT_NE(comparison.left_out[1].find("no change"), std::string::npos) << comparison.left_out[1];
  EXPECT_NE(comparison.left_out[2].find("lumped.compartments=5: no change"), std::string::npos)
      << comparison.left_out[2];
  ASSERT_EQ(comparison.links.size(), 3U);
  EXPECT_EQ(comparison.links[0].effect, "inertia");
  EXPECT_NE(to_text(found).find("Left out: low, lumped.no_such_key=1"), std::string::npos);
}

TEST(CrossTier, ARungThatGivesUpOrIsRefusedIsLeftOut) {
  const Made made;
  const FakeTier low{"low",
                     [&](const Scene& scene, const RunControl& control) {
                       Result result = made.low().prepare(scene)->execute(control);
                       if (scene.integer("lumped.compartments") == 5) result.record.failure = "for the test";
                       return result;
                     },
                     [](const Scene& scene) {
                       return std::string(scene.flag("lumped.inertance") ? "no inertance here" : "");
                     }};
  const FakeTier high = made.high();
  const TemporaryFolder folder;
  const CrossTier found = verify(door_of_made_scene(), {&low, &high}, folder.path(), {}, ladder());
  const TierComparison& comparison = found.comparisons.front();
  ASSERT_EQ(comparison.left_out.size(), 2U);
  EXPECT_NE(comparison.left_out[0].find("gave up for the test"), std::string::npos);
  EXPECT_NE(comparison.left_out[1].find("no inertance here"), std::string::npos);
  EXPECT_EQ(comparison.links.size(), 2U);
  // What the rung would have told may be all that is left.
  EXPECT_EQ(row(comparison, "pressure").verdict, Agreement::unexplained);
  EXPECT_EQ(comparison.verdict(), Agreement::unexplained);
  EXPECT_NE(to_text(found).find("low against high not explained: a rung gave up"), std::string::npos)
      << to_text(found);
  EXPECT_EQ(found.failure(), "");
}

TEST(CrossTier, ARungThatIsRefusedExplainsNothing) {
  const Made made;
  const FakeTier low{"low",
                     [&](const Scene& scene, const RunControl& control) {
                       return made.low().prepare(scene)->execute(control);
                     },
                     [](const Scene& scene) {
                       return std::string(scene.integer("lumped.compartments") == 5 ? "one alone here" : "");
                     }};
  const FakeTier high = made.high();
  const TemporaryFolder folder;
  const CrossTier found = verify(door_of_made_scene(), {&low, &high}, folder.path(), {}, ladder());
  EXPECT_EQ(found.comparisons.front().verdict(), Agreement::disagrees);
}

TEST(CrossTier, ATierThatGivesUpIsNamedAndTheOthersAreCompared) {
  const Made made;
  const FakeTier low = made.low(), high = made.high();
  const FakeTier broken{"broken", [](const Scene&, const RunControl&) {
                          Result result;
                          result.observables = observables::standard_table();
                          result.record.failure = "at t = 0 s: for the test";
                          return result;
                        }};
  const TemporaryFolder folder;
  const CrossTier found = verify(door_of_made_scene(), {&low, &broken, &high}, folder.path(), {}, ladder());
  EXPECT_EQ(found.failure(), "broken: the solver gave up at t = 0 s: for the test");
  ASSERT_EQ(found.comparisons.size(), 1U);
  EXPECT_EQ(found.runs[found.comparisons[0].run].tier, "low");
  EXPECT_EQ(found.tier_results().size(), 2U);
  EXPECT_TRUE(verify(door_of_made_scene(), {&low, &broken}, folder.path(), {}, ladder()).comparisons.empty());
}

TEST(CrossTier, AnInterruptEndsItAll) {
  int begun = 0;
  const FakeTier low{"low", [&](const Scene&, const RunControl& control) {
                       Result result = higher_by(0);
                       if (control.interrupted()) result.record.interrupted = true;
                       return result;
                     }};
  const FakeTier high = Made{}.high();
  const TemporaryFolder folder;
  VerifyControl control;
  control.begin = [&](const std::string&) { ++begun; };
  control.interrupted = [] { return true; };
  const CrossTier found = verify(door_of_made_scene(), {&low, &high}, folder.path(), control, ladder());
  EXPECT_TRUE(found.interrupted);
  EXPECT_EQ(begun, 1);
  EXPECT_TRUE(found.comparisons.empty());
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "low/record.json"));
}

TEST(CrossTier, WarningsAndFindingsAreToldOnceEach) {
  FakeTier low = Made().low();
  low.warnings = {"it ripples", "a key is not used"};
  const FakeTier high{"high", [](const Scene&, const RunControl&) {
                        Result result = higher_by(0);
                        result.record.findings = {"steps were divided", "it ripples"};
                        return result;
                      }};
  const TemporaryFolder folder;
  VerifyControl control;
  std::vector<std::string> told;
  control.warn = [&](const std::string& line) { told.push_back(line); };
  verify(door_of_made_scene(), {&low, &high}, folder.path(), control, ladder());
  EXPECT_EQ(told, (std::vector<std::string>{"it ripples", "a key is not used", "steps were divided"}));
}

TEST(CrossTier, ATierThatRefusesTheSceneIsToldBeforeAnythingIsComputed) {
  const FakeTier low = Made{}.low();
  const FakeTier high{"high", [](const Scene&, const RunControl&) { return higher_by(0); },
                      [](const Scene&) { return std::string("not this one"); }};
  const TemporaryFolder folder;
  EXPECT_THROW(verify(door_of_made_scene(), {&low, &high}, folder.path(), {}, ladder()), InvalidInput);
  EXPECT_EQ(test_support::count_entries(folder.path()), 0U);
}

TEST(CrossTier, TextIsNarrowAndJsonComplete) {
  for (const char* law : {"EXP1", "EXP1+EXP2-FS"}) {
    const CrossTier found = verify_made({}, ladder(), door_of_made_scene({std::string("wall.law=") + law}));
    // The verdict stands first, before rows that push it out of sight.
    const std::string verdict = found.scene + ": low against high differs by the model (explained): ";
    EXPECT_EQ(to_text(found).find(verdict.substr(0, verdict.size() - 2)), 0U) << to_text(found);
    std::istringstream text(to_text(found));
    for (std::string line; std::getline(text, line);) EXPECT_LE(columns(line), 80U) << line;
    const auto json = to_json(found);
    EXPECT_EQ(json.at("comparisons").at(0).at("verdict"), "differs by the model (explained)");
    EXPECT_EQ(json.at("runs").size(), 5U);
    EXPECT_EQ(json.at("comparisons").at(0).at("links").size(), 4U);
    const bool has_fibers = std::string(law) == "EXP1+EXP2-FS";
    EXPECT_EQ(json.at("comparisons").at(0).at("quantities").size(), has_fibers ? 28U : 16U);
    EXPECT_EQ(json.at("runs").at(0).contains("recruited[s]"), has_fibers);
    EXPECT_GT(json.at("claims").size(), 0U);
    for (const auto& claim : json.at("claims"))
      EXPECT_TRUE(claim.at("law") == "all" || claim.at("law") == law) << claim;
  }
}

/// The 0D tier as it is, against itself with the loss and the inertia of the blood along the artery as a tier
/// of its own: the ladder has to find that nothing else is between them.
TEST(CrossTier, TheLumpedTierWithItsOptionsIsExplainedWithoutRemainder) {
  const lumped::LumpedTier plain;
  const FakeTier with_options{"axisym", [&](const Scene& scene, const RunControl& control) {
                                const Scene full =
                                    parse_scene(describe(scene), "full", ".",
                                                {"lumped.compartments=21", "lumped.inertance=true"});
                                return plain.prepare(full)->execute(control);
                              }};
  const TemporaryFolder folder;
  const CrossTier found = verify(door_of_made_scene(), {&plain, &with_options}, folder.path());
  EXPECT_EQ(found.failure(), "");
  const TierComparison& comparison = found.comparisons.front();
  // Rungs of the axisymmetric tier: this one heeds neither.
  ASSERT_EQ(comparison.links.size(), 5U);
  EXPECT_NE(comparison.verdict(), Agreement::disagrees);
  for (const QuantityRow& one : comparison.rows) {
    for (std::size_t link = 2; link < 5; ++link)
      EXPECT_EQ(one.effects[link].largest, 0) << one.quantity.label;
    EXPECT_EQ(one.remainder.largest, 0) << one.quantity.label;
    // Triangle inequality of the norms.
    EXPECT_LE(one.raw.largest, one.effects[0].largest + one.effects[1].largest + 1e-9) << one.quantity.label;
  }
  // A single compartment has the Poiseuille loss of half the artery, 4 mu L/(pi r^4) Q = 0.5 mmHg, at its
  // outlet. That it is spread along the artery matters less than the loss itself, of 58 mmHg range.
  const QuantityRow& pressure = row(comparison, "pressure");
  EXPECT_GT(pressure.effects[0].largest, 0);
  EXPECT_LT(pressure.effects[0].largest, 0.6 / 58);
  for (const char* id : {"lumped", "axisym", "lumped-compartments", "lumped-inertance"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / id / "observables.csv")) << id;
}
