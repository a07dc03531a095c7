// SPDX-License-Identifier: GPL-3.0-or-later
// The short way to quantities: the same as from whole runs, within the tolerance, and each by itself.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/run/quantity.hpp"
#include "core/threads.hpp"
#include "lumped/lumped_tier.hpp"
#include "tests/support/lumped_runs.hpp"

using namespace tunica;
using test_support::joined;
using test_support::scene_with;
using Texts = std::vector<std::string>;

namespace {

run::Answer short_answer(const Texts& overrides, const std::vector<run::Quantity>& quantities) {
  return lumped::LumpedTier().answer(scene_with(overrides), {quantities, {}}, {}).value();
}

run::Answer from_tables(const Texts& overrides, const std::vector<run::Quantity>& quantities) {
  const Scene scene = scene_with(overrides);
  const Result result = test_support::run_lumped(scene);
  return run::answer_of(result, observables::last_beat(scene, result.observables), {quantities, {}});
}

class ShortAnswer : public testing::TestWithParam<const char*> {
 protected:
  Texts at(const char* tolerance) const {
    return {GetParam(), std::string("accuracy.tolerance=") + tolerance};
  }
};

}  // namespace

// Extremes, means and changes are within the tolerance of what the observable ranges over, times and shares
// within it of the beat. That of H is left to the law's tails: it is 2.5e5 times as sensitive as a stretch.
TEST_P(ShortAnswer, IsWithinTheTolerance) {
  const auto& all = run::known_quantities();
  Texts exact = at("1e-8");
  exact.emplace_back("output.interval=0.0005");
  const run::Answer reference = from_tables(exact, all);
  for (const char* tolerance : {"0.01", "0.001", "0.0001"}) {
    const run::Answer answer = short_answer(at(tolerance), all);
    double range = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const bool is_time = all[k].unit() == "s";
      if (all[k].statistic == run::Statistic::max) {
        range = reference.values[k] - reference.values[k + 1];
        if (all[k].observable == "von_mises") range = reference.values[k];
      }
      EXPECT_EQ(observables::is_none(answer.values[k]), observables::is_none(reference.values[k]))
          << all[k].name();
      const bool is_count = all[k].statistic == run::Statistic::max_place;
      const bool is_flat = is_time && all[k].statistic != run::Statistic::on && range < 1e-3;
      if (observables::is_none(reference.values[k]) || is_count || is_flat) continue;
      const bool is_share = all[k].statistic == run::Statistic::share;
      const double scale = is_time ? 0.8 : is_share ? 1 : range;
      EXPECT_LE(std::abs(answer.values[k] - reference.values[k]), std::stod(tolerance) * scale)
          << all[k].name() << " at " << tolerance;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Lumped, ShortAnswer,
                         testing::Values("wall.law=EXP1", "wall.law=EXP1+EXP2-FS", "outlet.kind=rcr",
                                         "tether.traction=reference", "lumped.compartments=3",
                                         "outlet.resistance=1.6e6"));

TEST(ShortAnswers, DoNotDependOnWhatElseIsAsked) {
  const auto& all = run::known_quantities();
  const run::Answer together = short_answer({}, all);
  for (const char* name :
       {"pressure.max", "von_mises.P3.mean", "recruitment.P2.share", "fiber_angle.P4.min"}) {
    const auto quantity = run::parse_quantity(name);
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k].name() == name) {
        EXPECT_EQ(short_answer({}, {quantity}).values[0], together.values[k]) << name;
      }
  }
}

/// Walls are shared between points of a thread, and the order of points must not show.
TEST(ShortAnswers, DoNotDependOnTheOrderNorOnThreads) {
  const std::vector<run::Quantity> quantities{run::parse_quantity("pressure.max"),
                                              run::parse_quantity("von_mises.P1.max")};
  constexpr int count = 24;
  const auto point = [](int k) {
    return Texts{fmt::format("outlet.resistance={}", 6e5 + 5e4 * k),
                 fmt::format("tether.stiffness={}", k % 3 == 0 ? 1e7 : 2e7)};
  };
  std::vector<run::Answer> forwards(count), backwards(count), apart(count);
  for (int k = 0; k < count; ++k) forwards[k] = short_answer(point(k), quantities);
  std::jthread([&] {
    for (int k = count - 1; k >= 0; --k) backwards[k] = short_answer(point(k), quantities);
  }).join();
  for_each_index(4, count, [&](int k) { apart[k] = short_answer(point(k), quantities); });
  for (int k = 0; k < count; ++k) {
    EXPECT_EQ(forwards[k].values, backwards[k].values) << k;
    EXPECT_EQ(forwards[k].values, apart[k].values) << k;
  }
}

TEST(ShortAnswers, SayWhenAndWhyThereIsNone) {
  const Texts soft{"wall.law=neo-Hookean", "wall.shear_modulus=1e5", "tether.stiffness=0"};
  try {
    short_answer(soft, {run::parse_quantity("pressure.max")});
    FAIL();
  } catch (const SolverFailure& failure) {
    EXPECT_GT(failure.time(), 0);
    EXPECT_NE(std::string(failure.what()).find("carries at most"), std::string::npos) << failure.what();
  }
  RunControl control;
  control.interrupted = [] { return true; };
  EXPECT_THROW(static_cast<void>(lumped::LumpedTier().answer(
                   scene_with({}), {{run::parse_quantity("pressure.max")}, {}}, control)),
               Interrupted);
  EXPECT_FALSE(lumped::LumpedTier().answer(
      scene_with({}), {{run::parse_quantity("pressure.max")}, {"outlet.resistance"}}, {}));
}
