// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "verification/uncertainty/surrogate.hpp"

namespace tunica::uncertainty {

/// What the likelihood chooses: a length an input, in units of its coordinate, and the share of the variance
/// that is noise.
struct Scales {
  Eigen::VectorXd lengths;
  double noise = 1e-8;
};

/// Ordinary kriging: g = m + sum of a_i prod_k r(|z_k - z_ik| / l_k), a = (R + noise)^-1 (y - m), with
/// Matérn's r(h) = (1 + h + h^2 / 3) exp(-h), h = sqrt(5) |z - z'| / l, and m by generalised least squares
/// (Santner, Williams and Notz 2018, chapter 3). Products make E[g | ...] and variances integrals over one
/// coordinate each, by Gauss's rule of its law (after Oakley and O'Hagan 2004).
class Kriging final : public Surrogate {
 public:
  Kriging(const Known& known, const Scales& scales);

  std::string kind() const override { return "kriging"; }
  double mean() const override { return mean_; }
  double variance() const override { return variance_; }
  double value(const Eigen::VectorXd& place) const override;
  double first(Eigen::Index input, const Eigen::VectorXd& place) const override;
  double first_variance(Eigen::Index input) const override;
  double total(Eigen::Index input, const Eigen::VectorXd& place) const override;
  double total_variance(Eigen::Index input) const override;

 private:
  /// r of one coordinate between z and each point.
  Eigen::ArrayXd towards(Eigen::Index input, double z) const;

  std::vector<Coordinate> coordinates_;
  Eigen::MatrixXd places_;
  Scales scales_;
  double level_ = 0;                       ///< m
  Eigen::ArrayXd weights_;                 ///< a
  Eigen::ArrayXXd means_;                  ///< [point][input]: the integral of r over its coordinate
  std::vector<Eigen::ArrayXXd> products_;  ///< [input](point, point): that of r towards both
  double mean_ = 0, variance_ = 0;
};

/// Scales of the greatest likelihood, searched by steps of factors of 2, then of its root.
Scales likely_scales(const Known& known);

}  // namespace tunica::uncertainty
