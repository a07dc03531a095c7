// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "verification/uncertainty/coordinate.hpp"
#include "verification/uncertainty/indices.hpp"

namespace tunica::uncertainty {

/// Points at which a quantity is known.
struct Known {
  const std::vector<Coordinate>& coordinates;  ///< one an input
  Eigen::MatrixXd places;                      ///< [point][input], of the coordinates
  Eigen::VectorXd values;

  /// Those of the points that are named.
  Known at(const std::vector<Eigen::Index>& points) const {
    return {coordinates, places(points, Eigen::all), values(points)};
  }
};

/// A function g of independent inputs that stands for a dear one, with what Sobol' indices need of it.
class Surrogate {
 public:
  Surrogate() = default;
  Surrogate(const Surrogate&) = delete;
  Surrogate& operator=(const Surrogate&) = delete;
  virtual ~Surrogate() = default;

  virtual std::string kind() const = 0;
  virtual double mean() const = 0;
  virtual double variance() const = 0;
  /// g at a place.
  virtual double value(const Eigen::VectorXd& place) const = 0;
  /// What the input alone is worth: E[g | its coordinate] less the mean, and the variance of that.
  virtual double first(Eigen::Index input, const Eigen::VectorXd& place) const = 0;
  virtual double first_variance(Eigen::Index input) const = 0;
  /// What is unknown without the input: g less E[g | all other coordinates], and the variance of that.
  virtual double total(Eigen::Index input, const Eigen::VectorXd& place) const = 0;
  virtual double total_variance(Eigen::Index input) const = 0;
};

/// A surrogate with what it misses.
struct Validated {
  std::unique_ptr<Surrogate> surrogate;
  Eigen::MatrixXd places;     ///< at which it was tried
  Eigen::VectorXd residuals;  ///< f - g at each, where g has not seen the value there
  double q2 = 0;              ///< 1 - sum of residuals^2 / sum of (f - mean f)^2
  bool sums_levels = false;   ///< fit_fidelities: made of the values of all models
};

/// Fewer points make no surrogate of so many inputs.
inline Eigen::Index fewest_points(Eigen::Index inputs) {
  return std::max<Eigen::Index>(16, 4 * (inputs + 1));
}
/// More points than these a surrogate does not take: its cost grows with their square.
inline constexpr Eigen::Index most_points = 2000;

/// Sparse chaos, or kriging where that misses more than 1 % of the variance and kriging misses less. Both are
/// tried by cross-validation: the points are dealt into 10 parts (5 of more than 100 points), and each part
/// is predicted by a surrogate that was made, from the choice of its terms on, of the others; only the length
/// scales of kriging are those of all points. No surrogate where the values vary by less
/// than 1e-6 of the largest.
Validated fit_surrogate(const Known& known);

/// The same quantity by ever dearer models: `levels[l][i]` is its value by model l at the i-th point; none
/// where it has not been computed or has none. f_last = f_0 + (f_1 - f_0) + ... + (f_last - f_(last - 1)),
/// each part by sparse chaos of the points that have it; or by a surrogate of the last model's values alone,
/// where that is better by cross-validation. Residuals are those of the last model: the sum of its parts'.
Validated fit_fidelities(const std::vector<Coordinate>& coordinates, const Eigen::MatrixXd& places,
                         const std::vector<std::vector<double>>& levels);

/// First and total indices of f = g + e by each input, with D_g the part of the surrogate's variance V_g, and
/// V_e the mean square of residuals (95 % above by their spread). value: D_g / V_g. The part of f is
///   D_f = D_g + 2 Cov(P g, e) + D_e,   0 <= D_e <= V_e,   V = V_g + V_e,
/// P the projection behind D (Surrogate::first, total). The interval is from D_g / V - w to
/// (D_g + V_e) / V + w within [0, 1], w 1.96 times the root of the mean square error of the covariance's
/// share, estimated from the residuals at the points: it holds what the surrogate misses, whoever's part that
/// is.
std::vector<SobolIndices> surrogate_indices(const Validated& validated);

/// The mean of f: that of the surrogate, with 1.96 standard deviations of the mean of the residuals, and
/// their mean, about it.
Estimate surrogate_mean(const Validated& validated);

}  // namespace tunica::uncertainty
