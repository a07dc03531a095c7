// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/uncertainty/surrogate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "verification/uncertainty/chaos.hpp"
#include "verification/uncertainty/kriging.hpp"

namespace tunica::uncertainty {

namespace {

using Eigen::Index;
using Points = std::vector<Index>;
using Fit = std::function<std::unique_ptr<Surrogate>(const Known&)>;

constexpr double of_95 = 1.959964;

/// The points dealt into parts, as by chance and always alike.
std::vector<Points> dealt(Index count) {
  Points order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), Index{0});
  std::mt19937_64 random(count);
  // Not std::shuffle: libraries differ in it.
  for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random() % k]);
  std::vector<Points> parts(count > 100 ? 5 : 10);
  for (std::size_t k = 0; k < order.size(); ++k) parts[k % parts.size()].push_back(order[k]);
  return parts;
}

Points all_but(const Points& part, Index count) {
  std::vector<bool> is_in(static_cast<std::size_t>(count), false);
  for (const Index point : part) is_in[static_cast<std::size_t>(point)] = true;
  Points others;
  for (Index point = 0; point < count; ++point)
    if (!is_in[static_cast<std::size_t>(point)]) others.push_back(point);
  return others;
}

double q2_of(const Eigen::VectorXd& residuals, const Eigen::VectorXd& values) {
  return 1 - residuals.squaredNorm() / (values.array() - values.mean()).matrix().squaredNorm();
}

/// Each point less what is made of the others.
Eigen::VectorXd cross_validated(const Known& known, const std::vector<Points>& parts, const Fit& fit) {
  Eigen::VectorXd residuals(known.values.size());
  for (const Points& part : parts) {
    const auto surrogate = fit(known.at(all_but(part, known.values.size())));
    for (const Index point : part)
      residuals[point] = known.values[point] - surrogate->value(known.places.row(point));
  }
  return residuals;
}

bool varies(const Eigen::VectorXd& values) {
  // What solvers leave by chance.
  constexpr double noise = 1e-6;
  return values.size() > 1 &&
         (values.array() - values.mean()).abs().maxCoeff() > noise * values.cwiseAbs().maxCoeff();
}

Validated by(const Known& known, const std::vector<Points>& parts, const Fit& fit) {
  Validated found{fit(known), known.places, cross_validated(known, parts, fit), 0};
  found.q2 = q2_of(found.residuals, known.values);
  return found;
}

const Fit chaos = [](const Known& known) -> std::unique_ptr<Surrogate> { return fit_chaos(known); };

/// What model `level` adds to the one below, at the points that have both.
struct Part {
  Points points;
  Eigen::VectorXd values;
  Eigen::VectorXd residuals = {};  ///< by point of the sample
};
Part part_of(const std::vector<std::vector<double>>& levels, std::size_t level) {
  Part part;
  std::vector<double> values;
  for (std::size_t i = 0; i < levels[level].size(); ++i) {
    const double below = level > 0 ? levels[level - 1][i] : 0, value = levels[level][i] - below;
    if (std::isnan(value)) continue;
    part.points.push_back(static_cast<Index>(i));
    values.push_back(value);
  }
  part.values = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
  return part;
}

}  // namespace

Validated fit_surrogate(const Known& known) {
  if (!varies(known.values)) return {};
  const auto parts = dealt(known.values.size());
  Validated found = by(known, parts, chaos);
  // Kriging costs the cube of the number of points.
  constexpr double good = 0.99;
  constexpr Index most_kriged = 600;
  if (found.q2 >= good || known.values.size() > most_kriged) return found;
  const Scales scales = likely_scales(known);
  Validated other = by(known, parts, [&](const Known& some) -> std::unique_ptr<Surrogate> {
    return std::make_unique<Kriging>(some, scales);
  });
  return other.q2 > found.q2 ? std::move(other) : std::move(found);
}

Validated fit_fidelities(const std::vector<Coordinate>& coordinates, const Eigen::MatrixXd& places,
                         const std::vector<std::vector<double>>& levels) {
  const std::size_t last = levels.size() - 1;
  Part dearest = part_of({levels[last]}, 0);
  Validated alone = fit_surrogate({coordinates, places(dearest.points, Eigen::all), dearest.values});
  if (!alone.surrogate) return {};
  auto whole = std::make_unique<Chaos>(coordinates, std::vector<Chaos::Term>{});
  Eigen::VectorXd residuals = Eigen::VectorXd::Zero(places.rows());
  for (std::size_t level = 0; level <= last; ++level) {
    const Part part = part_of(levels, level);
    const Known known{coordinates, places(part.points, Eigen::all), part.values};
    const auto fit = fit_chaos(known);
    const Eigen::VectorXd missed = cross_validated(known, dealt(part.values.size()), chaos);
    Eigen::VectorXd of_part =
        Eigen::VectorXd::Constant(places.rows(), std::numeric_limits<double>::quiet_NaN());
    of_part(part.points) = missed;
    residuals += of_part;
    whole = sum(coordinates, *whole, *fit);
  }
  Points points;
  for (Index i = 0; i < residuals.size(); ++i)
    if (!std::isnan(residuals[i])) points.push_back(i);
  Eigen::VectorXd values(static_cast<Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    values[static_cast<Index>(i)] = levels[last][static_cast<std::size_t>(points[i])];
  Validated together{std::move(whole), places(points, Eigen::all), residuals(points), 0, true};
  together.q2 = q2_of(together.residuals, values);
  return together.q2 > alone.q2 ? std::move(together) : std::move(alone);
}

std::vector<SobolIndices> surrogate_indices(const Validated& validated) {
  const Surrogate& g = *validated.surrogate;
  const Eigen::ArrayXd e = validated.residuals.array();
  const Index points = e.size();
  const double count = static_cast<double>(points);
  const double mean_square = e.square().mean();
  const double spread = std::sqrt((e.square() - mean_square).square().mean() / count);
  constexpr double one_sided_95 = 1.644854;
  const double missed = mean_square + one_sided_95 * spread;
  const double own = g.variance(), variance = own + missed, mean = g.mean();
  Eigen::ArrayXd whole(points);
  for (Index i = 0; i < points; ++i) whole[i] = g.value(validated.places.row(i)) - mean;
  const auto estimate = [&](double part, const Eigen::ArrayXd& projected) {
    const double index = part / own;
    const Eigen::ArrayXd influence = 2 * (projected - index * whole) * e / variance;
    const double shift = influence.mean();
    const double square = shift * shift + (influence - shift).square().mean() / count;
    const double width = of_95 * std::sqrt(square);
    return Estimate{index, std::clamp(part / variance - width, 0.0, index),
                    std::clamp((part + missed) / variance + width, index, 1.0)};
  };
  std::vector<SobolIndices> all;
  for (Index k = 0; k < validated.places.cols(); ++k) {
    Eigen::ArrayXd first(points), total(points);
    for (Index i = 0; i < points; ++i) {
      first[i] = g.first(k, validated.places.row(i));
      total[i] = g.total(k, validated.places.row(i));
    }
    all.push_back({estimate(g.first_variance(k), first), estimate(g.total_variance(k), total)});
  }
  return all;
}

Estimate surrogate_mean(const Validated& validated) {
  const Eigen::ArrayXd e = validated.residuals.array();
  const double shift = e.mean(), count = static_cast<double>(e.size());
  const double width = of_95 * std::sqrt((e - shift).square().mean() / count + shift * shift);
  const double mean = validated.surrogate->mean();
  return {mean, mean - width, mean + width};
}

}  // namespace tunica::uncertainty
