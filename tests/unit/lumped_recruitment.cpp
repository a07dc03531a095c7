// SPDX-License-Identifier: GPL-3.0-or-later
// Recruitment times: found as roots, not read off the output grid.
#include <fmt/format.h>

#include "tests/support/lumped_runs.hpp"

namespace tunica {
namespace {

using test_support::column;
using test_support::joined;
using test_support::labels;
using test_support::run_lumped;

constexpr double pi = 3.14159265358979323846;

TEST(LumpedRecruitment, TimesDoNotDependOnTheOutput) {
  for (const char* reading : {"normal", "reference"}) {
    const std::vector<std::string> base{std::string("tether.traction=") + reading};
    const auto times = [&](const std::vector<std::string>& overrides) {
      const Result result = run_lumped(joined(base, overrides));
      return column(result.events, "time");
    };
    const auto reference = times({"accuracy.tolerance=1e-9", "output.interval=1e-3"});
    ASSERT_GE(reference.size(), 8U) << "P1 to P4 are recruited and released";
    for (const std::vector<std::string>& overrides :
         {std::vector<std::string>{"accuracy.tolerance=1e-9", "output.interval=1e-4"},
          {"accuracy.tolerance=1e-9", "output.interval=0.0137"},
          {"accuracy.tolerance=1e-9", "output.interval=0.8"},
          {"accuracy.tolerance=1e-8", "output.interval=1e-3"}}) {
      SCOPED_TRACE(overrides[0] + " " + overrides[1]);
      const auto others = times(overrides);
      ASSERT_EQ(others.size(), reference.size());
      for (std::size_t k = 0; k < others.size(); ++k)
        EXPECT_NEAR(others[k], reference[k], 1e-7) << "event " << k;
    }
  }
}

/// The state of the wall that an output row at exactly the event would show: the run ends there.
double fourth_invariant(const radial::RingModel& model, double stretch, double xi) {
  const auto state = model.respond(stretch, std::array{xi}, false).states[0];
  const double hoop = 1 + state.displacement / (0.033 + 0.01 * xi), radial = 1 + state.radial_slope;
  const double c2 = std::pow(std::cos(42.82 * pi / 180), 2);
  return std::pow(radial * hoop, -2.0 / 3) * (hoop * hoop * c2 + 1 - c2);
}

// At its time a point's I4bar equals a^2, by an equilibrium solved for anew at the lumen stretch that the
// neighbouring rows of a fine output give.
TEST(LumpedRecruitment, FibreStretchIsAtItsThreshold) {
  const double step = 1e-4;
  const Result result = run_lumped({"accuracy.tolerance=1e-9", "output.interval=1e-4", "time.beats=1"});
  const auto& times = column(result.events, "time");
  const auto& points = labels(result.events, "point");
  const auto& u = column(result.observables, "radial_displacement.P1");
  const auto model = test_support::model_with({});
  const double c2 = std::pow(std::cos(42.82 * pi / 180), 2);
  const double threshold = 1.5009 * 1.5009 * c2 + 1 - c2;
  ASSERT_FALSE(times.empty());
  for (std::size_t k = 0; k < times.size(); ++k) {
    // Cubic interpolation through four rows: 1e-4^4 times a fourth derivative of some 1e5/s^4.
    const auto row = static_cast<std::size_t>(times[k] / step);
    if (row < 1 || row + 2 >= u.size()) continue;
    const double x = times[k] / step - static_cast<double>(row);
    const double value = -x * (x - 1) * (x - 2) / 6 * u[row - 1] + (x + 1) * (x - 1) * (x - 2) / 2 * u[row] -
                         (x + 1) * x * (x - 2) / 2 * u[row + 1] + (x + 1) * x * (x - 1) / 6 * u[row + 2];
    const double xi = (points[k][1] - '1') / 3.0;
    EXPECT_NEAR(fourth_invariant(*model, 1 + value / 0.033, xi), threshold, 1e-7)
        << points[k] << " at " << times[k] << " s";
  }
}

TEST(LumpedRecruitment, GoesFromTheInsideOutAndBack) {
  const Result result = run_lumped({"time.start=periodic", "time.beats=1", "tether.traction=reference"});
  const auto& times = column(result.events, "time");
  const auto& points = labels(result.events, "point");
  ASSERT_GE(times.size(), 2U);
  for (std::size_t k = 1; k < times.size(); ++k) EXPECT_LT(times[k - 1], times[k]);
  // Each point that is recruited during the beat is released during it, and columns of H say the same.
  for (int p = 1; p <= 4; ++p) {
    const auto name = fmt::format("P{}", p);
    const auto& share = column(result.observables, fmt::format("recruitment.P{}", p));
    bool on = share.front() > 0.5;
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (points[k] != name) continue;
      on = !on;
      const auto after = static_cast<std::size_t>(std::ceil(times[k] / 1e-3 + 1e-9));
      if (after < share.size()) {
        EXPECT_EQ(share[after] > 0.5, on) << name << " after " << times[k] << " s";
      }
    }
    EXPECT_EQ(share.back() > 0.5, on);
  }
}

TEST(LumpedRecruitment, RecruitedTimeIsTheSumOfTheIntervalsOfTheLastBeat) {
  for (const char* start : {"rest", "periodic"}) {
    const Result result = run_lumped({std::string("time.start=") + start, "accuracy.tolerance=1e-8"});
    const auto& points = labels(result.recruited_time, "point");
    const auto& totals = column(result.recruited_time, "recruited_time");
    ASSERT_EQ(points.size(), 4U);
    const auto& times = column(result.events, "time");
    const auto& where = labels(result.events, "point");
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto& share = column(result.observables, "recruitment." + points[p]);
      bool on = share[800] > 0.5;
      double since = 0.8, total = 0;
      for (std::size_t k = 0; k < times.size(); ++k) {
        if (where[k] != points[p] || times[k] < 0.8) continue;
        if (on) total += times[k] - since;
        on = !on;
        since = times[k];
      }
      if (on) total += 1.6 - since;
      EXPECT_NEAR(totals[p], total, 1e-12) << points[p] << ", start " << start;
      EXPECT_GE(totals[p], 0);
      EXPECT_LE(totals[p], 0.8 + 1e-12);
    }
  }
}

TEST(LumpedRecruitment, LawsWithoutFibresHaveNone) {
  for (const char* law : {"EXP1", "EXP2", "neo-Hookean"}) {
    const Result result = run_lumped({std::string("wall.law=") + law, "time.beats=1"});
    EXPECT_EQ(result.events.rows(), 0U) << law;
    for (const char* name : {"fiber_angle.P1", "fiber_stretch.P4", "recruitment.P2"})
      for (const double value : column(result.observables, name))
        ASSERT_TRUE(observables::is_none(value)) << law;
  }
}

}  // namespace
}  // namespace tunica
