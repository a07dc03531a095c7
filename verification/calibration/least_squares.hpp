// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tunica::verification::calibration {

/// Residuals r (one for each target) and dr/du (targets by unknowns) at a point u.
struct Residuals {
  Eigen::VectorXd values;
  Eigen::MatrixXd jacobian;  ///< empty when it was not asked for
};

/// Computes them; nullopt where there is no answer (the solver gave up). May throw to end the search.
using Evaluate = std::function<std::optional<Residuals>(const Eigen::VectorXd& u, bool with_jacobian)>;

struct SearchOptions {
  /// The search is over when a further Gauss-Newton step would lower |r|^2 / 2 by less than this times
  /// 1 + |r|^2 / 2.
  double tolerance = 1e-9;
  /// What is taken for over where no step lowers it any more: noise of the residuals.
  double noise = 1e-4;
  int most_steps = 80;
};

struct Minimum {
  Eigen::VectorXd u;
  Residuals residuals;     ///< there, with their derivatives
  bool converged = false;  ///< else `reason` says why not
  std::string reason;

  double misfit() const { return residuals.values.squaredNorm(); }
};

/// Least squares in the unit box 0 <= u <= 1: minimises |r(u)|^2 by Levenberg's and Marquardt's steps,
/// (J^T J + S + lambda diag(J^T J)) s = -J^T r over the unknowns that no bound holds, each step cut off at
/// the box (Kanzow, Yamashita and Fukushima 2004). S is 0, or where that has foretold the last step better,
/// the second derivative that J^T J leaves out, learnt from the steps (Dennis, Gay and Welsch 1981): without
/// it the search creeps where residuals stay large, as they do for targets that conflict. A point without an
/// answer counts as one that is worse. nullopt when there is none at the start.
std::optional<Minimum> least_squares(const Evaluate& evaluate, Eigen::VectorXd start,
                                     const SearchOptions& options = {});

/// What the residuals' derivatives say of the unknowns when residuals have the standard deviation 1.
struct Certainty {
  Eigen::MatrixXd covariance;           ///< (J^T J)^-1 over the directions that residuals see
  std::vector<bool> determined;         ///< per unknown: no unseen direction moves it
  std::vector<bool> without_influence;  ///< per unknown: no residual moves with it
};
Certainty certainty(const Eigen::MatrixXd& jacobian);

}  // namespace tunica::verification::calibration
