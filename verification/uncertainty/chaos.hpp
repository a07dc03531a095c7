// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "verification/uncertainty/surrogate.hpp"

namespace tunica::uncertainty {

/// Sparse polynomial chaos: g = sum of c_t prod_k p_(n_tk)(z_k), orthonormal, so that variances are sums of
/// squares of coefficients (Sudret 2008).
class Chaos final : public Surrogate {
 public:
  using Degrees = std::vector<int>;  ///< by input
  struct Term {
    Degrees degrees;
    double coefficient;
  };

  /// Terms of unlike degrees.
  Chaos(const std::vector<Coordinate>& coordinates, std::vector<Term> terms);

  std::string kind() const override { return "chaos"; }
  double mean() const override;
  double variance() const override;
  double value(const Eigen::VectorXd& place) const override;
  double first(Eigen::Index input, const Eigen::VectorXd& place) const override;
  double first_variance(Eigen::Index input) const override;
  double total(Eigen::Index input, const Eigen::VectorXd& place) const override;
  double total_variance(Eigen::Index input) const override;

  const std::vector<Term>& terms() const { return terms_; }

 private:
  template <class Is>
  double sum(const Eigen::VectorXd& place, const Is& is_of_it) const;
  template <class Is>
  double squares(const Is& is_of_it) const;

  std::vector<Coordinate> coordinates_;
  std::vector<Term> terms_;
};

/// Least squares in terms that orthogonal matching pursuit picks one by one from those with
/// (sum of n_k^(3/4))^(4/3) <= p, at most 1,000 of them; their number, and p up to 20, are those with the
/// least leave-one-out error, which counts (N + P) / (N - P) for P terms of N points (Blatman and Sudret
/// 2011; Lüthen, Marelli and Sudret 2021).
std::unique_ptr<Chaos> fit_chaos(const Known& known);

/// The sum of two.
std::unique_ptr<Chaos> sum(const std::vector<Coordinate>& coordinates, const Chaos& one, const Chaos& other);

}  // namespace tunica::uncertainty
