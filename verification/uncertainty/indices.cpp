// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/uncertainty/indices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace tunica::uncertainty {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What an estimate is made of, over a number of groups.
struct Sums {
  double a = 0, b = 0, squares = 0, weight = 0;
  std::vector<double> first, total;

  explicit Sums(std::size_t inputs) : first(inputs, 0.0), total(inputs, 0.0) {}
};

struct Group {
  double a, b, squares;
  std::vector<double> first, total;
};

/// First and total indices, one input after the other.
std::vector<double> indices_of(const Sums& sums) {
  const double mean = (sums.a + sums.b) / (2 * sums.weight);
  const double variance = sums.squares / (2 * sums.weight) - mean * mean;
  std::vector<double> all;
  for (std::size_t k = 0; k < sums.first.size(); ++k) {
    all.push_back(sums.first[k] / sums.weight / variance);
    all.push_back(0.5 * sums.total[k] / sums.weight / variance);
  }
  return all;
}

bool is_whole(const PickFreeze& outputs, std::size_t group) {
  return !std::isnan(outputs.a[group]) && !std::isnan(outputs.b[group]) &&
         std::none_of(outputs.mixed.begin(), outputs.mixed.end(),
                      [&](const auto& values) { return std::isnan(values[group]); });
}

}  // namespace

std::uint64_t whole_groups(const PickFreeze& outputs) {
  std::uint64_t count = 0;
  for (std::size_t group = 0; group < outputs.a.size(); ++group) count += is_whole(outputs, group);
  return count;
}

std::vector<SobolIndices> sobol_indices(const PickFreeze& outputs, std::uint64_t seed, int replications) {
  const std::size_t inputs = outputs.mixed.size();
  std::vector<Group> groups;
  double mean = 0, count = 0, largest = 0;
  for (std::size_t g = 0; g < outputs.a.size(); ++g) {
    if (!is_whole(outputs, g)) continue;
    mean += outputs.a[g] + outputs.b[g];
    count += 2;
    largest = std::max({largest, std::abs(outputs.a[g]), std::abs(outputs.b[g])});
  }
  mean /= count;
  double variance = 0;
  for (std::size_t g = 0; g < outputs.a.size(); ++g) {
    if (!is_whole(outputs, g)) continue;
    // The centre is any number near the mean: products of what is large and all but equal lose their digits.
    const double a = outputs.a[g] - mean, b = outputs.b[g] - mean;
    Group group{a, b, a * a + b * b, {}, {}};
    for (std::size_t k = 0; k < inputs; ++k) {
      const double mixed = outputs.mixed[k][g] - mean;
      group.first.push_back(b * (mixed - a));
      group.total.push_back((a - mixed) * (a - mixed));
    }
    variance += group.squares / count;
    groups.push_back(std::move(group));
  }
  constexpr double rounding = 1e-12;
  if (groups.size() < fewest_groups || !(std::sqrt(variance) > rounding * largest))
    return std::vector<SobolIndices>(inputs, {{none, none, none}, {none, none, none}});

  const auto add = [&](Sums& sums, const Group& group) {
    sums.a += group.a;
    sums.b += group.b;
    sums.squares += group.squares;
    sums.weight += 1;
    for (std::size_t k = 0; k < inputs; ++k) {
      sums.first[k] += group.first[k];
      sums.total[k] += group.total[k];
    }
  };
  Sums all(inputs);
  for (const Group& group : groups) add(all, group);
  const std::vector<double> values = indices_of(all);
  std::vector<double> sum(values.size(), 0.0), squares(values.size(), 0.0);
  std::mt19937_64 random(seed);
  for (int replication = 0; replication < replications; ++replication) {
    Sums sums(inputs);
    // A plain remainder: the standard's distributions differ between libraries.
    for (std::size_t g = 0; g < groups.size(); ++g) add(sums, groups[random() % groups.size()]);
    const std::vector<double> found = indices_of(sums);
    for (std::size_t k = 0; k < found.size(); ++k) {
      sum[k] += found[k] - values[k];
      squares[k] += (found[k] - values[k]) * (found[k] - values[k]);
    }
  }
  const auto estimate = [&](std::size_t k) {
    const double shift = sum[k] / replications;
    const double spread = squares[k] / replications - shift * shift;
    // Some replications do not vary: the groups that differ are too few to tell how sure their index is.
    if (!std::isfinite(spread)) return Estimate{values[k], none, none};
    const double deviation = std::sqrt(std::max(0.0, spread));
    constexpr double of_95 = 1.959964;
    return Estimate{values[k], values[k] - of_95 * deviation, values[k] + of_95 * deviation};
  };
  std::vector<SobolIndices> result;
  for (std::size_t k = 0; k < inputs; ++k) result.push_back({estimate(2 * k), estimate(2 * k + 1)});
  return result;
}

}  // namespace tunica::uncertainty
