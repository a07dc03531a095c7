// SPDX-License-Identifier: GPL-3.0-or-later
// Surrogates of Tunica beside those of OpenTURNS 1.20, by tools/openturns-surrogates: the share of the
// variance that they predict at 1,000 fresh points, and processor seconds of one fit; means over 20 samples
// of random points.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <openturns/OT.hxx>

#include "tests/support/sensitivity_functions.hpp"
#include "verification/uncertainty/design.hpp"
#include "verification/uncertainty/surrogate.hpp"

namespace {

using tunica::test_support::Function;
using tunica::uncertainty::Coordinate;
using tunica::uncertainty::Design;
using tunica::uncertainty::Marginal;
using tunica::uncertainty::Sampling;
using Unit = std::vector<double>;

struct Score {
  double q2 = 0, seconds = 0;
};

std::vector<Unit> random_points(std::size_t count, int inputs, std::uint64_t seed) {
  Design design(Sampling::random, count, inputs, seed);
  std::vector<Unit> points(count, Unit(static_cast<std::size_t>(inputs)));
  for (std::size_t i = 0; i < count; ++i) design.point(i, points[i].data());
  return points;
}

/// Adds what a fit says at fresh points, and its time, to a mean over `samples`.
template <class Fit>
void add(Score& score, const Function& function, int inputs, int samples, const Fit& fit) {
  const std::clock_t begin = std::clock();
  const auto predict = fit();
  score.seconds += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / samples;
  double missed = 0, sum = 0, squares = 0;
  const auto fresh = random_points(1000, inputs, 12345);
  for (const Unit& unit : fresh) {
    const double value = function(unit), error = value - predict(unit);
    missed += error * error;
    sum += value;
    squares += value * value;
  }
  score.q2 += (1 - missed / (squares - sum * sum / static_cast<double>(fresh.size()))) / samples;
}

OT::Point to_ot(const Unit& unit) {
  OT::Point point(unit.size());
  for (std::size_t k = 0; k < unit.size(); ++k) point[k] = 2 * unit[k] - 1;
  return point;
}

void compare(const char* name, const Function& function, int inputs, std::size_t count) {
  constexpr int samples = 20;
  const std::vector<int> strata{12, 20, 40, 80};
  std::vector<Score> chaos(strata.size());
  Score kriging, own;
  for (int seed = 1; seed <= samples; ++seed) {
    const auto points = random_points(count, inputs, static_cast<std::uint64_t>(seed));
    const auto size = static_cast<OT::UnsignedInteger>(inputs);
    OT::Sample places(count, size), values(count, 1);
    const std::vector<Coordinate> coordinates(points[0].size(), Coordinate(Marginal{}));
    Eigen::MatrixXd own_places(count, inputs);
    Eigen::VectorXd own_values(count);
    for (std::size_t i = 0; i < count; ++i) {
      places[i] = to_ot(points[i]);
      own_values[i] = values(i, 0) = function(points[i]);
      for (int k = 0; k < inputs; ++k) own_places(i, k) = coordinates[k].of(points[i][k]);
    }
    for (std::size_t s = 0; s < strata.size(); ++s)
      add(chaos[s], function, inputs, samples, [&] {
        OT::ComposedDistribution::DistributionCollection laws(size, OT::Uniform(-1, 1));
        OT::OrthogonalProductPolynomialFactory::PolynomialFamilyCollection families(size,
                                                                                    OT::LegendreFactory());
        const OT::HyperbolicAnisotropicEnumerateFunction order(size, 0.75);
        const OT::OrthogonalProductPolynomialFactory basis(families, order);
        const auto terms = std::min<OT::UnsignedInteger>(1000, order.getStrataCumulatedCardinal(strata[s]));
        OT::FunctionalChaosAlgorithm algorithm(
            places, values, OT::ComposedDistribution(laws), OT::FixedStrategy(basis, terms),
            OT::LeastSquaresStrategy(
                places, values,
                OT::LeastSquaresMetaModelSelectionFactory(OT::LARS(), OT::CorrectedLeaveOneOut())));
        algorithm.run();
        const OT::Function found = algorithm.getResult().getMetaModel();
        return [found](const Unit& unit) { return found(to_ot(unit))[0]; };
      });
    add(kriging, function, inputs, samples, [&] {
      OT::KrigingAlgorithm algorithm(places, values,
                                     OT::MaternModel(OT::Point(size, 1.0), OT::Point(1, 1.0), 2.5),
                                     OT::ConstantBasisFactory(size).build());
      algorithm.run();
      const OT::Function found = algorithm.getResult().getMetaModel();
      return [found](const Unit& unit) { return found(to_ot(unit))[0]; };
    });
    add(own, function, inputs, samples, [&] {
      const auto found = std::make_shared<tunica::uncertainty::Validated>(
          tunica::uncertainty::fit_surrogate({coordinates, own_places, own_values}));
      return [found, &coordinates](const Unit& unit) {
        Eigen::VectorXd place(unit.size());
        for (std::size_t k = 0; k < unit.size(); ++k) place[k] = coordinates[k].of(unit[k]);
        return found->surrogate->value(place);
      };
    });
  }
  fmt::print("{}, {} points\n", name, count);
  for (std::size_t s = 0; s < strata.size(); ++s)
    fmt::print("  OpenTURNS, sparse chaos of {} strata: {:.3f} in {:.1f} ms\n", strata[s], chaos[s].q2,
               1e3 * chaos[s].seconds);
  fmt::print("  OpenTURNS, kriging: {:.3f} in {:.1f} ms\n", kriging.q2, 1e3 * kriging.seconds);
  fmt::print("  Tunica, with cross-validation: {:.3f} in {:.1f} ms\n", own.q2, 1e3 * own.seconds);
}

}  // namespace

int main() {
  OT::Log::Show(OT::Log::NONE);
  compare("Ishigami", tunica::test_support::ishigami, 3, 64);
  compare("Ishigami", tunica::test_support::ishigami, 3, 128);
  compare("g-function", tunica::test_support::g_function, 4, 128);
}
