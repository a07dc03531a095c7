// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/uncertainty/kriging.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace tunica::uncertainty {

namespace {

using Eigen::Index;

Eigen::ArrayXd matern(const Eigen::ArrayXd& distance, double length) {
  const Eigen::ArrayXd h = std::sqrt(5.0) / length * distance.abs();
  return (1 + h + h.square() / 3) * (-h).exp();
}

Eigen::MatrixXd correlation(const Eigen::MatrixXd& places, const Scales& scales) {
  const Index points = places.rows();
  Eigen::MatrixXd all(points, points);
  for (Index i = 0; i < points; ++i) {
    Eigen::ArrayXd product = Eigen::ArrayXd::Ones(points - i);
    for (Index k = 0; k < places.cols(); ++k)
      product *= matern(places.col(k).tail(points - i).array() - places(i, k), scales.lengths[k]);
    all.col(i).tail(points - i) = product;
    all.row(i).tail(points - i) = product.matrix().transpose();
  }
  all.diagonal().array() += scales.noise;
  return all;
}

/// Twice the logarithm of the likelihood, less what does not depend on the scales; the level and variance are
/// the likeliest.
double likelihood(const Known& known, const Scales& scales) {
  const Eigen::LLT<Eigen::MatrixXd> factor(correlation(known.places, scales));
  if (factor.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  const Index points = known.values.size();
  const Eigen::VectorXd ones = factor.matrixL().solve(Eigen::VectorXd::Ones(points)),
                        values = factor.matrixL().solve(known.values);
  const Eigen::VectorXd rest = values - ones.dot(values) / ones.squaredNorm() * ones;
  const Eigen::VectorXd diagonal = factor.matrixLLT().diagonal();
  return -static_cast<double>(points) * std::log(rest.squaredNorm()) - 2 * diagonal.array().log().sum();
}

}  // namespace

Scales likely_scales(const Known& known) {
  constexpr double shortest = 1.0 / 16, longest = 64, least_noise = 1e-8, most_noise = 0.1;
  Scales best{Eigen::VectorXd::Ones(known.places.cols()), least_noise};
  double height = likelihood(known, best);
  const auto climb = [&](const Scales& trial) {
    const bool is_allowed = trial.lengths.minCoeff() >= shortest && trial.lengths.maxCoeff() <= longest &&
                            trial.noise >= least_noise * (1 - 1e-9) && trial.noise <= most_noise;
    if (!is_allowed) return false;
    const double found = likelihood(known, trial);
    if (!(found > height)) return false;
    height = found;
    best = trial;
    return true;
  };
  constexpr int most_rounds = 12;
  for (const double step : {2.0, std::sqrt(2.0)}) {
    bool has_moved = true;
    for (int round = 0; has_moved && round < most_rounds; ++round) {
      has_moved = false;
      for (Index k = 0; k <= best.lengths.size(); ++k)
        for (const double way : {1.0, -1.0}) {
          Scales trial = best;
          if (k < best.lengths.size())
            trial.lengths[k] *= std::pow(step, way);
          else
            trial.noise *= std::pow(step, 4 * way);
          if (climb(trial)) {
            has_moved = true;
            break;
          }
        }
    }
  }
  return best;
}

Kriging::Kriging(const Known& known, const Scales& scales)
    : coordinates_(known.coordinates), places_(known.places), scales_(scales) {
  const Index points = places_.rows(), inputs = places_.cols();
  const Eigen::LLT<Eigen::MatrixXd> factor(correlation(places_, scales_));
  const Eigen::VectorXd ones = factor.solve(Eigen::VectorXd::Ones(points));
  level_ = ones.dot(known.values) / ones.sum();
  weights_ = factor.solve((known.values.array() - level_).matrix()).array();
  means_ = Eigen::ArrayXXd::Zero(points, inputs);
  Eigen::ArrayXXd both = Eigen::ArrayXXd::Ones(points, points);
  Eigen::ArrayXd alone = Eigen::ArrayXd::Ones(points);
  for (Index k = 0; k < inputs; ++k) {
    const auto& rule = coordinates_[static_cast<std::size_t>(k)].quadrature();
    Eigen::MatrixXd at(points, static_cast<Index>(rule.size()));
    Eigen::VectorXd shares(at.cols());
    for (Index q = 0; q < at.cols(); ++q) {
      at.col(q) = towards(k, rule[static_cast<std::size_t>(q)].place);
      shares[q] = rule[static_cast<std::size_t>(q)].weight;
    }
    means_.col(k) = (at * shares).array();
    products_.emplace_back((at * shares.asDiagonal() * at.transpose()).array());
    both *= products_.back();
    alone *= means_.col(k);
  }
  const double above = (weights_ * alone).sum();
  mean_ = level_ + above;
  variance_ = weights_.matrix().dot(both.matrix() * weights_.matrix()) - above * above;
}

Eigen::ArrayXd Kriging::towards(Index input, double z) const {
  return matern(places_.col(input).array() - z, scales_.lengths[input]);
}

double Kriging::value(const Eigen::VectorXd& place) const {
  Eigen::ArrayXd product = weights_;
  for (Index k = 0; k < places_.cols(); ++k) product *= towards(k, place[k]);
  return level_ + product.sum();
}

double Kriging::first(Index input, const Eigen::VectorXd& place) const {
  Eigen::ArrayXd product = weights_ * towards(input, place[input]);
  for (Index k = 0; k < places_.cols(); ++k)
    if (k != input) product *= means_.col(k);
  return level_ + product.sum() - mean_;
}

double Kriging::first_variance(Index input) const {
  Eigen::VectorXd place = Eigen::VectorXd::Zero(places_.cols());
  double all = 0;
  for (const auto& [z, weight] : coordinates_[static_cast<std::size_t>(input)].quadrature()) {
    place[input] = z;
    const double part = first(input, place);
    all += weight * part * part;
  }
  return all;
}

double Kriging::total(Index input, const Eigen::VectorXd& place) const {
  Eigen::ArrayXd product = weights_ * (towards(input, place[input]) - means_.col(input));
  for (Index k = 0; k < places_.cols(); ++k)
    if (k != input) product *= towards(k, place[k]);
  return product.sum();
}

double Kriging::total_variance(Index input) const {
  Eigen::ArrayXXd both = products_[static_cast<std::size_t>(input)] -
                         (means_.col(input).matrix() * means_.col(input).matrix().transpose()).array();
  for (Index k = 0; k < places_.cols(); ++k)
    if (k != input) both *= products_[static_cast<std::size_t>(k)];
  return std::max(0.0, weights_.matrix().dot(both.matrix() * weights_.matrix()));
}

}  // namespace tunica::uncertainty
