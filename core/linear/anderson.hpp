// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace tunica::linear {

/// Anderson's acceleration of a fixed point iteration x -> image (Walker and Ni, SIAM J. Numer. Anal.
/// 49:1715, 2011): the next x is the combination of the last images whose differences image - x nearly
/// cancel. What decays slowly is found within about twice as many images as there are such modes; the rest
/// the map damps.
class Anderson {
 public:
  /// `depth`: how many images are combined at most.
  explicit Anderson(std::size_t depth) : depth_(depth) {}

  /// Takes the image of x in and returns the next x; `weights` scale the entries' differences.
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image,
                       const Eigen::VectorXd& weights);

  /// Forgets all images.
  void restart();
  /// How many images the last x was combined of.
  std::size_t images() const { return images_.size(); }

 private:
  std::size_t depth_;
  std::vector<Eigen::VectorXd> images_, differences_;
};

}  // namespace tunica::linear
