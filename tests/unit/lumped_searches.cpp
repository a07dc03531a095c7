// SPDX-License-Identifier: GPL-3.0-or-later
// Searches of the 0D tier that took minutes or did not end, and claims that were not so.
#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/linear/anderson.hpp"
#include "core/units.hpp"
#include "lumped/multistep.hpp"
#include "tests/support/lumped_runs.hpp"

namespace tunica {
namespace {

using test_support::column;
using test_support::joined;
using test_support::run_lumped;

double mean_over_the_beat(const std::vector<double>& values) {
  // A period in equal steps, its end being its start: the trapezoidal rule.
  return std::accumulate(values.begin() + 1, values.end(), 0.0) / static_cast<double>(values.size() - 1);
}

// Twenty compartments with inertance: what takes two beats from rest takes no more on the limit cycle than a
// search of some beats, and is what comes of beats from rest. Steps are what the time goes into.
TEST(LumpedSearch, LongChainsComeToTheirLimitCycleWithinBeats) {
  const std::vector<std::string> chain{"outlet.kind=rcr",          "outlet.proximal_resistance=1e5",
                                       "outlet.resistance=9.32e5", "outlet.compliance=3e-8",
                                       "lumped.compartments=20",   "lumped.inertance=true",
                                       "accuracy.tolerance=5e-6"};
  const Result periodic = run_lumped(joined(chain, {"time.start=periodic"}));
  const Result rest = run_lumped(joined(chain, {"time.beats=4"}));
  for (const char* name : {"pressure", "outflow", "radial_displacement.P1"}) {
    const auto &a = column(periodic.observables, name), &b = column(rest.observables, name);
    for (std::size_t k = 0; k < 800; k += 9)
      EXPECT_NEAR(a[k], b[2400 + k], 1e-6 * test_support::range(a)) << name << " row " << k;
  }
  EXPECT_LT(periodic.record.steps, 2 * rest.record.steps);
}

TEST(LumpedSearch, AHundredCompartmentsLikeTwenty) {
  const Result run = run_lumped({"lumped.compartments=100", "lumped.inertance=true", "time.start=periodic",
                                 "time.beats=1", "accuracy.tolerance=5e-6"});
  const auto& pressure = column(run.observables, "pressure");
  EXPECT_NEAR(pressure.back(), pressure.front(), 1e-6 * test_support::range(pressure));
  EXPECT_LT(run.record.steps, 60'000);
}

// On the limit cycle the compliance of the outlet gives back what it takes, however slowly it is filled: the
// mean pressure is that of the mean flow.
TEST(LumpedSearch, SlowOutletsAreFilledAtOnce) {
  for (const double compliance : {1e-7, 1e-5, 1e-3}) {
    const Result run =
        run_lumped({"outlet.kind=rcr", "outlet.proximal_resistance=1e5", "outlet.resistance=9.32e5",
                    fmt::format("outlet.compliance={}", compliance), "time.start=periodic", "time.beats=1"});
    const double flow = mean_over_the_beat(column(run.observables, "inflow"));
    EXPECT_NEAR(mean_over_the_beat(column(run.observables, "outlet_pressure")) / (1.032e6 * flow), 1, 1e-6)
        << compliance;
    const auto& pressure = column(run.observables, "pressure");
    EXPECT_NEAR(pressure.back(), pressure.front(), 1e-5 * test_support::range(pressure)) << compliance;
  }
}

TEST(LumpedSearch, AnOutletThatLetsNothingOutSaysWhatItWouldTake) {
  for (const char* start : {"periodic", "rest"}) {
    const Scene scene =
        test_support::scene_with({"outlet.resistance=1e15", std::string("time.start=") + start});
    const Result run = lumped::LumpedTier().prepare(scene)->execute({});
    EXPECT_FALSE(run.record.converged);
    EXPECT_NE(run.record.failure.find("the inflow asks for"), std::string::npos) << run.record.failure;
    EXPECT_NE(run.record.failure.find("at lumen stretch 3.92"), std::string::npos) << run.record.failure;
    EXPECT_EQ(run.record.failure.find("at most"), std::string::npos) << run.record.failure;
  }
}

TEST(LumpedSearch, AWallNextToIncompressibleIsComputedAsQuicklyAsOneThatIs) {
  const Result exact = run_lumped({"wall.law=EXP1", "wall.incompressible=true"});
  for (const char* kappa : {"1e12", "1e13"}) {
    const Result run = run_lumped({"wall.law=EXP1", std::string("wall.bulk_modulus=") + kappa});
    const auto &a = column(run.observables, "pressure"), &b = column(exact.observables, "pressure");
    for (std::size_t k = 0; k < a.size(); k += 11)
      EXPECT_NEAR(a[k], b[k], 1e-6 * test_support::range(b)) << kappa;
    EXPECT_LT(run.record.steps, 2 * exact.record.steps);
  }
}

// Walls that were said to give way, and do not. 2D comes to 131 mmHg in all of them, thick ones to 129.
TEST(LumpedSearch, WallsThatCarryTheirPressureAreComputed) {
  struct Wall {
    const char* override;
    double greatest;  ///< mmHg
  };
  for (const auto& [override, greatest] : {Wall{"geometry.thickness=0.1", 130},
                                           {"wall.fiber_stiffening=10", 131},
                                           {"wall.fiber_angle=87", 131},
                                           {"wall.fiber_angle=88", 131},
                                           {"wall.fiber_angle=88.5", 131},
                                           {"wall.fiber_angle=89.5", 131}}) {
    const Result run = run_lumped({override, "output.interval=4e-3"});
    const auto& pressure = column(run.observables, "pressure");
    EXPECT_NEAR(*std::max_element(pressure.begin(), pressure.end()) / mmhg, greatest, 1.5) << override;
  }
}

// Steps that lead nowhere are a failure that says so, and those before are told of.
TEST(LumpedSearch, StepsThatLeadNowhereEnd) {
  lumped::System system;
  system.unknowns = 1;
  system.scales = {1};
  system.magnitudes = [](const double*, double* result) { *result = 1; };
  constexpr double frequency = 1e9;
  system.rate = [](double t, const double*, double* result) {
    *result = frequency * std::cos(frequency * t);
  };
  int told = 0;
  system.progress = [&](double, const lumped::IntegratorStatistics& so_far) {
    ++told;
    EXPECT_GT(so_far.steps, 0);
  };
  lumped::Multistep integrator(system, {}, 1e-8);
  integrator.start(0, 1, {0}, {});
  try {
    integrator.advance(1);
    FAIL() << "ten thousand million steps";
  } catch (const SolverFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("steps have brought the integration only"), std::string::npos)
        << failure.what();
  }
  EXPECT_GT(told, 0);
}

// Two modes that hardly decay and many that do at once: two images for each of the slow ones and the rest.
TEST(Anderson, FindsTheSlowModes) {
  constexpr int size = 30;
  Eigen::VectorXd factor = Eigen::VectorXd::Constant(size, 1e-4),
                  fixed = Eigen::VectorXd::LinSpaced(size, 1, 2);
  factor[3] = 0.999;
  factor[17] = -0.9;
  linear::Anderson anderson(8);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
  for (int k = 0; k < 7; ++k) {
    const Eigen::VectorXd image = fixed + factor.cwiseProduct(x - fixed);
    x = anderson.next(x, image, Eigen::VectorXd::Ones(size));
  }
  EXPECT_LT((x - fixed).lpNorm<Eigen::Infinity>(), 1e-9);
}

}  // namespace
}  // namespace tunica
