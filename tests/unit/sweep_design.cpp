// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/scene/scene.hpp"
#include "verification/uncertainty/design.hpp"
#include "verification/uncertainty/marginal.hpp"

using namespace tunica;
using namespace tunica::uncertainty;

namespace {

std::vector<double> point(Design& design, std::uint64_t index) {
  std::vector<double> coordinates(static_cast<std::size_t>(design.dimension()));
  design.point(index, coordinates.data());
  return coordinates;
}

Marginal marginal(const std::string& text) {
  return parse_marginal(text, "outlet.resistance", "dyn s/cm5").value();
}

}  // namespace

TEST(Design, SobolsSequenceContinues) {
  Design small(Sampling::sobol, 8, 3, 0), large(Sampling::sobol, 64, 3, 0);
  EXPECT_EQ(point(small, 0), (std::vector<double>{0.5, 0.5, 0.5}));
  EXPECT_EQ(point(small, 1)[0], 0.75);
  EXPECT_EQ(point(small, 2)[0], 0.25);
  for (std::uint64_t k = 0; k < 8; ++k) EXPECT_EQ(point(small, k), point(large, k));
  // Backwards as well.
  const auto fifth = point(large, 5);
  static_cast<void>(point(large, 60));
  EXPECT_EQ(point(large, 5), fifth);
}

/// Each of the first 2^m - 1 points after 0 is in an interval of its own in every coordinate.
TEST(Design, SobolsPointsFillEachCoordinate) {
  constexpr std::uint64_t count = 63;
  Design design(Sampling::sobol, count, 5, 0);
  for (int k = 0; k < 5; ++k) {
    std::vector<bool> taken(count + 1, false);
    for (std::uint64_t i = 0; i < count; ++i)
      taken[static_cast<std::size_t>(point(design, i)[static_cast<std::size_t>(k)] * (count + 1))] = true;
    EXPECT_EQ(std::count(taken.begin(), taken.end(), true), static_cast<long>(count));
  }
}

TEST(Design, ALatinHypercubeHasOnePointInEachInterval) {
  for (const std::uint64_t count : {1U, 2U, 7U, 100U, 1025U}) {
    Design design(Sampling::latin_hypercube, count, 3, 42);
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<int> in(count, 0);
      for (std::uint64_t i = 0; i < count; ++i)
        ++in[static_cast<std::size_t>(point(design, i)[k] * static_cast<double>(count))];
      EXPECT_EQ(std::count(in.begin(), in.end(), 1), static_cast<long>(count)) << count;
    }
  }
}

/// Independent uniform numbers: means and correlations within 4 standard errors of N = 20,000.
TEST(Design, RandomPointsAreUniformAndIndependent) {
  constexpr std::uint64_t count = 20'000;
  for (const Sampling sampling : {Sampling::random, Sampling::latin_hypercube}) {
    Design design(sampling, count, 3, 7);
    double sum[3] = {}, product[3] = {};
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto x = point(design, i);
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_GT(x[k], 0);
        ASSERT_LT(x[k], 1);
        sum[k] += x[k] - 0.5;
        product[k] += (x[k] - 0.5) * (x[(k + 1) % 3] - 0.5);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT(std::abs(sum[k]) / count, 4 / std::sqrt(12.0 * count));
      EXPECT_LT(std::abs(product[k]) / count, 4 / (12 * std::sqrt(count)));
    }
  }
}

TEST(Design, DependsOnItsSeed) {
  for (const Sampling sampling : {Sampling::sobol, Sampling::latin_hypercube, Sampling::random}) {
    Design one(sampling, 16, 2, 1), again(sampling, 16, 2, 1), other(sampling, 16, 2, 2);
    EXPECT_EQ(point(one, 9), point(again, 9));
    EXPECT_NE(point(one, 9), point(other, 9));
  }
  EXPECT_THROW(Design(Sampling::random, 0, 2, 0), InvalidInput);
  EXPECT_THROW(Design(Sampling::sobol, 10, 41, 0), InvalidInput);
}

TEST(Marginal, QuantilesInvertProbabilities) {
  for (const char* text : {"uniform(-1, 3)", "loguniform(1e5, 1e7)", "normal(10, 2)", "lognormal(100, 10)",
                           "triangular(0, 1, 5)"}) {
    const Marginal of = marginal(text);
    for (const double p : {1e-6, 0.01, 0.3, 0.5, 0.9, 1 - 1e-6})
      EXPECT_NEAR(of.probability(of.quantile(p)), p, 1e-9) << text;
  }
}

/// Means and deviations against those of many equally probable quantiles; what is missing of the tails is
/// below 1e-3 of a deviation.
TEST(Marginal, MomentsAreThoseOfTheNumberItself) {
  constexpr int count = 200'000;
  for (const char* text : {"uniform(-1, 3)", "loguniform(1e5, 1e7)", "normal(10, 2)", "lognormal(100, 10)",
                           "triangular(0, 1, 5)"}) {
    const Marginal of = marginal(text);
    double sum = 0, squares = 0;
    for (int k = 0; k < count; ++k) {
      const double x = of.quantile((k + 0.5) / count) - of.mean();
      sum += x;
      squares += x * x;
    }
    EXPECT_NEAR(sum / count, 0, 1e-3 * of.standard_deviation()) << text;
    EXPECT_NEAR(std::sqrt(squares / count), of.standard_deviation(), 1e-3 * of.standard_deviation()) << text;
  }
  EXPECT_EQ(marginal("lognormal(100, 10)").mean(), 100);
}

TEST(Marginal, IsReadWithUnits) {
  EXPECT_NEAR(parse_marginal("normal(75 mmHg, 5 mmHg)", "inlet.pressure", "dyn/cm2")->a, 75 * 1333.22387,
              0.1);
  EXPECT_FALSE(parse_marginal("1:2", "inlet.pressure", "dyn/cm2"));
  for (const char* text :
       {"normal(1)", "normal(1, 0)", "uniform(2, 1)", "lognormal(-1, 1)", "triangular(0, 6, 5)",
        "nromal(1, 1)", "uniform(a, b)", "loguniform(0, 1)", "normal(1, 2, 3)", "f()"})
    EXPECT_THROW(parse_marginal(text, "outlet.resistance", "dyn s/cm5"), InvalidInput) << text;
}
