// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/linear/anderson.hpp"

#include <Eigen/QR>

namespace tunica::linear {

using Vector = Eigen::VectorXd;

Vector Anderson::next(const Vector& x, const Vector& image, const Vector& weights) {
  images_.push_back(image);
  differences_.emplace_back(image - x);
  if (images_.size() > depth_) {
    images_.erase(images_.begin());
    differences_.erase(differences_.begin());
  }
  Vector combined = image;
  const auto m = static_cast<Eigen::Index>(images_.size());
  if (m == 1) return combined;
  // Columns of unit length, lest those of early images, which are long, make the late ones count as nothing.
  Eigen::MatrixXd changes(x.size(), m - 1);
  Vector lengths(m - 1);
  for (Eigen::Index k = 0; k + 1 < m; ++k) {
    changes.col(k) = weights.cwiseProduct(differences_[k + 1] - differences_[k]);
    lengths[k] = changes.col(k).norm();
    if (lengths[k] > 0) changes.col(k) /= lengths[k];
  }
  const Vector mix = changes.colPivHouseholderQr().solve(weights.cwiseProduct(differences_.back()));
  for (Eigen::Index k = 0; k + 1 < m; ++k)
    if (lengths[k] > 0) combined -= mix[k] / lengths[k] * (images_[k + 1] - images_[k]);
  return combined;
}

void Anderson::restart() {
  images_.clear();
  differences_.clear();
}

}  // namespace tunica::linear
